// How long manoeuvres and smoothing take. Every benchmark goes round a fixed set of random problems (one per
// iteration), so that the mean is that of the set; counters say what came out of the whole set.

#include "benchmarks/worlds/RandomParking.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "parking_geometry/manoeuvres/ReverseParking.h"
#include "parking_geometry/smoothing/BsplineSmoother.h"
#include "parking_geometry/smoothing/PathSmoother.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

namespace
{
    using namespace parking;
    using parking_test::RandomParking;

    // ---- manoeuvres ------------------------------------------------------------------------------------------------

    /** Random cars and slots of one kind; with the least aisle they fit when \e tight, otherwise in an endless one. */
    void manoeuvre(benchmark::State &state, SlotKind kind, bool tight)
    {
        struct Problem
        {
            ReverseParking parking;
            ParkingSlot slot;
        };
        RandomParking random(1);
        std::vector<Problem> problems;
        while (problems.size() < 256)
        {
            const Vehicle car = random.vehicle();
            ParkingSlot slot = random.slot(car);
            slot.kind = kind;
            slot.entry = SlotEntry::Reverse;
            slot.width = car.width + random.between(0.4, 0.8);
            slot.lateralOffset = 0.0;
            slot.depth.reset();
            ReverseParkingOptions options;
            if (kind == SlotKind::Parallel)
                slot.length = ReverseParking(car, options).plan(slot).neededSlotLength + 0.1;
            if (tight)
                options.aisleWidth = ReverseParking(car, options).plan(slot).neededAisleWidth + 1e-6;
            problems.push_back({ReverseParking(car, options), slot});
        }
        std::size_t i = 0;
        for (auto _ : state)
        {
            const Problem &problem = problems[i++ % problems.size()];
            benchmark::DoNotOptimize(problem.parking.plan(problem.slot));
        }
        std::size_t fits = 0;
        for (const Problem &problem : problems)
            fits += problem.parking.plan(problem.slot).fits();
        state.counters["fits %"] = 100.0 * static_cast<double>(fits) / static_cast<double>(problems.size());
    }
    BENCHMARK_CAPTURE(manoeuvre, perpendicular, SlotKind::Perpendicular, false)->Unit(benchmark::kMicrosecond);
    BENCHMARK_CAPTURE(manoeuvre, perpendicular_tight, SlotKind::Perpendicular, true)->Unit(benchmark::kMicrosecond);
    BENCHMARK_CAPTURE(manoeuvre, angled, SlotKind::Angled, false)->Unit(benchmark::kMicrosecond);
    BENCHMARK_CAPTURE(manoeuvre, angled_tight, SlotKind::Angled, true)->Unit(benchmark::kMicrosecond);
    BENCHMARK_CAPTURE(manoeuvre, parallel, SlotKind::Parallel, false)->Unit(benchmark::kMicrosecond);
    BENCHMARK_CAPTURE(manoeuvre, parallel_tight, SlotKind::Parallel, true)->Unit(benchmark::kMicrosecond);

    // ---- smoothing -------------------------------------------------------------------------------------------------

    constexpr double PATH_LENGTH = 30.0;

    /** Poles beside a path, 5 to 65 cm from the body; clearance by the distance of each to the body's rectangle. */
    class Poles
    {
    public:
        Poles(RandomParking &random, const Vehicle &car, const Path &path, int count) : car_(car)
        {
            const SampledPath states = path.sample(0.05);
            while (static_cast<int>(poles_.size()) < count)
            {
                const Pose at = states[static_cast<std::size_t>(random.below(static_cast<int>(states.size())))].pose;
                const double side = random.chance(0.5) ? 1.0 : -1.0;
                const Pose pole = compose(at, {random.between(-car.rearOverhang, car.wheelbase + car.frontOverhang),
                                               side * (0.5 * car.width + POLE + random.between(0.05, 0.65)), 0.0});
                poles_.push_back({pole.x, pole.y});
                if (!std::all_of(states.begin(), states.end(),
                                 [&](const PathState &state) { return distance(state.pose) > 0.02; }))
                    poles_.pop_back();
            }
        }

        FootprintQueries queries() const
        {
            FootprintQueries result;
            result.clearance = [this](const Pose &pose)
            {
                return std::max(0.0, distance(pose));
            };
            result.isFree = [this](const Pose &pose)
            {
                return distance(pose) > 0.0;
            };
            return result;
        }

    private:
        static constexpr double POLE = 0.1;

        double distance(const Pose &pose) const
        {
            const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
            const double rear = -car_.rearOverhang, front = car_.wheelbase + car_.frontOverhang;
            double least = 1e9;
            for (const Eigen::Vector2d &pole : poles_)
            {
                const double dx = pole.x() - pose.x, dy = pole.y() - pose.y;
                const double along = c * dx + s * dy, across = std::abs(c * dy - s * dx);
                const double x = std::max({rear - along, 0.0, along - front});
                const double y = std::max(0.0, across - 0.5 * car_.width);
                least = std::min(least, x * x + y * y);
            }
            return std::sqrt(least) - POLE;
        }

