#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "state_validity/FootprintChecker.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace parking
{
    /** \brief How quickestTrajectory() goes about it. */
    struct QuickestTrajectoryOptions
    {
        TrajectoryOptions trajectory;        ///< of the optimiser
        bool alternatives{true};             ///< whether other paths are looked for
        std::vector<Path> others;            ///< known already: other ways between the same poses
        bool forwardOnly{false};             ///< whether those must not drive in reverse
        std::uint64_t mostExpansions{1600};  ///< of the searches for all of them
    };

    /** \brief A trajectory, and the path that it was made from. */
    struct QuickestTrajectory
    {
        OptimizedTrajectory trajectory;  ///< the quickest that was found
        Path path;                       ///< the given path, or one of the others
        std::size_t paths{1};            ///< that were optimised
    };

    /** \brief Other ways from the start of \e path to its end.

        The shortest path is not the quickest to drive: the wheels need time to turn, and a car needs time to change its
        direction. So the search is asked for paths with wider arcs, fewer changes of direction and less steering. Paths
        that are like one that is known are left out; so is \e path itself.

        \param bounds of the rear axle's positions */
    std::vector<Path> alternativePaths(const FootprintChecker &checker, const Box &bounds, const Path &path,
                                       const QuickestTrajectoryOptions &options,
                                       const std::function<bool()> &interrupted = {});

    /** \brief The quickest trajectory near \e path or one of its alternatives. Deterministic unless interrupted.

        Throws parking::Error as TrajectoryOptimizer::optimize() does. */
    QuickestTrajectory quickestTrajectory(const FootprintChecker &checker, const Box &bounds, const Path &path,
                                          const QuickestTrajectoryOptions &options = {},
                                          const std::function<bool()> &interrupted = {});
}  // namespace parking
