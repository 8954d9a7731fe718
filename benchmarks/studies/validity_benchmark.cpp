// Measures the cost of checks of states and motions against the alternatives of OMPL's users: plain FCL for states,
// OMPL's DiscreteMotionValidator for motions. Every benchmark iterates over a fixed set of random problems, so that its
// mean is that of the set. Counters show how many poses each tier decided, and how many answers were wrong. Ratios are
// more robust than times: --benchmark_enable_random_interleaving=true measures both sides of a ratio under the same
// conditions.

#include "benchmarks/worlds/OutlinedVehicles.h"
#include "benchmarks/worlds/RandomWorlds.h"
#include "ompl_improved_astar/ImprovedAStar.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "state_validity/fcl/FclContactTest.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplPose.h"
#include "state_validity/ompl/SweptMotionValidator.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/util/Console.h>

namespace
{
    using namespace parking;
    using parking_test::Random;
    using parking_test::World;
    namespace ob = ompl::base;

    // ---- states ----------------------------------------------------------------------------------------------------

    /** Location of a benchmark's poses. */
    enum class Surroundings
    {
        Free,     ///< more than a metre from every obstacle
        Mixed,    ///< anywhere in the world
        Tight,    ///< at most half a metre from contact with an obstacle, on either side
        Search,   ///< poses checked by a parking search
        FromSlot  ///< poses checked by a search from the goal only, out of the slot
    };

    /** A world with both checkers, and the poses to check. */
    struct Place
    {
        Place(const ObstacleSet &obstacles, const Vehicle &vehicle)
          : tiered(std::make_unique<FootprintChecker>(obstacles, vehicle, 0.0, fclContactTest())),
            hexagon(std::make_unique<FootprintChecker>(obstacles, parking_test::hexagonalCar())),
            plain(std::make_unique<PlainFclChecker>(obstacles, vehicle))
        {
        }

        std::unique_ptr<FootprintChecker> tiered;   ///< distance field and circles before the exact check
        std::unique_ptr<FootprintChecker> hexagon;  ///< the same for a car with cut-off corners
        std::unique_ptr<PlainFclChecker> plain;     ///< FCL for every pose
        std::vector<Pose> poses;                    ///< of the rear axle, in the world's local coordinates
    };

    /** Eight random worlds with 4000 poses each, equal in every run.

        \param grids whether worlds are occupancy grids instead of polygons
        \param surroundings any value but those of a search */
    std::vector<Place> randomPlaces(bool grids, Surroundings surroundings)
    {
        constexpr std::size_t POSES = 4000;
        constexpr std::uint64_t WORLDS = 8;
        constexpr double FREE_CLEARANCE = 1.0, TIGHT = 0.5;  // metres
        std::vector<Place> places;
        const Vehicle vehicle;
        for (std::uint64_t seed = 1000; seed < 1000 + WORLDS; ++seed)
        {
            const World world = grids ? parking_test::randomGridWorld(seed) : parking_test::randomPolygonWorld(seed);
            Place place(world.obstacles, vehicle);
            Random random(seed);
            while (place.poses.size() < POSES)
            {
                const Pose pose = surroundings == Surroundings::Tight
                                      ? world.touching(random, vehicle, random.between(0.0, TIGHT))
                                      : world.anywhere(random);
                if (surroundings != Surroundings::Free || place.tiered->clearance(pose) > FREE_CLEARANCE)
                    place.poses.push_back(pose);
            }
            places.push_back(std::move(place));
        }
        return places;
    }

    /** Maximum number of poses of a problem, evenly spread over its search. */
    constexpr std::size_t KEPT = 20000;

