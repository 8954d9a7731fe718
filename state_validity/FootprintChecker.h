#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/ContactTest.h"
#include "state_validity/DistanceField.h"
#include "state_validity/EdgeIndex.h"
#include "state_validity/ObstacleSet.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace parking
{
    /** \brief Which tier decided how many poses. */
    struct CheckCounts
    {
        std::uint64_t states{0};         ///< poses asked about
        std::uint64_t byField{0};        ///< decided by one look at the distance field
        std::uint64_t byCircles{0};      ///< decided by the covering or inscribed circles
        std::uint64_t byEdges{0};        ///< decided by the separation from the obstacles' edges
        std::uint64_t byContactTest{0};  ///< within CONTACT_BAND of contact: decided by the contact test

        /** \brief Adds up, tier by tier. */
        CheckCounts &operator+=(const CheckCounts &other);
    };

    /** \brief Does the car's rectangle touch an obstacle, and how far is it from them?

        Three tiers, each sure of its answer or silent:
        1. The distance field at the centre of the body, against the body's circumscribed and inscribed circle, then at
          the centres of circles that cover the body (all clear: free) and of circles inscribed in it (one hit:
          collision).
        2. The separation of the body from the edges of the obstacles near it (separating axes). A positive one means
          that no outline is crossed, so that the body lies wholly outside or wholly inside of every obstacle, and the
          field at its centre tells which.
        3. The contact test that the checker was given, for bodies within CONTACT_BAND of touching, where rounding
          decides. Without one they count as touching.

        Poses are in the coordinates of the obstacle set. Const calls from several threads are safe. This class knows
        nothing of OMPL and FCL; FclFootprintChecker is its face in OMPL, fclContactTest() a contact test. */
    class FootprintChecker
    {
    public:
        /** \brief Half width in metres of the band round contact inside of which the contact test decides. */
        static constexpr double CONTACT_BAND = 1e-9;

        /** \brief The largest tolerance in metres that motions are swept with. */
        static constexpr double MAX_TOLERANCE = 0.3;

        /** \brief \param margin metres by which the body is enlarged on each of its four sides, not negative
            \param contact what makes the contact test, called with the first pose that needs it; may be empty
            \param fieldResolution side of the distance field's cells in metres; 0 chooses one

            Throws parking::Error for an invalid vehicle, margin or field resolution, and when the enlarged body is
            larger than the world. */
        FootprintChecker(ObstacleSet obstacles, const Vehicle &vehicle, double margin = 0.0,
                         ContactTestMaker contact = {}, double fieldResolution = 0.0);

        /** \brief The car, without the margin. */
        const Vehicle &vehicle() const
        {
            return vehicle_;
        }

        /** \brief Metres by which the body is enlarged on each of its four sides. */
        double margin() const
        {
            return margin_;
        }

        /** \brief What the body must not touch. */
        const ObstacleSet &obstacles() const
        {
            return obstacles_;
        }

        /** \brief The distances that the first tier looks at. */
        const DistanceField &field() const
        {
            return field_;
        }

        /** \brief Is the body free of obstacles? False for poses that are not finite. */
        bool isFree(const Pose &pose) const;

        /** \brief As isFree(), counting in \e counts which tier decided. */
        bool isFree(const Pose &pose, CheckCounts &counts) const;

        /** \brief A lower bound of the distance between the body and the obstacles in metres; 0 when they may touch.

            Within reach (one metre) it is exact but where a corner of the body faces a corner of an obstacle, and then
            at least 0.7 of the distance; beyond it may be lower by the error of the field. */
        double clearance(const Pose &pose) const;

        /** \brief As clearance(), but content with less: stops at the first bound that is at least \e enough. */
        double clearance(const Pose &pose, double enough, CheckCounts &counts) const;

        /** \brief Is clearance() at least so many metres? Cheaper than asking how large it is. */
        bool keeps(const Pose &pose, double clearance, CheckCounts &counts) const;

        /** \brief The distance between the body and the nearest obstacle up to rounding; 0 when they touch. For
           reports: costly where no obstacle is within a metre. */
        double exactClearance(const Pose &pose) const;

        /** \brief How far the car can drive along an arc without touching an obstacle: exact, not sampled.

            The body, enlarged by \e tolerance on each side, is swept along the arc, and the first contact with every
            edge near the way is computed in closed form (see SweepFront). Where the distance field shows that nothing
            is near, no edge is looked at. The enlargement stands for all rounding, so a motion during which the body
            touches an obstacle is never called free; one that passes nearer than 1.5 times the tolerance may be cut
            short. A start that is nearer than that is given a smaller enlargement, so that a car can drive away from
            what it all but touches.

            \param length signed metres
            \param tolerance metres, positive and at most MAX_TOLERANCE, otherwise parking::Error
            \return between 0 and |length|: the length that is proven free, less the tolerance where it ends at an
            obstacle; |length| itself when all of it is free; 0 when the pose is not free or an argument is not
            finite */
        double freeLength(const Pose &from, double curvature, double length, double tolerance,
                          CheckCounts &counts) const;

        /** \brief As freeLength() with the default tolerance of one millimetre. */
        double freeLength(const Pose &from, double curvature, double length) const;

        /** \brief A pose prepared for freeLength(), for callers who try several arcs from the same one. */
        struct SweepStart
        {
            OrientedBox box;   ///< the body, local
            double tolerance;  ///< metres
            /** Metres by which the body is enlarged on the way; negative when the pose is not free. */
            double enlargement;
            /** Metres that the enlarged body may move in any way; none when negative. */
            double room;
        };

        /** \brief Prepares a pose. \param tolerance as for freeLength() */
        SweepStart sweepStart(const Pose &from, double tolerance, CheckCounts &counts) const;

        /** \brief freeLength() from a prepared pose: the same result, without looking at the pose again. */
        double freeLength(const SweepStart &start, double curvature, double length, CheckCounts &counts) const;

        /** \brief Metres that the fastest point of the body moves per metre of the rear axle on such an arc. */
        double speedFactor(double curvature) const;

        /** \brief Largest distance of a point of the body from the rear axle's midpoint. */
        double farthestPoint() const
        {
            return farthest_;
        }

    private:
        OrientedBox boxAt(const Pose &local) const;
        void drive(OrientedBox &box, double chord, double cosine, double sine) const;
        double roomRound(const OrientedBox &box, double least, double enough) const;
        bool isInsideObstacle(const OrientedBox &box) const;
        bool touches(const OrientedBox &box) const;

        struct Circle
        {
            double offset;  // of its centre along the body from the body's centre
            double radius;
        };

        ObstacleSet obstacles_;
        Vehicle vehicle_;
        double margin_;
        double centreOffset_;  // of the body's centre ahead of the rear axle
        double halfLength_, halfWidth_;
        double circumradius_, inradius_, farthest_;
        std::vector<Circle> covering_, inscribed_;
        DistanceField field_;
        EdgeIndex edges_;
        ContactTestMaker makeContactTest_;
        mutable std::once_flag contactOnce_;
        mutable ContactTest contactTest_;
    };
}  // namespace parking
