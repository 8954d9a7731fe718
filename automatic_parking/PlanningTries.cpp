#include "automatic_parking/PlanningTries.h"

#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/manoeuvres/MultiStretchParking.h"
#include "state_validity/sweeps/PathSweep.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace parking::planning
{
    Rung rungInStretches(double gap, double radius, const PlanningTuning &tuning)
    {
        return {gap, radius, gap - tuning.sweepTolerance, 0.5 * gap};
    }

    Tries::Tries(const Scenario &scenario, const PlanningParameters &parameters, const ParkingWorld &world,
                 double startRoom, bool onlyWayIn)
      : scenario_(scenario),
        parameters_(parameters),
        world_(world),
        startRoom_(startRoom),
        onlyWayIn_(onlyWayIn),
        inStretches_(parameters.wayIn == WayIn::InStretches)
    {
    }

    Tries::Checkers Tries::checkers(const Rung &rung)
    {
        const Stopwatch loading;
        Checkers body{world_.enlarged(rung.searchMargin), nullptr};
        body.check = rung.checkMargin == rung.searchMargin ? body.search : world_.enlarged(rung.checkMargin);
        loadingTime_ += loading.seconds();
        return body;
    }

    Candidate Tries::find(Rung rung, bool last)
    {
        Checkers body = checkers(rung);
        if (!body.search || !body.check)
            return {};
        const bool constructed = scenario_.slot && parameters_.wayIn != WayIn::Searched;
        std::vector<ReverseParkingResult> ways;
        if (constructed)
            ways = waysIn(rung, body);
        // What was not found out of the slot is not looked for into it.
        if (ways.empty() && (onlyWayIn_ || (constructed && inStretches_)))
            return {};
        Candidate best;
        if (onlyWayIn_)
        {
            best.manoeuvre = ways.front();
            best.cost = 0.0;
        }
        else
        {
            const double most = parameters_.tuning.shareOfStartGap * startRoom_;
            if (inStretches_ && most < rung.gap)
            {
                rung = rungInStretches(most, rung.radius, parameters_.tuning);
                body = checkers(rung);
            }
            if (!ways.empty())
                best = throughManoeuvre(ways, fromStart(rung), *body.search);
            if (!best.found() || !inStretches_)
            {
                Candidate whole = allTheWay(fromStart(rung), *body.search, last);
                if (whole.cost * parameters_.tuning.manoeuvrePreference < best.cost)
                    best = std::move(whole);
            }
        }
        best.rung = rung;
        best.checker = body.check;
        best.stretches = ways.empty() ? 0 : ways.front().path.stretches().size();
        return best;
    }

    Tries::SearchTask Tries::fromStart(const Rung &rung) const
    {
        return {scenario_.start,
                {},
                scenario_.bounds,
                rung.radius,
                parameters_.gearChangePenalty,
                true,
                parameters_.expansionsPerGap};
    }

    ReverseParkingOptions Tries::sweepOptions(const Rung &rung) const
    {
        ReverseParkingOptions sweep = parameters_.sweep;
        sweep.clearance = inStretches_ ? rung.gap : 0.0;  // otherwise the checker has it already
        if (!inStretches_ && sweep.preferredRadius == 0.0)
            sweep.preferredRadius =
                std::max(rung.radius, parameters_.tuning.manoeuvreRadius * scenario_.vehicle.minTurningRadius());
        return sweep;
    }

    std::vector<ReverseParkingResult> Tries::waysIn(const Rung &rung, const Checkers &body)
    {
        const ReverseParking parking(scenario_.vehicle, sweepOptions(rung));
        const FootprintQueries queries = queriesOf(*body.check);
        std::vector<ReverseParkingResult> ways = parking.planAll(*scenario_.slot, queries);
        ReverseParkingResult result = ways.front();
        ways.erase(
            std::remove_if(ways.begin(), ways.end(),
                           [](const ReverseParkingResult &way) { return !way.fits() || way.path.pieces.empty(); }),
            ways.end());
        if (!ways.empty())
            return ways;
        if (inStretches_)
        {
            result = planInStretches(parking, *scenario_.slot, queries,
                                     [&](const SlotExitTask &task)
                                     {
                                         return search(*body.search, {task.parked, task.exits, Box{task.min, task.max},
                                                                      rung.radius, parameters_.tuning.gearChangeInSlot,
                                                                      false, parameters_.expansionsPerGap});
                                     });
            if (result.fits())
                return {std::move(result)};
            result.message += "; nor was a way in several stretches found";
        }
        if (!verdict_)
            verdict_ = std::move(result);
        return ways;
    }

    Candidate Tries::throughManoeuvre(const std::vector<ReverseParkingResult> &ways, SearchTask task,
                                      const FootprintChecker &checker)
    {
        Candidate candidate;
        for (const ReverseParkingResult &way : ways)
            task.to.push_back(way.path.start);
        candidate.approach = search(checker, task);
        for (const ReverseParkingResult &way : ways)
            if (isSamePose(candidate.approach.end(), way.path.start, SAME_POSE))
            {
                candidate.manoeuvre = way;
                candidate.goal = way.goal;
                candidate.arcs = joined(candidate.approach, way.path);
                candidate.cost = cost(candidate.arcs);
                break;
            }
        return candidate;
    }

    Candidate Tries::allTheWay(SearchTask task, const FootprintChecker &checker, bool last)
    {
        Candidate candidate;
        if (inStretches_)
            task.gearChange = parameters_.tuning.gearChangeInSlot;
        if (last && std::isfinite(parameters_.timeLimit))
            task.expansions = 0;
        std::copy_if(scenario_.goals.begin(), scenario_.goals.end(), std::back_inserter(task.to),
                     [&checker](const Pose &goal) { return checker.isFree(goal); });
        if (task.to.empty())
            return candidate;
        candidate.approach = candidate.arcs = search(checker, task);
        if (candidate.arcs.pieces.empty())
            return candidate;
        for (const Pose &goal : task.to)
            if (isSamePose(candidate.arcs.end(), goal, SAME_POSE))
                candidate.goal = goal;
        candidate.cost = cost(candidate.arcs);
        return candidate;
    }

    Path Tries::search(const FootprintChecker &checker, const SearchTask &task)
    {
        ++count_;
        FootprintEnvironment environment(checker, task.bounds, parameters_.tuning.sweepTolerance);
        search::PlanRequest request;
        request.starts = {task.from};
        request.goals = task.to;
        request.car = search::carInSpace(checker.vehicle(), checker.margin(), task.bounds);
        request.car.turningRadius = task.radius;
        request.parameters.bidirectional = task.bothSides;
        request.parameters.searchFrom = task.bothSides ? "goal" : "start";
        request.parameters.gearChangePenalty = task.gearChange;
        request.parameters.steeringChangePenalty = parameters_.steeringChangePenalty;
        request.parameters.preferredClearance = parameters_.preferredClearance;
        request.parameters.clearanceCost = parameters_.clearanceCost;
        request.parameters.detours = task.bothSides;  // out of a slot they lead in more stretches
        request.parameters.approximate = false;
        request.maxExpansions = task.expansions;
        request.stop = [this, isLast = task.expansions == 0]
        {
            return isLast ? isOver() : isLate();
        };
        search::PlanResult result = search::plan(environment, request);
        statistics_ += result.statistics;
        return result.outcome == search::PlanOutcome::Solved ? std::move(result.path) : Path{task.from, {}};
    }

    double Tries::cost(const Path &path) const
    {
        FootprintEnvironment environment(world_.footprint(), scenario_.bounds, parameters_.tuning.sweepTolerance);
        search::CostModel model;
        model.gearChangePenalty = parameters_.gearChangePenalty;
        model.steeringChangePenalty = parameters_.steeringChangePenalty;
        model.fullLockCurvature = 1.0 / scenario_.vehicle.minTurningRadius();
        model.preferredClearance = parameters_.preferredClearance;
        model.clearanceCost = parameters_.clearanceCost;
        return search::pathCost(model, path, environment);
    }
}  // namespace parking::planning