    /** Every pose that ImprovedAStar checks until its first solution. With a checker of an unknown type it checks every
        state along the motions that it attempts. */
    std::vector<Pose> posesOfSearch(const Scenario &scenario, const FootprintChecker &checker, bool fromSlot)
    {
        const auto space = std::make_shared<ob::ReedsSheppStateSpace>(scenario.vehicle.minTurningRadius());
        space->setBounds(positionBounds(scenario.bounds));
        const auto si = std::make_shared<ob::SpaceInformation>(space);
        std::vector<Pose> poses;
        si->setStateValidityChecker(
            [&](const ob::State *state)
            {
                poses.push_back(poseOf(state));
                return checker.isFree(poses.back());
            });
        si->setup();
        const auto problem = std::make_shared<ob::ProblemDefinition>(si);
        ob::ScopedState<> state(si);
        setPose(state.get(), scenario.start);
        problem->addStartState(state);
        const auto goals = std::make_shared<ob::GoalStates>(si);
        for (const Pose &goal : scenario.goals)
        {
            setPose(state.get(), goal);
            goals->addState(state);
        }
        problem->setGoal(goals);
        ompl::geometric::ImprovedAStar planner(si);
        planner.params().setParam("bidirectional", fromSlot ? "0" : "1");
        planner.setProblemDefinition(problem);
        planner.setup();
        // Counted in checks, not in seconds: equal poses on every machine.
        planner.solve(ob::PlannerTerminationCondition([&poses] { return poses.size() > 100 * KEPT; }));
        return poses;
    }
    /** The bundled parking problems with the poses of their searches. */
    std::vector<Place> searchedPlaces(bool fromSlot)
    {
        ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
        std::vector<Place> places;
        for (const char *name :
             {"angled45", "dead_end_aisle", "multi_storey", "narrow_parallel", "narrow_perpendicular", "parallel",
              "perpendicular", "tight_parallel", "underground_garage", "perceived_street"})
        {
            const Scenario scenario = readScenario(std::string(PARKING_SCENARIOS "/") + name + ".yaml");
            Place place(ObstacleSet::fromScenario(scenario), scenario.vehicle);
            const std::vector<Pose> poses = posesOfSearch(scenario, *place.tiered, fromSlot);
            const std::size_t step = (poses.size() + KEPT - 1) / KEPT;
            for (std::size_t i = 0; i < poses.size(); i += step)
                place.poses.push_back(poses[i]);
            places.push_back(std::move(place));
        }
        return places;
    }

    const std::vector<Place> &placesOf(bool grids, Surroundings surroundings)
    {
        static std::map<std::pair<bool, Surroundings>, std::vector<Place>> made;
        const auto [entry, isNew] = made.try_emplace({grids, surroundings});
        const bool fromSlot = surroundings == Surroundings::FromSlot;
        if (isNew)
            entry->second = fromSlot || surroundings == Surroundings::Search ? searchedPlaces(fromSlot)
                                                                             : randomPlaces(grids, surroundings);
        return entry->second;
    }

    /** Number of passes over the poses of a world before the next one: planners stay in one world for longer than the
        caches need to fill. */
    constexpr std::size_t ROUNDS = 10;

    enum class Checker
    {
        Tiered,   ///< FootprintChecker, with FCL within the band round contact
        Hexagon,  ///< FootprintChecker for a body of six corners
        PlainFcl  ///< FCL for every pose
    };

    void stateCheck(benchmark::State &state, bool grids, Surroundings surroundings, Checker kind)
    {
        const std::vector<Place> &places = placesOf(grids, surroundings);
        CheckCounts counts;
        std::size_t free = 0, checks = 0, world = 0, round = 0, i = 0;
        for (auto _ : state)
        {
            const Place &place = places[world];
            free += kind == Checker::PlainFcl
                        ? place.plain->isFree(place.poses[i])
                        : (kind == Checker::Tiered ? place.tiered : place.hexagon)->isFree(place.poses[i], counts);
            ++checks;
            if (++i < place.poses.size())
                continue;
            i = 0;
            if (++round < ROUNDS)
                continue;
            round = 0;
            world = (world + 1) % places.size();
        }
        const auto percent = [checks](std::size_t count)
        {
            return 100.0 * static_cast<double>(count) / static_cast<double>(checks);
        };
        state.counters["free %"] = percent(free);
        state.counters["field %"] = percent(counts.byField);
        state.counters["circles %"] = percent(counts.byCircles);
        state.counters["edges %"] = percent(counts.byEdges);
        state.counters["FCL %"] = kind == Checker::PlainFcl ? 100.0 : percent(counts.byContactTest);
    }

    // ---- motions ---------------------------------------------------------------------------------------------------

    /** OMPL 1.5 derives the number of segments of a curve from the straight line between its ends; this is the
        computation of 1.6. */
    class EvenlyCheckedSpace : public ob::ReedsSheppStateSpace
    {
    public:
        using ob::ReedsSheppStateSpace::ReedsSheppStateSpace;

