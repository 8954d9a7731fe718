#pragma once

#include "parking_geometry/Pose.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace parking
{
    /** \brief Median, 99th percentile and maximum of a set of durations (nearest rank; 0 for an empty set). */
    struct TimeStatistics
    {
        double median{0.0};  ///< in the unit of the values
        double p99{0.0};     ///< likewise
        double max{0.0};     ///< likewise
    };

    /** \brief Statistics of \e values, which need no order; in their unit. */
    TimeStatistics timeStatistics(std::vector<double> values);

    /** \brief The paper's evaluation parameters of a drive ("Evaluation Parameters"; planning time is the planner's),
        and what else is worth knowing.

        The paper leaves its averages undefined. Here: every average is over time, from the first command to the last
        standstill, standstills included; accelerations and steering angles enter with their absolute value. */
    struct Evaluation
    {
        double plannedLength{0.0};        ///< metres of the reference
        double drivenLength{0.0};         ///< metres of the rear axle, both directions counted positive
        double plannedTime{0.0};          ///< seconds of the timed reference
        double travelTime{0.0};           ///< seconds from the first command to the last standstill
        double meanAbsAcceleration{0.0};  ///< m/s^2, time average of |dv/dt|
        double meanAbsSteering{0.0};      ///< radians, time average of |delta|
        double maxCrossTrack{0.0};        ///< metres, largest distance of the rear axle from the reference's leg
        double meanCrossTrack{0.0};       ///< metres, time average of it while on a leg
        double maxPositionError{0.0};     ///< metres, largest distance from the nearest place of the leg, its ends too
        double maxHeadingError{0.0};      ///< radians, against the heading at the nearest place of the leg
        double finalPositionError{0.0};   ///< metres from the last pose of the path as it was given
        double finalYawError{0.0};        ///< radians, absolute, likewise
        double finalReferenceError{0.0};  ///< metres from the last pose of the reference (differs by rounded corners)
        double cornerDeviation{0.0};      ///< metres between path and reference, where it has sharp corners
        /** Metres, least of the clearances along the drive; infinity without a clearance to ask. */
        double minClearance{std::numeric_limits<double>::infinity()};
        std::size_t collisions{0};      ///< checked poses in collision
        std::size_t checkedPoses{0};    ///< 0 when there was nobody to ask
        std::size_t standstills{0};     ///< between legs
        TimeStatistics solveTime;       ///< seconds per optimisation
        std::size_t solves{0};          ///< optimisations, one for each period on a leg
        std::size_t solverFailures{0};  ///< of these, with an answer that was of no use
    };
}  // namespace parking
