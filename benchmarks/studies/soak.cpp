// Plans in random worlds for hours, on several threads, and checks memory, times and answers.

#include "benchmarks/plan/PlanRun.h"
#include "benchmarks/plan/Problem.h"
#include "benchmarks/planners/PlannerRegistry.h"
#include "benchmarks/queries/Queries.h"
#include "benchmarks/system/CommandLine.h"
#include "benchmarks/system/ProcessorTime.h"
#include "benchmarks/worlds/MadeWorlds.h"
#include "benchmarks/worlds/RandomWorlds.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/referee/Referee.h"
#include "state_validity/FootprintChecker.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

#include <ompl/util/Console.h>

namespace
{
    using namespace parking;
    using parking_test::Random;
    using parking_test::World;
    namespace po = boost::program_options;
    using Clock = std::chrono::steady_clock;

    /** Planning ends after this many expansions, independent of a clock: equal queries have equal answers. */
    constexpr std::uint64_t MOST_EXPANSIONS = 20000, MOST_WHEN_SMALL = 250, MOST_OF_SOME = 1000;
    constexpr double TIME_LIMIT = 0.05;  // limit in seconds of each query to a planner of OMPL

    /** Counts durations in classes 5 % apart, from a tenth of a microsecond to hours, in constant memory. */
    class LatencyCounts
    {
    public:
        /** \param time seconds */
        void add(double time)
        {
            const double place = std::log(std::max(time, SHORTEST) / SHORTEST) / std::log(RATIO);
            ++counts_[std::min(static_cast<std::size_t>(place), CLASSES - 1)];
        }

        /** The duration in seconds, rounded up by at most 5 %, that a \e share of all does not exceed; 0 without
            durations. */
        double quantile(double share) const
        {
            const double wanted =
                share * static_cast<double>(std::accumulate(counts_.begin(), counts_.end(), std::uint64_t(0)));
            double seen = 0.0;
            for (std::size_t i = 0; i < CLASSES; ++i)
            {
                seen += static_cast<double>(counts_[i]);
                if (counts_[i] > 0 && seen >= wanted)
                    return SHORTEST * std::pow(RATIO, static_cast<double>(i + 1));
            }
            return 0.0;
        }

    private:
        static constexpr std::size_t CLASSES = 600;
        static constexpr double SHORTEST = 1e-7, RATIO = 1.05;  // seconds; ratio of adjacent classes
        std::array<std::uint64_t, CLASSES> counts_{};
    };

    /** Figures of all workers, which count in one place. */
    struct SoakFigures
    {
        using Count = std::atomic<unsigned long long>;

        Count worlds{0};           ///< number of random worlds
        Count queries{0};          ///< number of random queries to plan()
        Count solved{0};           ///< number of those with a path to a goal
        Count replanned{0};        ///< number of queries from the middle of a path, with a new obstacle on the rest
        Count repeated{0};         ///< number of repeated queries: the path must be equal
        Count seenByOracle{0};     ///< number of paths checked by the reference checker of the tests
        Count byOthers{0};         ///< number of queries to OMPL planners, including this project's
        Count refusedOfOthers{0};  ///< number of exact paths of OMPL's planners that the referee rejects
        Count disagreed{0};        ///< number of wrong answers

        std::mutex mutex;                        ///< protects the members below
        LatencyCounts planning;                  ///< processor time of the queries to plan()
        std::vector<std::string> disagreements;  ///< one line for each of the first hundred wrong answers
    };

    /** Settings of a worker. */
    struct SoakSettings
    {
        bool small{false};         ///< whether to use only small worlds and plan(), for as many queries as possible
        std::size_t perWorld{40};  ///< number of queries per world
        std::uint64_t most{0};     ///< maximum number of queries of all workers; 0: no limit
    };

    search::PlanResult planned(const Scenario &scenario, const FootprintChecker &checker, std::uint64_t mostExpansions)
    {
        FootprintEnvironment environment(checker, scenario.bounds, 1e-3);
        search::PlanRequest request;
        request.starts = {scenario.start};
        request.goals = scenario.goals;
        request.car.turningRadius = scenario.vehicle.minTurningRadius();
        request.car.inscribedRadius = scenario.vehicle.inscribedRadius();
        request.car.bounds = scenario.bounds;
        request.maxExpansions = mostExpansions;
        return plan(environment, request);
    }

    bool equal(const Path &a, const Path &b)
    {
        return std::equal(a.pieces.begin(), a.pieces.end(), b.pieces.begin(), b.pieces.end(),
                          [](const PathPiece &p, const PathPiece &q)
                          { return p.curvature == q.curvature && p.length == q.length; });
    }

