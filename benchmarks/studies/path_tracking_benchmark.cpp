// Times what the figures of docs/path-tracking.md speak of, on paths of 30 m as a Reeds-Shepp planner (full-lock arcs,
// lines, cusps) and as a smoothing planner (clothoids) deliver them. All counters are in milliseconds.

#include "benchmarks/system/ProcessorTime.h"
#include "path_tracking/simulation/ClosedLoop.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace
{
    using namespace parking;

    constexpr double LENGTH = 30.0;

    /** Curvature, as a share of the largest, of the pieces of a path: arcs or, ramped up and down, clothoids. */
    Path makePath(std::uint64_t seed, bool smooth)
    {
        const double most = 1.0 / Vehicle().minTurningRadius();
        std::mt19937_64 random(seed);
        const auto uniform = [&random](double low, double high)
        {
            return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
        };
        Path path{{0.0, 0.0, uniform(-PI, PI)}, {}};
        double direction = 1.0;
        while (path.length() < LENGTH)
        {
            const double curvature = (static_cast<double>(random() % 3) - 1.0) * most;
            const double length = uniform(0.5, 5.0);
            if (smooth)
            {
                // Up over a third of the length, as long held, and down again.
                const double third = (1.0 + length) / 3.0, top = 0.9 * curvature;
                path.append({0.0, direction * third, top / third});
                path.append({top, direction * third});
                path.append({top, direction * third, -top / third});
            }
            else
            {
                path.append({curvature, direction * length});
            }
            if (random() % 3 == 0)
                direction = -direction;
        }
        return path;
    }

    void speedProfile(benchmark::State &state)
    {
        std::vector<Path> paths;
        for (std::uint64_t seed = 0; seed < 20; ++seed)
            paths.push_back(makePath(seed, state.range(0) == 1));
        std::size_t i = 0;
        for (auto _ : state)
            benchmark::DoNotOptimize(SpeedProfile(paths[i++ % paths.size()], Vehicle()).duration());
    }

    /** Everyday disturbances of the figures in the documentation. */
    Disturbances everyday(std::uint64_t seed)
    {
        Disturbances disturbances;
        disturbances.steeringLag = 0.1;
        disturbances.positionNoise = 0.02;
        disturbances.yawNoise = 0.5 * PI / 180.0;
        disturbances.speedBias = 0.05;
        disturbances.seed = seed;
        return disturbances;
    }

    double cpuMilliseconds()
    {
        return 1e3 * threadProcessorTime();
    }

    /** Replays the problems of whole drives: the solver's share alone, warm started as on the road. */
    void mpcStep(benchmark::State &state)
    {
        const bool smooth = state.range(0) == 1, disturbed = state.range(1) == 1;
        std::vector<std::vector<MpcProblem>> drives;
        for (std::uint64_t seed = 0; seed < 10; ++seed)
        {
            ClosedLoopParameters parameters;
            if (disturbed)
                parameters.disturbances = everyday(seed + 1);
            ClosedLoop loop(Vehicle(), parameters);
            std::vector<MpcProblem> problems;
            Mpc mpc(Vehicle(), parameters.tracking.mpc);
            loop.setSolve(
                [&](const MpcProblem &problem)
                {
                    problems.push_back(problem);
                    return mpc.solve(problem);
                });
            loop.drive(makePath(seed, smooth));
            drives.push_back(std::move(problems));
        }
        Mpc mpc(Vehicle{}, MpcParameters{});
        std::vector<double> times, cpuTimes;
        double iterations = 0.0;
        std::size_t drive = 0, i = 0;
        for (auto _ : state)
        {
            if (i == drives[drive].size())
            {
                drive = (drive + 1) % drives.size();
                i = 0;
                mpc.reset();
            }
            const double before = cpuMilliseconds();
            const MpcSolution solution = mpc.solve(drives[drive][i++]);
            cpuTimes.push_back(cpuMilliseconds() - before);
            times.push_back(1000.0 * solution.solveTime);
            iterations += solution.iterations;
        }
        const TimeStatistics statistics = timeStatistics(times);
        state.counters["median_ms"] = statistics.median;
        state.counters["p99_ms"] = statistics.p99;
        // On a busy machine the wall clock's upper ranks are those of the scheduler.
        const TimeStatistics cpu = timeStatistics(cpuTimes);
        state.counters["cpu_median_ms"] = cpu.median;
        state.counters["cpu_p99_ms"] = cpu.p99;
        state.counters["cpu_max_ms"] = cpu.max;
        state.counters["iterations"] = iterations / static_cast<double>(times.size());
    }

    void wholeDrive(benchmark::State &state)
    {
        ClosedLoopParameters parameters;
        if (state.range(1) == 1)
            parameters.disturbances = everyday(1);
        const ClosedLoop loop(Vehicle(), parameters);
        const Path path = makePath(1, state.range(0) == 1);
        DriveResult result;
        for (auto _ : state)
            result = loop.drive(path);
        state.counters["crossTrack_mm"] = 1000.0 * result.evaluation.maxCrossTrack;
        state.counters["finalError_mm"] = 1000.0 * result.evaluation.finalPositionError;
        state.counters["travelTime_s"] = result.evaluation.travelTime;
    }
}  // namespace

BENCHMARK(speedProfile)->ArgName("smooth")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK(mpcStep)
    ->ArgNames({"smooth", "disturbed"})
    ->ArgsProduct({{0, 1}, {0, 1}})
    ->Iterations(4000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(wholeDrive)->ArgNames({"smooth", "disturbed"})->ArgsProduct({{0, 1}, {0, 1}})->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