        unsigned int validSegmentCount(const ob::State *from, const ob::State *to) const override
        {
            constexpr double SEGMENT = 0.02;  // metres
            return static_cast<unsigned int>(std::ceil(distance(from, to) / SEGMENT));
        }
    };

    /** A random world of polygons with random motions from free poses. */
    struct Motions
    {
        Motions(std::uint64_t seed, std::size_t count)
          : world(parking_test::randomPolygonWorld(seed)),
            space(std::make_shared<EvenlyCheckedSpace>(vehicle.minTurningRadius()))
        {
            space->setBounds(positionBounds(world.bounds));
            si = std::make_shared<ob::SpaceInformation>(space);
            const auto checker = std::make_shared<FclFootprintChecker>(si, world.obstacles, vehicle);
            si->setStateValidityChecker(checker);
            si->setup();
            swept = std::make_shared<SweptMotionValidator>(si);
            discrete = std::make_shared<ob::DiscreteMotionValidator>(si);
            plainSi = std::make_shared<ob::SpaceInformation>(space);
            plainSi->setStateValidityChecker([this, plain = std::make_shared<const PlainFclChecker>(
                                                        world.obstacles, vehicle)](const ob::State *state)
                                             { return space->satisfiesBounds(state) && plain->isFree(poseOf(state)); });
            plainSi->setup();
            discreteFcl = std::make_shared<ob::DiscreteMotionValidator>(plainSi);

            Random random(seed);
            while (ends.size() < count)
            {
                const Pose from = world.anywhere(random), to = world.anywhere(random);
                if (!checker->footprint().isFree(from))
                    continue;
                ends.emplace_back(ob::ScopedState<>(si), ob::ScopedState<>(si));
                setPose(ends.back().first.get(), from);
                setPose(ends.back().second.get(), to);
            }
        }

        Vehicle vehicle;
        World world;
        std::shared_ptr<EvenlyCheckedSpace> space;
        ob::SpaceInformationPtr si, plainSi;
        std::shared_ptr<SweptMotionValidator> swept;
        ob::MotionValidatorPtr discrete, discreteFcl;
        std::vector<std::pair<ob::ScopedState<>, ob::ScopedState<>>> ends;
    };

    enum class Validator
    {
        Swept,
        Discrete,    ///< OMPL's validator, every 2 cm, with the two-tier state checks
        DiscreteFcl  ///< OMPL's validator with plain FCL
    };

    const ob::MotionValidator &validatorOf(const Motions &motions, Validator kind)
    {
        switch (kind)
        {
            case Validator::Swept:
                return *motions.swept;
            case Validator::Discrete:
                return *motions.discrete;
            default:
                return *motions.discreteFcl;
        }
    }

    /** \param valid whether to use only free motions, on which a check cannot end early */
    void motionCheck(benchmark::State &state, Validator kind, bool valid)
    {
        static std::vector<std::unique_ptr<Motions>> worlds;
        static std::vector<std::pair<std::size_t, std::size_t>> all, free;  // world, motion
        if (worlds.empty())
            for (std::uint64_t seed = 2000; seed < 2008; ++seed)
            {
                worlds.push_back(std::make_unique<Motions>(seed, 1000));
                for (std::size_t i = 0; i < worlds.back()->ends.size(); ++i)
                {
                    const auto &[from, to] = worlds.back()->ends[i];
                    all.emplace_back(worlds.size() - 1, i);
                    if (worlds.back()->swept->checkMotion(from.get(), to.get()))
                        free.push_back(all.back());
                }
            }
        const auto &chosen = valid ? free : all;
        std::size_t i = 0;
        for (auto _ : state)
        {
            const auto &[world, motion] = chosen[i];
            const auto &[from, to] = worlds[world]->ends[motion];
            benchmark::DoNotOptimize(validatorOf(*worlds[world], kind).checkMotion(from.get(), to.get()));
            if (++i == chosen.size())
                i = 0;
        }
        state.counters["motions"] = static_cast<double>(chosen.size());
    }

