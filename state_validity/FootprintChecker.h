#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/Body.h"
#include "state_validity/ContactTest.h"
#include "state_validity/DistanceField.h"
#include "state_validity/EdgeIndex.h"
#include "state_validity/ObstacleSet.h"
#include "state_validity/world/IndexedObstacles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace parking
{
    /** \brief Number of poses that each tier has decided. */
    struct CheckCounts
    {
        std::uint64_t states{0};         ///< number of poses checked
        std::uint64_t byField{0};        ///< decided by a single value of the distance field
        std::uint64_t byCircles{0};      ///< decided by the covering or inscribed circles
        std::uint64_t byEdges{0};        ///< decided by the separation from the obstacles' edges
        std::uint64_t byContactTest{0};  ///< within CONTACT_BAND of contact: decided by the contact test

        /** \brief Adds the counts of each tier. */
        CheckCounts &operator+=(const CheckCounts &other);
    };

    /** \brief Collision test, clearance and sweeps of the car's body, a rectangle or any simple polygon.

        Three tiers decide a pose. Each one returns a certain result or leaves the decision to the next:
        1. The distance field at the centre of the body is compared with the radii of the circumscribed and the
           inscribed circle. Then the field is evaluated for circles that cover the body (free if all are) and circles
           inside of it (collision if one collides).
        2. The separation of the body from the edges near it is computed (separating axes). If it is positive, the body
           crosses no outline. It is then wholly outside or wholly inside of each obstacle, which the field at its
           centre determines.
        3. Within CONTACT_BAND of contact, where rounding matters: up to half the band the body touches, above it the
           contact test decides if there is one. Sweeps use the same rule, so a car can leave every free pose.

        A body with an outline is tested as convex pieces, see Body. The margin and the tolerance of a sweep enlarge
       them as documented there.

        Poses are in the coordinates of the obstacle set. Const calls from several threads are safe. The class does not
        depend on OMPL and FCL. FclFootprintChecker is its interface to OMPL, fclContactTest() a contact test. */
    class FootprintChecker
    {
    public:
        /** \brief Half width in metres of the band about contact in which the contact test decides. */
        static constexpr double CONTACT_BAND = 1e-9;

        /** \brief Largest tolerance of sweeps in metres. */
        static constexpr double MAX_TOLERANCE = 0.3;

        /** \brief A checker for a vehicle among obstacles.

            \param margin metres by which the body is enlarged on each side, not negative
            \param contact makes the contact test, called for the first pose that requires it; may be empty
            \param fieldResolution side of the distance field's cells in metres; 0 selects it automatically
            Throws parking::Error for an invalid vehicle, margin or field resolution, and if the enlarged body is larger
            than the world. */
        FootprintChecker(ObstacleSet obstacles, const Vehicle &vehicle, double margin = 0.0,
                         ContactTestMaker contact = {}, double fieldResolution = 0.0);

        /** \brief A checker that shares \e obstacles with others and uses their cells as they are at each call. */
        FootprintChecker(std::shared_ptr<const IndexedObstacles> obstacles, const Vehicle &vehicle, double margin = 0.0,
                         ContactTestMaker contact = {});

        /** \brief The car, without the margin. */
        const Vehicle &vehicle() const
        {
            return vehicle_;
        }

        /** \brief Metres by which the body is enlarged on each side. */
        double margin() const
        {
            return margin_;
        }

        /** \brief The body with the margin. */
        const Body &body() const
        {
            return body_;
        }

        /** \brief Obstacles of the world. */
        const ObstacleSet &obstacles() const
        {
            return obstacles_;
        }

        /** \brief Distance field of the first tier. */
        const DistanceField &field() const
        {
            return field_;
        }

        /** \brief Whether the body touches no obstacle. False for poses that are not finite. */
        bool isFree(const Pose &pose) const;

        /** \brief Whether the body touches no obstacle. Adds the deciding tier to \e counts. */
        bool isFree(const Pose &pose, CheckCounts &counts) const;

        /** \brief Lower bound of the distance between the body and the obstacles in metres; 0 if they may touch.

            Up to one metre the result is exact unless a corner of the body faces a corner of an obstacle. It is then at
            least 0.7 of the distance. Beyond, the error of the distance field reduces it. */
        double clearance(const Pose &pose) const;

        /** \brief Lower bound of the clearance that stops at the first bound of at least \e enough metres. Adds the
            deciding tier to \e counts. */
        double clearance(const Pose &pose, double enough, CheckCounts &counts) const;

        /** \brief Whether clearance() is at least \e clearance metres, faster than by computing it. Adds the deciding
            tier to \e counts. */
        bool keeps(const Pose &pose, double clearance, CheckCounts &counts) const;

        /** \brief Distance in metres between the body and the nearest obstacle, exact up to rounding; 0 if they touch.
            The function is slow if no obstacle is within a metre. */
        double exactClearance(const Pose &pose) const;

        /** \brief Length that the car can drive along an arc without touching an obstacle, computed without sampling.

            The function sweeps the body, enlarged by \e tolerance on each side, along the arc. It computes the first
            contact with each edge near the path in closed form (see SweepFront). If the distance field proves that no
            edge is near, it skips the edges.

            The enlargement covers all rounding errors, so a motion with a contact is never reported as free. A motion
            that passes nearer than 1.5 times the tolerance may be shortened. A start nearer than that uses a smaller
            enlargement, so a car can drive away from an obstacle that it almost touches.

            \param length signed metres
            \param tolerance metres, positive and at most MAX_TOLERANCE, otherwise parking::Error
            \return the length that is proven free: |length| if the whole arc is free, otherwise that to the obstacle
            less the tolerance; 0 if the pose is not free or an argument is not finite */
        double freeLength(const Pose &from, double curvature, double length, double tolerance,
                          CheckCounts &counts) const;

        /** \brief Length that the car can drive along an arc without touching an obstacle, with a tolerance of one
            millimetre. */
        double freeLength(const Pose &from, double curvature, double length) const;

        /** \brief A pose prepared for freeLength(), for callers that sweep several arcs from it. */
        struct SweepStart
        {
            OrientedBox box;   ///< body in the local frame
            double tolerance;  ///< tolerance of the sweeps, metres
            /** Metres by which the sweeps enlarge the body; negative if the pose is not free. */
            double enlargement;
            /** Metres that the enlarged body may move in any direction; negative values allow no motion. */
            double clearance;
        };

        /** \brief Prepares a pose for freeLength(). \param tolerance metres, positive and at most MAX_TOLERANCE */
        SweepStart sweepStart(const Pose &from, double tolerance, CheckCounts &counts) const;

        /** \brief Length that the car can drive along an arc from a prepared pose without touching an obstacle. The
            result is that of freeLength() for this pose. */
        double freeLength(const SweepStart &start, double curvature, double length, CheckCounts &counts) const;

        /** \brief Metres that the fastest point of the body moves per metre of the rear axle on an arc of this
            curvature. */
        double speedFactor(double curvature) const;

        /** \brief Largest distance of a point of the body from the rear axle's midpoint. */
        double farthestPoint() const
        {
            return farthest_;
        }

    private:
        OrientedBox boxAt(const Pose &local) const;
        Eigen::Vector2d innerPoint(const OrientedBox &box) const;
        void drive(OrientedBox &box, double chord, double cosine, double sine) const;
        double clearanceByField(const OrientedBox &box, double lower, double enough) const;
        bool isInsideObstacle(const OrientedBox &box) const;
        bool touches(const OrientedBox &box) const;

        struct Circle
        {
            double offset;  // of its centre from the body's centre, along the body
            double radius;
        };

        std::shared_ptr<const IndexedObstacles> world_;
        const ObstacleSet &obstacles_;  // of world_, as is field_
        const DistanceField &field_;
        Vehicle vehicle_;
        double margin_;
        Body body_;
        double centreOffset_;  // of the body's centre ahead of the rear axle
        double halfLength_, halfWidth_;
        double circumradius_, inradius_, farthest_;
        std::vector<Circle> covering_, inscribed_;
        std::shared_ptr<const EdgeIndex> index_;
        const EdgeIndex &edges_;  // index_
        ContactTestMaker makeContactTest_;
        mutable std::mutex contactMutex_;
        mutable ContactTest contactTest_;
        mutable std::uint64_t contactVersion_{0};  // of the world, when the contact test was made
    };
}  // namespace parking