    /** A random world. One in seven is a large one as in parking_queries, unless only small ones are wanted. Three cars
       in ten are of the catalogue. */
    World randomWorld(Random &random, bool small)
    {
        const std::vector<std::string> names = vehicleNames(), kinds = parking_test::worldKinds();
        const Vehicle car = random.chance(0.3) ? vehicleByName(names[random.index(names.size())]) : Vehicle();
        const std::uint64_t seed = random.bits();
        const auto make = [&](std::size_t kind) -> World
        {
            switch (kind)
            {
                case 0:
                    return parking_test::randomPolygonWorld(seed);
                case 1:
                    return parking_test::randomGridWorld(seed);
                case 2:
                    return parking_test::noisyGridWorld(seed);
                case 3:
                    return parking_test::parkingRowsWorld(seed, car);
                case 4:
                    return parking_test::baysWorld(seed, car);
                case 5:
                    return parking_test::lanesWorld(seed);
                default:
                    break;
            }
            const std::string &name = kinds[random.index(kinds.size())];
            World world(queryWorld(name, parking_test::madeWorld(name, std::to_string(seed)), car).scenario);
            world.name = name + " " + std::to_string(seed);
            return world;
        };
        World world = make(random.index(small ? 6 : 7));
        world.scenario.vehicle = car;
        return world;
    }

    /** Plans in random worlds in one thread and lets the referee check every answer. */
    class SoakWorker
    {
    public:
        /** \param seed of all random numbers of this worker
            \param figures of all workers; must outlive them */
        SoakWorker(const SoakSettings &settings, std::uint64_t seed, SoakFigures &figures)
          : settings_(settings),
            seed_(seed),
            figures_(figures),
            random_(seed),
            registry_(PlannerRegistry::builtIn())
        {
        }

        /** Works until \e stop is true. */
        void work(const std::atomic<bool> &stop)
        {
            const auto isOver = [&]
            {
                return stop || (settings_.most > 0 && figures_.queries >= settings_.most);
            };
            while (!isOver())
            {
                world_ = std::make_unique<World>(randomWorld(random_, settings_.small));
                checker_ = std::make_unique<FootprintChecker>(world_->obstacles, world_->scenario.vehicle);
                ++figures_.worlds;
                for (std::size_t i = 0; i < settings_.perWorld && !isOver(); ++i)
                    query();
            }
        }

    private:
        void disagree(const std::string &what)
        {
            constexpr std::size_t MOST = 100;
            ++figures_.disagreed;
            const std::lock_guard<std::mutex> lock(figures_.mutex);
            if (figures_.disagreements.size() < MOST)
                figures_.disagreements.push_back("worker " + std::to_string(seed_) + ", query " +
                                                 std::to_string(queries_) + ", " + world_->name + ": " + what);
        }

        Pose anyGoal()
        {
            constexpr double ASIDE = 0.3, TURNED = 0.2;  // maximum offset in metres and radians from a place to park
            if (world_->places.empty() || !random_.chance(0.6))
                return anywhere();
            const Pose place = world_->places[random_.index(world_->places.size())];
            if (random_.chance(0.3))
                return place;
            return compose(place, {random_.between(-ASIDE, ASIDE), random_.between(-ASIDE, ASIDE),
                                   random_.between(-TURNED, TURNED)});
        }

        Pose anywhere()
        {
            // Mostly free ones: collisions take no time and test little.
            Pose pose;
            for (int attempts = 0; attempts < 30; ++attempts)
            {
                pose = world_->anywhere(random_);
                if (checker_->isFree(pose) || random_.chance(0.02))
                    break;
            }
            return pose;
        }

        void query()
        {
            Scenario scenario = world_->scenario;
            scenario.start = anywhere();
            scenario.goals = {anyGoal()};
            if (random_.chance(0.1))
                scenario.goals.push_back(anyGoal());
            ++queries_;
            ++figures_.queries;
            const std::uint64_t mostExpansions = !settings_.small      ? MOST_EXPANSIONS
                                                 : random_.chance(0.1) ? MOST_OF_SOME
                                                                       : MOST_WHEN_SMALL;
            const double begin = threadProcessorTime();
            const search::PlanResult result = planned(scenario, *checker_, mostExpansions);
            const double time = threadProcessorTime() - begin;
            const bool solved = result.outcome == search::PlanOutcome::Solved;
            figures_.solved += solved ? 1 : 0;
            {
                const std::lock_guard<std::mutex> lock(figures_.mutex);
                figures_.planning.add(time);
            }
            checkResult(scenario, *checker_, result);
            if (solved && random_.chance(0.05))
                askOracle(scenario, result.path);
            if (random_.chance(0.01))
            {
                ++figures_.repeated;
                if (!equal(planned(scenario, *checker_, mostExpansions).path, result.path))
                    disagree("another path for an equal query");
            }
            if (settings_.small)
                return;
            if (solved && random_.chance(0.1))
                replan(result.path);
            if (random_.chance(0.02))
                askOthers(scenario);
        }