    /** Compares the answers of both validators with the reference checker of the tests, which checks every
        millimetre. */
    void wrongMotions(benchmark::State &state)
    {
        std::size_t motions = 0, free = 0, sweptWrong = 0, discreteWrong = 0, sweptRefused = 0;
        for (auto _ : state)
            for (std::uint64_t seed = 3000; seed < 3050; ++seed)
            {
                const Motions set(seed, 2000);
                for (const auto &[from, to] : set.ends)
                {
                    ReedsSheppCurve curve;
                    set.swept->curveSpace().curve(from.get(), to.get(), curve);
                    Pose pose = poseOf(from.get());
                    bool isFree = true;
                    for (std::size_t i = 0; i < curve.count && isFree; ++i)
                    {
                        const Arc &arc = curve.pieces[i];
                        // A nanometre in either direction is rounding.
                        isFree = set.world.oracle.isArcFree(pose, arc.curvature, arc.length, set.vehicle, 1e-3, -1e-9);
                        pose = advance(pose, arc.curvature, arc.length);
                    }
                    const bool swept = set.swept->checkMotion(from.get(), to.get());
                    const bool discrete = set.discrete->checkMotion(from.get(), to.get());
                    ++motions;
                    free += isFree;
                    sweptWrong += swept && !isFree;
                    discreteWrong += discrete && !isFree;
                    sweptRefused += !swept && isFree;
                }
            }
        state.counters["motions"] = static_cast<double>(motions);
        state.counters["free"] = static_cast<double>(free);
        state.counters["swept accepts wrongly"] = static_cast<double>(sweptWrong);
        state.counters["discrete_2cm accepts wrongly"] = static_cast<double>(discreteWrong);
        state.counters["swept refuses for its tolerance"] = static_cast<double>(sweptRefused);
    }

    // ---- arcs ------------------------------------------------------------------------------------------------------

    /** A pose from which an arc of a metre keeps its distance. */
    struct Arc
    {
        std::size_t world;
        FootprintChecker::SweepStart start;
        Pose pose;
        double curvature, length;
    };

    /** Random arcs of a metre whose minimum clearance is in this interval; full lock to either side, and straight. */
    void sweptArc(benchmark::State &state, double least, double most, bool prepared, bool isHexagon)
    {
        const std::vector<Place> &places = placesOf(false, Surroundings::Mixed);
        std::vector<Arc> arcs;
        Random random(7);
        CheckCounts counts;
        const auto checkerIn = [&](std::size_t world) -> const FootprintChecker &
        {
            return isHexagon ? *places[world].hexagon : *places[world].tiered;
        };
        const double lock = 1.0 / Vehicle().minTurningRadius();
        while (arcs.size() < 2000)
        {
            const std::size_t world = random.index(places.size());
            const FootprintChecker &checker = checkerIn(world);
            const Pose pose = places[world].poses[random.index(places[world].poses.size())];
            const double curvature = (static_cast<double>(random.index(3)) - 1.0) * lock;
            const double length = random.chance(0.5) ? 1.0 : -1.0;
            double clearance = most;
            for (int k = 0; k <= 20 && clearance >= least; ++k)
                clearance = std::min(clearance, checker.clearance(advance(pose, curvature, 0.05 * k * length)));
            if (clearance >= least && clearance < most &&
                checker.freeLength(pose, curvature, length) == std::abs(length))
                arcs.push_back({world, checker.sweepStart(pose, 1e-3, counts), pose, curvature, length});
        }
        std::sort(arcs.begin(), arcs.end(), [](const Arc &a, const Arc &b) { return a.world < b.world; });
        std::size_t i = 0;
        for (auto _ : state)
        {
            const Arc &arc = arcs[i];
            const FootprintChecker &checker = checkerIn(arc.world);
            benchmark::DoNotOptimize(prepared ? checker.freeLength(arc.start, arc.curvature, arc.length, counts)
                                              : checker.freeLength(arc.pose, arc.curvature, arc.length, 1e-3, counts));
            if (++i == arcs.size())
                i = 0;
        }
    }

    // ---- building --------------------------------------------------------------------------------------------------

