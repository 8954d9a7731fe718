#include "benchmarks/studies/reliability/SoakWorker.h"

#include "benchmarks/problems/PlanRun.h"
#include "benchmarks/problems/Problem.h"
#include "benchmarks/system/ProcessorTime.h"
#include "benchmarks/worlds/PolygonOracle.h"
#include "benchmarks/worlds/RandomWorlds.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "parking_geometry/Error.h"

#include <array>
#include <cmath>
#include <sstream>

namespace parking
{
    using parking_test::Random;

    namespace
    {
        /** Planning ends after so many expansions, which depends on no clock: equal queries have equal answers. */
        constexpr std::uint64_t MOST_EXPANSIONS = 20000, MOST_WHEN_SMALL = 250, MOST_OF_SOME = 1000;
        /** Share of the paths that the oracle of the tests looks at, too. */
        constexpr double ASKED_OF_ORACLE = 0.05;

        search::PlanResult planned(const Scenario &scenario, const FootprintChecker &checker,
                                   std::uint64_t mostExpansions)
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
            return a.pieces.size() == b.pieces.size() &&
                   std::equal(a.pieces.begin(), a.pieces.end(), b.pieces.begin(),
                              [](const PathPiece &p, const PathPiece &q)
                              { return p.curvature == q.curvature && p.length == q.length; });
        }
    }  // namespace

    SoakWorker::SoakWorker(const SoakSettings &settings, std::uint64_t seed, std::atomic<std::uint64_t> &queries)
      : settings_(settings),
        seed_(seed),
        all_(queries),
        random_(seed),
        registry_(PlannerRegistry::builtIn())
    {
    }

    SoakFigures SoakWorker::figures() const
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        return figures_;
    }

    bool SoakWorker::isOver(const std::atomic<bool> &stop) const
    {
        return stop || (settings_.most > 0 && all_ >= settings_.most);
    }

    void SoakWorker::work(const std::atomic<bool> &stop)
    {
        while (!isOver(stop))
        {
            newWorld();
            for (std::size_t i = 0; i < settings_.perWorld && !isOver(stop); ++i)
                query();
        }
    }

    void SoakWorker::newWorld()
    {
        SoakWorld made = settings_.small ? smallSoakWorld(random_) : soakWorld(random_);
        world_ = std::move(made.scenario);
        places_ = std::move(made.places);
        checker_ = std::make_unique<FootprintChecker>(ObstacleSet::fromScenario(world_), world_.vehicle);
        const std::lock_guard<std::mutex> lock(mutex_);
        ++figures_.worlds;
    }

    Pose SoakWorker::anyGoal()
    {
        constexpr double ASIDE = 0.3, TURNED = 0.2;  // metres and radians that a car may stand off a place to park
        if (places_.empty() || !random_.chance(0.6))
            return anywhere();
        const Pose place = places_[random_.index(places_.size())];
        if (random_.chance(0.3))
            return place;
        return compose(
            place, {random_.between(-ASIDE, ASIDE), random_.between(-ASIDE, ASIDE), random_.between(-TURNED, TURNED)});
    }

    Pose SoakWorker::anywhere()
    {
        // Mostly free ones: to be told that a pose is not costs nothing and shows little.
        Pose pose;
        for (int tries = 0; tries < 30; ++tries)
        {
            pose = {random_.between(world_.bounds.min.x(), world_.bounds.max.x()),
                    random_.between(world_.bounds.min.y(), world_.bounds.max.y()), random_.between(-PI, PI)};
            if (checker_->isFree(pose) || random_.chance(0.02))
                break;
        }
        return pose;
    }

    void SoakWorker::query()
    {
        Scenario scenario = world_;
        scenario.start = anywhere();
        scenario.goals = {anyGoal()};
        if (random_.chance(0.1))
            scenario.goals.push_back(anyGoal());
        ++all_;
        const std::uint64_t mostExpansions = !settings_.small      ? MOST_EXPANSIONS
                                             : random_.chance(0.1) ? MOST_OF_SOME
                                                                   : MOST_WHEN_SMALL;
        const double begin = threadProcessorTime();
        const search::PlanResult result = planned(scenario, *checker_, mostExpansions);
        const double time = threadProcessorTime() - begin;
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            ++figures_.queries;
            figures_.planning.add(time);
            figures_.solved += result.outcome == search::PlanOutcome::Solved ? 1 : 0;
        }
        judge(scenario, result);
        if (result.outcome == search::PlanOutcome::Solved && random_.chance(ASKED_OF_ORACLE))
            askOracle(scenario, result.path);
        if (random_.chance(0.01))
        {
            const bool same = equal(planned(scenario, *checker_, mostExpansions).path, result.path);
            const std::lock_guard<std::mutex> lock(mutex_);
            ++figures_.repeated;
            if (!same)
                figures_.disagree("another path when asked again");
        }
        if (settings_.small)
            return;
        if (result.outcome == search::PlanOutcome::Solved && random_.chance(0.1))
            replan(result.path);
        if (random_.chance(0.02))
            askOthers(scenario);
    }

    void SoakWorker::judge(const Scenario &scenario, const search::PlanResult &result)
    {
        const Referee referee(scenario);
        std::string wrong;
        const bool solved = result.outcome == search::PlanOutcome::Solved;
        if (solved || result.outcome == search::PlanOutcome::Approximate)
        {
            const Verdict verdict = referee.check(result.path, solved);
            if (!verdict.valid)
                wrong = toString(verdict.fault) + ": " + verdict.reason;
        }
        else if (result.outcome == search::PlanOutcome::InvalidStart)
        {
            if (referee.space().isFree(scenario.start) && checker_->exactClearance(scenario.start) > 1e-5)
                wrong = "the start is free";
        }
        else if (result.outcome == search::PlanOutcome::InvalidGoal)
        {
            for (const Pose &goal : scenario.goals)
                if (referee.space().isFree(goal) && checker_->exactClearance(goal) > 1e-5)
                    wrong = "a goal is free";
        }
        if (wrong.empty())
            return;
        std::ostringstream text;
        text << "worker " << seed_ << ", query " << figures_.queries << ": " << wrong;
        const std::lock_guard<std::mutex> lock(mutex_);
        figures_.disagree(text.str());
    }

    void SoakWorker::askOracle(const Scenario &scenario, const Path &path)
    {
        constexpr double STEP = 0.005;    // metres between two looks
        constexpr double OVERLAP = 1e-7;  // metres that count as touching, which is free
        const parking_test::PolygonOracle oracle(scenario);
        bool free = true;
        Pose pose = path.start;
        for (const PathPiece &piece : path.pieces)
        {
            free = free && piece.sharpness == 0.0 && piece.turn == 0.0 &&
                   oracle.isArcFree(pose, piece.curvature, piece.length, scenario.vehicle, STEP, -OVERLAP);
            pose = advance(pose, piece);
        }
        const std::lock_guard<std::mutex> lock(mutex_);
        ++figures_.seenByOracle;
        if (!free)
            figures_.disagree("worker " + std::to_string(seed_) + ", query " + std::to_string(figures_.queries) +
                              ": the oracle says that it touches something");
    }

    void SoakWorker::replan(const Path &path)
    {
        if (world_.grid)
            return;
        // Half way there something stands in the way.
        const Path rest = path.rest(0.5 * path.length());
        const Pose now = rest.start, then = rest.end();
        Scenario changed = world_;
        changed.start = {now.x, now.y, wrapAngle(now.yaw)};
        changed.goals = {then};
        const Pose at = path.at(0.75 * path.length());
        changed.polygons.push_back(parking_test::rectangle(random_.between(0.2, 1.5), random_.between(0.2, 1.5),
                                                           {at.x, at.y, random_.between(-PI, PI)}));
        const FootprintChecker checker(ObstacleSet::fromScenario(changed), changed.vehicle);
        const search::PlanResult result = planned(changed, checker, MOST_EXPANSIONS);
        judge(changed, result);
        const std::lock_guard<std::mutex> lock(mutex_);
        ++figures_.replanned;
    }

    void SoakWorker::askOthers(const Scenario &scenario)
    {
        // OMPL has one generator for the seeds of all others: one thread at a time.
        static std::mutex ompl;
        const std::lock_guard<std::mutex> one(ompl);
        static const std::array<const char *, 6> NAMES{"improved_astar", "RRTConnect", "reeds_shepp", "PRM",
                                                       "BKPIECE1",       "SBL"};
        const char *name = NAMES[turn_++ % NAMES.size()];
        std::string wrong;
        try
        {
            const Problem problem(scenario, {});
            const PlanRun run =
                planOnce(problem, registry_.find(name), {}, settings_.timeLimit, 1 + random_.index(1000));
            if (run.status == PlanStatus::Exact && !run.isSolved())
                wrong = std::string(name) + ": " + run.path->recheck.reason;
        }
        catch (const Error &error)
        {
            wrong = std::string(name) + ": " + error.what();
        }
        const std::lock_guard<std::mutex> lock(mutex_);
        ++figures_.byOthers;
        // What others say of their paths is theirs to answer for; that the referee refuses them is what it is there
        // for.
        if (!wrong.empty() && name == NAMES.front())
            figures_.disagree(wrong);
        else if (!wrong.empty())
            ++figures_.refusedOfOthers;
    }
}  // namespace parking