        Vehicle car_;
        std::vector<Eigen::Vector2d> poles_;
    };

    Path cut(const Path &path, double length)
    {
        Path result{path.start, {}};
        for (PathPiece segment : path.pieces)
        {
            segment.length = std::copysign(std::min(std::abs(segment.length), length), segment.length);
            length -= std::abs(segment.length);
            result.append(segment);
        }
        return result;
    }

    /** 30 m of what a lattice planner returns. */
    Path latticePath(RandomParking &random, const Vehicle &car, double radiusFactor)
    {
        Path path = random.plannerPath(car, radiusFactor);
        while (path.length() < PATH_LENGTH)
            for (const PathPiece &segment : random.plannerPath(car, radiusFactor).pieces)
                path.append(segment);
        return cut(path, PATH_LENGTH);
    }

    /** 30 m of Reeds-Shepp curves between random poses. */
    Path reedsSheppPath(RandomParking &random, const Vehicle &car, double radiusFactor)
    {
        const ReedsShepp solver(radiusFactor * car.minTurningRadius());
        Path path{random.pose(8.0), {}};
        while (path.length() < PATH_LENGTH)
        {
            const ReedsSheppCurve curve = solver.shortest(path.end(), random.pose(8.0));
            for (std::size_t i = 0; i < curve.count; ++i)
                path.append(curve.pieces[i]);
        }
        return cut(path, PATH_LENGTH);
    }

    /** \param radiusPercent of the smallest radius, at which the paths were planned */
    void smooth30m(benchmark::State &state, bool lattice, bool poles)
    {
        RandomParking random(2);
        const Vehicle car;
        const double factor = 0.01 * static_cast<double>(state.range(0));
        std::vector<Path> paths;
        std::vector<Poles> worlds;
        for (int i = 0; i < 200; ++i)
        {
            paths.push_back(lattice ? latticePath(random, car, factor) : reedsSheppPath(random, car, factor));
            if (poles)
                worlds.emplace_back(random, car, paths.back(), 30);
        }
        const PathSmoother smoother(car);
        std::vector<FootprintQueries> queries(paths.size());
        for (std::size_t i = 0; i < worlds.size(); ++i)
            queries[i] = worlds[i].queries();
        std::size_t i = 0;
        for (auto _ : state)
        {
            benchmark::DoNotOptimize(smoother.smooth(paths[i % paths.size()], queries[i % paths.size()]));
            ++i;
        }
        std::size_t stretches = 0, continuous = 0;
        double change = 0.0;
        std::vector<double> times;
        for (std::size_t k = 0; k < paths.size(); ++k)
        {
            const auto before = std::chrono::steady_clock::now();
            const SmoothPath result = smoother.smooth(paths[k], queries[k]);
            times.push_back(
                std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - before).count());
            stretches += result.stretches.size();
            continuous += result.continuousStretches();
            change = std::max(change, std::abs(result.path.length() / result.lengthBefore - 1.0));
        }
        std::sort(times.begin(), times.end());
        state.counters["median us"] = times[times.size() / 2];
        state.counters["p95 us"] = times[times.size() * 95 / 100];
        state.counters["continuous %"] = 100.0 * static_cast<double>(continuous) / static_cast<double>(stretches);
        state.counters["length change %"] = 100.0 * change;
    }
    BENCHMARK_CAPTURE(smooth30m, lattice, true, false)->Arg(100)->Arg(102)->Arg(105)->Unit(benchmark::kMicrosecond);
    BENCHMARK_CAPTURE(smooth30m, lattice_poles, true, true)
        ->Arg(100)
        ->Arg(102)
        ->Arg(105)
        ->Unit(benchmark::kMicrosecond);
    BENCHMARK_CAPTURE(smooth30m, reeds_shepp, false, false)
        ->Arg(100)
        ->Arg(102)
        ->Arg(105)
        ->Unit(benchmark::kMicrosecond);
    BENCHMARK_CAPTURE(smooth30m, reeds_shepp_poles, false, true)
        ->Arg(100)
        ->Arg(102)
        ->Arg(105)
        ->Unit(benchmark::kMicrosecond);

    void clearanceOf30Poles(benchmark::State &state)
    {
        RandomParking random(3);
        const Vehicle car;
        const Path path = latticePath(random, car, 1.0);
        const Poles poles(random, car, path, 30);
        const FootprintQueries queries = poles.queries();
        const SampledPath states = path.sample(0.1);
        std::size_t i = 0;
        for (auto _ : state)
            benchmark::DoNotOptimize(queries.clearance(states[i++ % states.size()].pose));
    }
    BENCHMARK(clearanceOf30Poles);

    void bsplineOf60Cells(benchmark::State &state)
    {
        std::vector<Eigen::Vector2d> points;
        for (int i = 0; i < 60; ++i)
            points.emplace_back(0.5 * i, i < 30 ? 0.0 : 0.5 * (i - 30));
        for (auto _ : state)
            benchmark::DoNotOptimize(bsplineSmooth(points));
    }
    BENCHMARK(bsplineOf60Cells)->Unit(benchmark::kMicrosecond);
}  // namespace

BENCHMARK_MAIN();
