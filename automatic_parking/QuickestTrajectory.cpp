#include "automatic_parking/QuickestTrajectory.h"

#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double SWEEP_TOLERANCE = 1e-3;  // metres kept from obstacles by the search
        constexpr double SAME_LENGTH = 1e-3;      // metres by which equal paths differ

        /** Metres that a change of direction, and turning the wheels to full lock, are worth where seconds count. */
        constexpr double GEAR_CHANGE = 10.0, STEERING_CHANGE = 0.1;

        /** What makes the search prefer paths that are driven quickly. Chosen on queries of seeds tuneA and tuneB: wide
            arcs leave the wheels time to turn, and a search that is less hasty finds other ways round. */
        struct Taste
        {
            double radius;  // in turning radii of the car
            double haste;   // weight of the heuristic
        };

        constexpr std::array<Taste, 3> TASTES{Taste{1.25, 1.5}, Taste{1.1, 1.0}, Taste{1.5, 1.5}};

        bool isKnown(const Path &path, const Path &other)
        {
            return path.pieces.size() == other.pieces.size() && path.cusps() == other.cusps() &&
                   std::abs(path.length() - other.length()) < SAME_LENGTH;
        }
    }  // namespace

    std::vector<Path> alternativePaths(const FootprintChecker &checker, const Box &bounds, const Path &path,
                                       const QuickestTrajectoryOptions &options,
                                       const std::function<bool()> &interrupted)
    {
        const Vehicle &car = checker.vehicle();
        FootprintEnvironment environment(checker, bounds, SWEEP_TOLERANCE);
        std::vector<Path> found;
        std::uint64_t expanded = 0;
        for (const Taste &taste : TASTES)
        {
            if (expanded >= options.mostExpansions)
                break;
            search::PlanRequest request;
            request.starts = {path.start};
            request.goals = {path.end()};
            request.car = {car.minTurningRadius() * taste.radius, options.forwardOnly,
                           car.inscribedRadius(checker.margin()), bounds};
            request.parameters.gearChangePenalty = GEAR_CHANGE;
            request.parameters.steeringChangePenalty = STEERING_CHANGE;
            request.parameters.heuristicWeightFar = request.parameters.heuristicWeightNear = taste.haste;
            request.parameters.approximate = false;
            request.maxExpansions = options.mostExpansions - expanded;
            if (interrupted)
                request.stop = interrupted;
            const search::PlanResult result = search::plan(environment, request);
            expanded += result.statistics.expanded;
            const auto known = [&result](const Path &other)
            {
                return isKnown(result.path, other);
            };
            if (result.outcome == search::PlanOutcome::Solved && !known(path) &&
                std::none_of(found.begin(), found.end(), known))
                found.push_back(result.path);
        }
        return found;
    }

    QuickestTrajectory quickestTrajectory(const FootprintChecker &checker, const Box &bounds, const Path &path,
                                          const QuickestTrajectoryOptions &options,
                                          const std::function<bool()> &interrupted)
    {
        const TrajectoryOptimizer optimizer(checker, options.trajectory);
        std::vector<Path> paths{path};
        paths.insert(paths.end(), options.others.begin(), options.others.end());
        if (options.alternatives)
            for (Path &each : alternativePaths(checker, bounds, path, options, interrupted))
                paths.push_back(std::move(each));
        QuickestTrajectory result;
        result.paths = paths.size();
        result.trajectory = optimizer.optimizeBest(paths, interrupted);
        result.path = paths[result.trajectory.path];
        return result;
    }
}  // namespace parking
