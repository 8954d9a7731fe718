#include "automatic_parking/QuickestTrajectory.h"

#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double SAME_LENGTH = 1e-3;  // metres by which equal paths differ

        /** Costs in metres of a change of direction and of steering to full lock, where time counts. */
        constexpr double GEAR_CHANGE = 10.0, STEERING_CHANGE = 0.1;

        /** Cost parameters that favour paths which are driven quickly. They were chosen from a hundred settings on
            random queries and the known problems. Wide arcs leave time for steering. Further paths result from a less
            greedy search, from one without a clearance cost, and from one with a high cost of reversing. */
        struct SearchSetting
        {
            double radius;           // in turning radii of the car
            double heuristicWeight;  // weight of the heuristic
            bool keepsAway;          // whether there is a clearance cost
            double reversePenalty;   // metres per metre in reverse
            int direction;           // 0 for both, 1 for forwards all the way, -1 for reverse
            std::uint64_t maxExpansions;
        };

        constexpr std::uint64_t ANY = std::numeric_limits<std::uint64_t>::max();

        /** A change of direction costs the time of six metres at full speed: the last two settings avoid it
            completely. */
        constexpr std::array<SearchSetting, 7> SETTINGS{
            SearchSetting{1.1, 1.5, false, 0.0, 0, ANY},  SearchSetting{1.25, 2.5, true, 0.0, 0, ANY},
            SearchSetting{1.25, 1.5, false, 3.0, 0, ANY}, SearchSetting{1.5, 1.5, false, 0.0, 0, ANY},
            SearchSetting{1.1, 1.5, false, 3.0, 0, ANY},  SearchSetting{1.1, 1.5, true, 0.0, 1, 250},
            SearchSetting{1.1, 1.5, true, 0.0, -1, 250}};

        search::PlanRequest requestFor(const SearchSetting &setting, const FootprintChecker &checker, const Box &bounds,
                                       const Path &path, const QuickestTrajectoryOptions &options,
                                       const std::function<bool()> &interrupted)
        {
            search::PlanRequest request;
            // In reverse all the way from start to goal is forwards all the way from goal to start.
            const bool isTurned = setting.direction < 0;
            request.starts = {isTurned ? path.end() : path.start};
            request.goals = {isTurned ? path.start : path.end()};
            request.car = search::carInSpace(checker.vehicle(), checker.margin(), bounds);
            request.car.turningRadius *= setting.radius;
            request.car.forwardOnly = options.forwardOnly || setting.direction != 0;
            request.parameters.gearChangePenalty = GEAR_CHANGE;
            request.parameters.reversePenalty = setting.reversePenalty;
            request.parameters.steeringChangePenalty = STEERING_CHANGE;
            request.parameters.heuristicWeightFar = request.parameters.heuristicWeightNear = setting.heuristicWeight;
            if (!setting.keepsAway)
                request.parameters.clearanceCost = 0.0;
            request.parameters.approximate = false;
            request.maxExpansions = setting.maxExpansions;
            if (interrupted)
                request.stop = interrupted;
            return request;
        }

        /** A path with fewer changes of direction than any known one, but at least one; the last two settings search
            paths without any.

            The search is greedy and ignores clearance, but has many expansions, because the path may be very different.
            It is skipped for long paths, whose searches take long. */
        std::optional<Path> pathWithFewerCusps(FootprintEnvironment &environment, const FootprintChecker &checker,
                                               const Box &bounds, const Path &path, const std::vector<Path> &known,
                                               const QuickestTrajectoryOptions &options,
                                               const std::function<bool()> &interrupted)
        {
            constexpr double LONGEST = 120.0;                                     // metres
            constexpr double MIN = 400.0, PER_SQUARE_METRE = 1.25, MAX = 6000.0;  // expansions
            std::size_t fewest = path.cusps();
            for (const Path &each : known)
                fewest = std::min(fewest, each.cusps());
            const double length = path.length();
            if (fewest < 2 || length > LONGEST || options.maxExpansions == 0)
                return std::nullopt;
            constexpr SearchSetting GREEDY{1.0, 2.5, false, 0.0, 0, ANY};
            search::PlanRequest request = requestFor(GREEDY, checker, bounds, path, options, interrupted);
            request.maxExpansions = static_cast<std::uint64_t>(std::min(MAX, MIN + PER_SQUARE_METRE * length * length));
            request.car.maxCusps = static_cast<std::uint8_t>(std::min<std::size_t>(fewest - 1, search::ANY_CUSPS - 1));
            request.parameters.detours = false;
            search::PlanResult result = search::plan(environment, request);
            if (result.outcome != search::PlanOutcome::Solved || result.path.cusps() >= fewest)
                return std::nullopt;
            return std::move(result.path);
        }

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
        FootprintEnvironment environment(checker, bounds, FootprintEnvironment::TOLERANCE);
        std::vector<Path> found;
        std::uint64_t expanded = 0;
        for (const SearchSetting &setting : SETTINGS)
        {
            if (setting.direction != 0 && options.forwardOnly)
                continue;
            search::PlanRequest request = requestFor(setting, checker, bounds, path, options, interrupted);
            if (setting.direction == 0)
                request.maxExpansions = options.maxExpansions - std::min(options.maxExpansions, expanded);
            if (request.maxExpansions == 0)
                continue;
            search::PlanResult result = search::plan(environment, request);
            if (setting.direction == 0)
                expanded += result.statistics.expanded;
            if (result.outcome != search::PlanOutcome::Solved)
                continue;
            if (setting.direction < 0)
                result.path = result.path.reversed();
            const auto known = [&result](const Path &other)
            {
                return isKnown(result.path, other);
            };
            if (!known(path) && std::none_of(found.begin(), found.end(), known))
                found.push_back(std::move(result.path));
        }
        if (std::optional<Path> fewer =
                pathWithFewerCusps(environment, checker, bounds, path, found, options, interrupted))
            found.push_back(std::move(*fewer));
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