        void checkResult(const Scenario &scenario, const FootprintChecker &checker, const search::PlanResult &result)
        {
            const Referee referee(scenario);
            const auto isFree = [&](const Pose &pose)
            {
                return referee.space().isFree(pose) && checker.exactClearance(pose) > 1e-5;
            };
            const bool solved = result.outcome == search::PlanOutcome::Solved;
            if (solved || result.outcome == search::PlanOutcome::Approximate)
            {
                const Verdict verdict = referee.check(result.path, solved);
                if (!verdict.valid)
                    disagree(toString(verdict.fault) + ": " + verdict.reason);
            }
            else if (result.outcome == search::PlanOutcome::InvalidStart && isFree(scenario.start))
                disagree("the start is free");
            else if (result.outcome == search::PlanOutcome::InvalidGoal &&
                     std::any_of(scenario.goals.begin(), scenario.goals.end(), isFree))
                disagree("a goal is free");
        }

        void askOracle(const Scenario &scenario, const Path &path)
        {
            constexpr double STEP = 0.005;    // metres between two checks
            constexpr double OVERLAP = 1e-7;  // metres of overlap that count as contact, which is free
            ++figures_.seenByOracle;
            if (!world_->oracle.isPathFree(path, scenario.vehicle, STEP, -OVERLAP))
                disagree("the reference checker reports a collision");
        }

        void replan(const Path &path)
        {
            if (world_->scenario.grid)
                return;
            // Puts an obstacle in the middle of the path.
            const Path rest = path.rest(0.5 * path.length());
            Scenario changed = world_->scenario;
            changed.start = {rest.start.x, rest.start.y, wrapAngle(rest.start.yaw)};
            changed.goals = {rest.end()};
            const Pose at = path.at(0.75 * path.length());
            const double length = random_.between(0.2, 1.5), width = random_.between(0.2, 1.5);
            changed.polygons.push_back(parking_test::rectangle(length, width, {at.x, at.y, random_.between(-PI, PI)}));
            const FootprintChecker checker(ObstacleSet::fromScenario(changed), changed.vehicle);
            checkResult(changed, checker, planned(changed, checker, MOST_EXPANSIONS));
            ++figures_.replanned;
        }

        void askOthers(const Scenario &scenario)
        {
            // OMPL has one generator for the seeds of all others: one thread at a time.
            static std::mutex ompl;
            const std::lock_guard<std::mutex> one(ompl);
            static const std::array<const char *, 6> NAMES{"improved_astar", "RRTConnect", "reeds_shepp", "PRM",
                                                           "BKPIECE1",       "SBL"};
            const char *name = NAMES[turn_++ % NAMES.size()];
            ++figures_.byOthers;
            std::string wrong;
            try
            {
                const Problem problem(scenario, {});
                const PlanRun run = planOnce(problem, registry_.find(name), {}, TIME_LIMIT, 1 + random_.index(1000));
                if (run.status == PlanStatus::Exact && !run.isSolved())
                    wrong = run.path->recheck.reason;
            }
            catch (const Error &error)
            {
                wrong = error.what();
            }
            // Invalid paths of other planners are their own faults; the referee must detect them.
            if (!wrong.empty() && name == NAMES.front())
                disagree(std::string(name) + ": " + wrong);
            else if (!wrong.empty())
                ++figures_.refusedOfOthers;
        }

        SoakSettings settings_;
        std::uint64_t seed_;
        SoakFigures &figures_;
        std::uint64_t queries_{0};  // queries of this worker
        Random random_;
        PlannerRegistry registry_;
        std::size_t turn_{0};  // queries of this worker to the other planners
        std::unique_ptr<World> world_;
        std::unique_ptr<FootprintChecker> checker_;
    };

    /** MB of memory in use by this process; 0 if unknown. */
    double memoryInUse()
    {
        std::ifstream stream("/proc/self/statm");
        double all = 0.0, resident = 0.0;
        stream >> all >> resident;
        return stream ? resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6 : 0.0;
    }

    double seconds(Clock::time_point begin)
    {
        return std::chrono::duration<double>(Clock::now() - begin).count();
    }

