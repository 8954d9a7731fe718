#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/referee/FreeSpace.h"

#include <cstddef>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Fault of a path. */
    enum class Fault
    {
        None,         ///< the path is valid
        NoPath,       ///< the path has no state
        NotFinite,    ///< a number is NaN, infinite or far outside of the world
        WrongStart,   ///< the path does not begin at the start
        MissesGoal,   ///< the path should end at a goal but does not
        NotDrivable,  ///< the curvature is too large for the car, or it would have to turn on the spot
        Collision     ///< the shape touches an obstacle or leaves the world
    };

    /** \brief Name of a fault in results: none, no_path, not_finite, wrong_start, misses_goal, not_drivable or
        collision. */
    std::string toString(Fault fault);

    /** \brief Result of the referee. The default is that of a missing path. */
    struct Verdict
    {
        bool valid{false};              ///< whether the path has no fault
        Fault fault{Fault::NoPath};     ///< first fault along the path; None if valid
        std::string reason{"no path"};  ///< fault and position in a few words; empty if valid
        std::size_t states{0};          ///< number of poses checked
        std::size_t collisions{0};      ///< number of poses in collision
        double maxCurvature{0.0};       ///< largest magnitude of the curvature along the path, 1/m
    };

    /** \brief Independent check of a finished path: whether it leads from the start to a goal, suits the car and is
        free.

        The referee ignores the planner's own results and shares only geometric types with the planners. Separate code
        checks the path in steps between which no point of the body moves farther than STEP. It skips poses that the
        distance to the nearest obstacle proves free, which does not change the verdict. */
    class Referee
    {
    public:
        static constexpr double STEP = 0.005;  ///< largest motion of the body between two checked poses, metres
        /** Largest deviation of the ends of a path from the start and the goal, in metres and radians. It allows for
            the rounding of long paths. */
        static constexpr double TOLERANCE = 1e-4;
        /** Largest distance of a pose from the world and largest length of a path, metres. */
        static constexpr double MAX_DISTANCE = 1e6;
        /** Number of poses in collision after which the check ends. */
        static constexpr std::size_t MAX_COLLISIONS = 1000000;

        static constexpr double CLEARANCE = 0.002;  ///< absolute tolerance of minClearance(), metres

        /** \brief Checks the car's body or, if \e circleRadius is positive, a disc about its rear axle. */
        explicit Referee(const Scenario &scenario, double circleRadius = 0.0);

        /** \brief Collision test of the shape. */
        const FreeSpace &space() const
        {
            return space_;
        }

        /** \brief Checks that \e path is finite, leads from the start to a goal, is drivable and free.

            \param exact whether the path must end at a goal */
        Verdict check(const Path &path, bool exact = true) const;

        /** \brief Checks straight lines between poses along which the heading changes linearly, as in a plain SE2
            space.

            The curvature limit does not apply to such motions, which no car can drive.
            \param exact whether the lines must end at a goal */
        Verdict checkLines(const std::vector<Pose> &poses, bool exact = true) const;

        /** \brief Minimum distance in metres between the shape and the obstacles along a finite path; 0 if it touches
            one.

            The result is never too small. It is too large by at most CLEARANCE or one percent. */
        double minClearance(const Path &path) const;

        /** \brief Minimum distance in metres between the shape and the obstacles along lines as in checkLines(), with
            at least one pose. The tolerance is that for paths. */
        double minClearance(const std::vector<Pose> &poses) const;

        /** \brief Whether the pose is finite and at most MAX_DISTANCE from the world. */
        bool isPlace(const Pose &pose) const;

    private:
        class Walk;
        class NearestApproach;

        Vehicle vehicle_;
        Pose start_;
        std::vector<Pose> goals_;
        Box bounds_;
        FreeSpace space_;
        bool isDisc_;
    };

    /** \brief Checks a single path, like Referee(scenario).check(path). */
    Verdict check(const Scenario &scenario, const Path &path);
}  // namespace parking