    /** A map with cells of 5 cm: walls, blocks, and single cells of sensor noise. */
    OccupancyGrid randomMap(std::size_t side)
    {
        Random random(side);
        OccupancyGrid grid(side, side, 0.05);
        for (std::size_t i = 0; i < side * side / 500; ++i)
            grid.set(random.index(side), random.index(side), Cell::Occupied);
        for (std::size_t i = 0; i < side / 10; ++i)
        {
            const std::size_t column = random.index(side), row = random.index(side), length = 1 + random.index(100);
            const bool upright = random.chance(0.5);
            for (std::size_t k = 0; k < length; ++k)
                if (upright ? row + k < side : column + k < side)
                    grid.set(upright ? column : column + k, upright ? row + k : row, Cell::Occupied);
        }
        return grid;
    }

    void distanceField(benchmark::State &state)
    {
        const ObstacleSet obstacles = ObstacleSet::fromGrid(randomMap(static_cast<std::size_t>(state.range(0))));
        for (auto _ : state)
            benchmark::DoNotOptimize(DistanceField(obstacles).lowerBound(0.0, 0.0));
    }

    /** All steps between a map and the first check: obstacles, field and index of edges. */
    void checkerOfMap(benchmark::State &state)
    {
        const OccupancyGrid grid = randomMap(static_cast<std::size_t>(state.range(0)));
        for (auto _ : state)
            benchmark::DoNotOptimize(FootprintChecker(ObstacleSet::fromGrid(grid), {}).farthestPoint());
    }

    void checkerOfPolygons(benchmark::State &state)
    {
        const World world = parking_test::randomPolygonWorld(1);
        for (auto _ : state)
            benchmark::DoNotOptimize(FootprintChecker(world.obstacles, {}).farthestPoint());
    }

    void registerAll()
    {
        const std::vector<std::pair<std::string, Checker>> kinds{
            {"plain_fcl", Checker::PlainFcl}, {"two_tier", Checker::Tiered}, {"hexagon", Checker::Hexagon}};
        for (const auto &[name, kind] : kinds)
        {
            for (const bool grids : {false, true})
                for (const auto &[where, surroundings] : {std::pair("free", Surroundings::Free),
                                                          {"mixed", Surroundings::Mixed},
                                                          {"tight", Surroundings::Tight}})
                    benchmark::RegisterBenchmark(
                        (std::string("stateCheck/") + (grids ? "grid/" : "polygons/") + where + "/" + name).c_str(),
                        stateCheck, grids, surroundings, kind);
            benchmark::RegisterBenchmark(("stateCheck/search/both_ends/" + name).c_str(), stateCheck, false,
                                         Surroundings::Search, kind);
            benchmark::RegisterBenchmark(("stateCheck/search/from_slot/" + name).c_str(), stateCheck, false,
                                         Surroundings::FromSlot, kind);
        }
        for (const auto &[name, kind] : {std::pair("swept", Validator::Swept),
                                         {"discrete_2cm", Validator::Discrete},
                                         {"discrete_2cm_plain_fcl", Validator::DiscreteFcl}})
        {
            for (const bool valid : {false, true})
                benchmark::RegisterBenchmark(
                    (std::string("motionCheck/") + (valid ? "valid/" : "random/") + name).c_str(), motionCheck, kind,
                    valid)
                    ->Unit(benchmark::kMicrosecond);
        }
        benchmark::RegisterBenchmark("wrongMotions", wrongMotions)->Iterations(1)->Unit(benchmark::kSecond);
        for (const auto &[how, prepared, isHexagon] :
             {std::tuple("", false, false), {"/prepared", true, false}, {"/prepared/hexagon", true, true}})
        {
            benchmark::RegisterBenchmark((std::string("sweptArc1m/free") + how).c_str(), sweptArc, 3.0, 100.0, prepared,
                                         isHexagon);
            benchmark::RegisterBenchmark((std::string("sweptArc1m/clearance_20cm") + how).c_str(), sweptArc, 0.15, 0.25,
                                         prepared, isHexagon);
        }
        using Named = std::pair<const char *, void (*)(benchmark::State &)>;
        for (const auto &[name, build] : {Named("distanceField", distanceField), Named("checkerOfMap", checkerOfMap)})
            benchmark::RegisterBenchmark(name, build)
                ->Arg(200)
                ->Arg(500)
                ->Arg(1000)
                ->Arg(2000)
                ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark("checkerOfPolygons", checkerOfPolygons)->Unit(benchmark::kMillisecond);
    }
}  // namespace

int main(int argc, char **argv)
{
    registerAll();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
