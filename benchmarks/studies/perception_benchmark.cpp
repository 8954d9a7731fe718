// Measures what a frame of a sensor costs while a car drives through a car park: the simulated sensor, the update of
// the world in place, and the first checks after it, which compute the dropped parts of the edge index again.

#include "automatic_parking/ParkingWorld.h"
#include "automatic_parking/perception/PerceivedWorld.h"
#include "automatic_parking/perception/SimulatedSensor.h"
#include "benchmarks/worlds/RandomWorlds.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

namespace
{
    using namespace parking;
    using parking_test::Random;
    using Clock = std::chrono::steady_clock;

    constexpr int FRAMES = 200;
    constexpr double PERIOD = 0.05;  // seconds
    constexpr double SPEED = 2.0;    // m/s

    double millisecondsSince(Clock::time_point begin)
    {
        return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    }

    double percentile(std::vector<double> values, double share)
    {
        std::sort(values.begin(), values.end());
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    }

    /** Rows of parked cars with gaps and aisles of 6 m on a square; the car stands in an aisle near the middle. */
    Scenario carPark(double side)
    {
        Random random(1);
        Scenario scenario;
        scenario.bounds = {{0.0, 0.0}, {side, side}};
        for (double y = 5.0; y + 5.0 < side; y += 16.0)
            for (double x = 3.0; x + 3.0 < side; x += 2.6)
                for (const double row : {y, y + 5.0})
                    if (random.chance(0.7))
                        scenario.polygons.push_back(parking_test::rectangle(
                            4.7, 1.9, {x + random.between(-0.2, 0.2), row, PI / 2.0 + random.between(-0.05, 0.05)}));
        scenario.start = {0.4 * side, 5.0 + 16.0 * std::floor(side / 32.0) + 10.5, 0.0};
        return scenario;
    }

    /** \param noise standard deviation of distances, metres */
    void frames(benchmark::State &state, bool unseenIsOccupied, double noise)
    {
        const Scenario truth = carPark(0.1 * static_cast<double>(state.range(0)));
        std::vector<double> sensing, updating, checking, cells;
        for (auto _ : state)
        {
            SensorParameters parameters;
            parameters.rangeNoise = noise;
            PerceivedWorld seen(truth, std::make_shared<SimulatedSensor>(truth, parameters), {0.1, unseenIsOccupied});
            ParkingWorld world(seen.scenario(), {}, IndexedObstacles::LOCAL_REACH);
            world.update(seen.observe(0.0, truth.start));
            for (int k = 1; k <= FRAMES; ++k)
            {
                const double time = PERIOD * k;
                const Pose car{truth.start.x + SPEED * time, truth.start.y, 0.0};
                Clock::time_point begin = Clock::now();
                const GridUpdate &update = seen.observe(time, car);
                sensing.push_back(millisecondsSince(begin));
                begin = Clock::now();
                world.update(update);
                updating.push_back(millisecondsSince(begin));
                begin = Clock::now();
                benchmark::DoNotOptimize(world.footprint().freeLength(car, 0.02, 15.0));
                checking.push_back(millisecondsSince(begin));
                cells.push_back(static_cast<double>(update.size()));
            }
        }
        for (const auto &[name, values] :
             {std::pair("sense", sensing), {"update", updating}, {"check", checking}, {"cells", cells}})
        {
            state.counters[std::string(name) + "_p50"] = percentile(values, 0.5);
            state.counters[std::string(name) + "_p99"] = percentile(values, 0.99);
        }
    }

    void worldOfMap(benchmark::State &state)
    {
        const Scenario truth = carPark(0.1 * static_cast<double>(state.range(0)));
        PerceivedWorld seen(truth, std::make_shared<SimulatedSensor>(truth), {0.1, false});
        seen.observe(0.0, truth.start);
        for (auto _ : state)
            benchmark::DoNotOptimize(
                ParkingWorld(seen.scenario(), {}, state.range(1) != 0 ? IndexedObstacles::LOCAL_REACH : HUGE_VAL)
                    .footprint()
                    .isFree(truth.start));
    }
}  // namespace

int main(int argc, char **argv)
{
    for (const auto &[name, unseenIsOccupied, noise] : {std::tuple("frames/free_until_seen", false, 0.0),
                                                        {"frames/free_until_seen/noise_3cm", false, 0.03},
                                                        {"frames/closed", true, 0.0},
                                                        {"frames/closed/noise_3cm", true, 0.03}})
        benchmark::RegisterBenchmark(name, frames, unseenIsOccupied, noise)
            ->Arg(1000)
            ->Arg(2000)
            ->Arg(4000)
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("worldOfMap", worldOfMap)
        ->ArgNames({"cells", "limited"})
        ->ArgsProduct({{1000, 2000}, {0, 1}})
        ->Unit(benchmark::kMillisecond);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