    std::string line(SoakFigures &figures, double time, double memory)
    {
        const auto count = [](const SoakFigures::Count &each)
        {
            return each.load();
        };
        const std::lock_guard<std::mutex> lock(figures.mutex);
        const double share = static_cast<double>(figures.solved) / std::max(1.0, static_cast<double>(figures.queries));
        char text[400];
        std::snprintf(
            text, sizeof text,
            "%7.0f s  %10llu queries (%.1f %% solved), %llu worlds, replanned %llu, repeated %llu, checked by "
            "the reference %llu, others %llu (%llu refused) | %.2f ms median, %.1f ms 99 %%, %.1f ms 99.9 %% | "
            "%.0f MB | %llu disagreements",
            time, count(figures.queries), 100.0 * share, count(figures.worlds), count(figures.replanned),
            count(figures.repeated), count(figures.seenByOracle), count(figures.byOthers),
            count(figures.refusedOfOthers), 1e3 * figures.planning.quantile(0.5), 1e3 * figures.planning.quantile(0.99),
            1e3 * figures.planning.quantile(0.999), memory, count(figures.disagreed));
        return text;
    }

    int run(const std::vector<std::string> &arguments)
    {
        po::options_description options("Options");
        auto add = options.add_options();
        add("minutes", oneValue("N"), "duration (default 60)");
        add("queries", oneValue("N"), "end after N queries");
        add("threads", oneValue("N"), "number of threads (default: one per core)");
        add("seed", oneValue("N"), "seed of the worlds (default 1)");
        add("small", "use only small worlds and plan(), for as many queries as possible");
        add("growth", oneValue("MB"), "maximum memory growth after the first tenth of the time (default 200)");
        add("every", oneValue("S"), "seconds between two lines (default 60)");
        add("help", "print this text");
        const CommandLine given(arguments, options, {});
        if (given.given("help"))
        {
            std::cout
                << "usage: soak [options]\n\nPlans in random worlds, lets the referee check every answer, and monitors "
                   "memory.\n\nExamples:\n  soak --minutes 1 --small\n  soak --queries 1000 --threads 2 --seed 7\n\n"
                << options << "\nStatus: 0 no faults, 1 an answer is wrong or memory has grown, 2 invalid usage\n";
            return 0;
        }
        ompl::msg::noOutputHandler();
        SoakSettings settings;
        settings.small = given.given("small");
        settings.perWorld = settings.small ? 200 : 40;
        settings.most = given.whole("queries", 1, std::numeric_limits<std::uint32_t>::max()).value_or(0);
        const double limit = 60.0 * given.positive("minutes").value_or(settings.most > 0 ? 1e9 : 60.0);
        const double mayGrow = given.positive("growth").value_or(200.0);
        const double every = given.positive("every").value_or(60.0);
        const std::size_t threads =
            given.whole("threads", 1, 1024).value_or(std::max(1U, std::thread::hardware_concurrency()));
        const std::uint64_t seed = given.whole("seed", 1, 1000000000).value_or(1);

        SoakFigures figures;
        std::atomic<bool> stop{false};
        const Clock::time_point begin = Clock::now();
        std::vector<std::thread> running;
        for (std::size_t i = 0; i < threads; ++i)
            running.emplace_back([&settings, &figures, &stop, worker = 1000 * seed + i]
                                 { SoakWorker(settings, worker, figures).work(stop); });
        double settled = 0.0, most = 0.0, reported = 0.0;
        for (double now = 0.0; now < limit && (settings.most == 0 || figures.queries < settings.most);
             now = seconds(begin))
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            const double memory = memoryInUse();
            most = std::max(most, memory);
            const bool begins = settings.most > 0 ? figures.queries < settings.most / 10 : now < 0.1 * limit;
            if (begins)
                settled = std::max(settled, memory);
            if (now - reported >= every)
            {
                reported = now;
                std::cerr << line(figures, now, memory) << std::endl;
            }
        }
        stop = true;
        for (std::thread &each : running)
            each.join();
        std::cout << line(figures, seconds(begin), memoryInUse()) << "\n";
        std::printf("memory: maximum %.0f MB in the first tenth, %.0f MB in total; %zu threads\n", settled, most,
                    threads);
        for (const std::string &each : figures.disagreements)
            std::cout << each << "\n";
        const bool grown = most > settled + mayGrow;
        if (grown)
            std::cout << "memory has grown by more than " << mayGrow << " MB\n";
        return figures.disagreed > 0 || grown ? 1 : 0;
    }
}  // namespace

int main(int argc, char **argv)
{
    return parking::runProgram("soak", argc, argv, run);
}
