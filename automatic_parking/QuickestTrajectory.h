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
    /** \brief Options of quickestTrajectory(). */
    struct QuickestTrajectoryOptions
    {
        TrajectoryOptions trajectory;       ///< options of the optimiser
        bool alternatives{true};            ///< whether alternative paths are searched
        std::vector<Path> others;           ///< known alternative paths between the same poses
        bool forwardOnly{false};            ///< whether alternative paths must not drive in reverse
        std::uint64_t maxExpansions{1600};  ///< of the searches for all alternatives in total
    };

    /** \brief A trajectory and the path from which it was optimised. */
    struct QuickestTrajectory
    {
        OptimizedTrajectory trajectory;  ///< the quickest one found
        Path path;                       ///< the given path or an alternative one
        std::size_t paths{1};            ///< number of optimised paths
    };

    /** \brief Alternative paths from the start of \e path to its end.

        The shortest path is not the quickest to drive, because steering and changes of direction take time. The search
        therefore looks for paths with wider arcs, fewer changes of direction and less steering. Paths similar to a
        known one, or to \e path itself, are left out.

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
