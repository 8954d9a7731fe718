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
    /** \brief What may be wrong with a path. */
    enum class Fault
    {
        None,         ///< nothing is wrong
        NoPath,       ///< there is none: it has no state
        NotFinite,    ///< a number is missing or infinite, or so large that it is no place in the world
        WrongStart,   ///< it begins elsewhere than at the start
        MissesGoal,   ///< it is said to reach a goal and ends elsewhere
        NotDrivable,  ///< the car cannot steer like that, or would have to turn on the spot
        Collision     ///< the shape touches an obstacle, or leaves the world
    };

    /** \brief Names as in results: none, no_path, not_finite, wrong_start, misses_goal, not_drivable, collision. */
    std::string toString(Fault fault);

    /** \brief What the referee found. Without a path nothing is right, which is how it begins. */
    struct Verdict
    {
        bool valid{false};              ///< nothing is wrong
        Fault fault{Fault::NoPath};     ///< the first one found; None when valid
        std::string reason{"no path"};  ///< what and where, in a few words; empty when valid
        std::size_t states{0};          ///< poses decided
        std::size_t collisions{0};      ///< of those in collision
        double maxCurvature{0.0};       ///< 1/m, largest magnitude along the path
    };

    /** \brief Has the last word on a finished path: is it one, from the start to a goal, for this car, in this world?

        Nothing that planners say about their paths is believed, and nothing that they compute with is used here but the
        types of the geometry: path and obstacles are gone through once more by code of its own, in steps between which
        no point of the body moves farther than STEP. Where the distance to the nearest obstacle is more than the body
        moves, the poses up to there are known to be free and are not looked at one by one; the verdict is the same. */
    class Referee
    {
    public:
        static constexpr double STEP = 0.005;  ///< metres
        /** Metres, and radians, that a path may begin off the start and end off the goal. Goals of scenarios are poses:
            this is for the rounding of long paths. */
        static constexpr double TOLERANCE = 1e-4;
        /** Metres: no place farther than this from the world, and no longer drive, is looked at. */
        static constexpr double FARTHEST = 1e6;
        /** Poses in collision after which a path is not looked at any further: kilometres. */
        static constexpr std::size_t MOST_COLLISIONS = 1000000;

        static constexpr double CLEARANCE = 0.002;  ///< metres

        /** \brief For the car's rectangle, or when \e circleRadius is positive for a disc round its rear axle. */
        explicit Referee(const Scenario &scenario, double circleRadius = 0.0);

        /** \brief Where the shape may stand. */
        const FreeSpace &space() const
        {
            return space_;
        }

        /** \brief Is \e path finite, from the start, to a goal, drivable and free?

            \param exact false for one that only comes near to a goal: where it ends is then not looked at */
        Verdict check(const Path &path, bool exact = true) const;

        /** \brief The same of straight lines from pose to pose along which the heading turns evenly, as planners of a
            plain SE2 space mean them. No car drives like that, so drivable is whatever is finite. */
        Verdict checkLines(const std::vector<Pose> &poses, bool exact = true) const;

        /** \brief Metres between the shape and the obstacles, the least along the path, 0 where it touches one: never
           too little, and too much by no more than CLEARANCE or a hundredth of it. The path has to be a finite one. */
        double leastClearance(const Path &path) const;

        /** \brief The same along lines as of checkLines(), of which there has to be at least one pose. */
        double leastClearance(const std::vector<Pose> &poses) const;

        /** \brief Is this a place that can be computed with: finite, and no farther than FARTHEST from the world? */
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

    /** \brief Referee(scenario).check(path). */
    Verdict check(const Scenario &scenario, const Path &path);
}  // namespace parking
