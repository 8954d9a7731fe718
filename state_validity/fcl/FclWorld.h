#pragma once

#include "state_validity/EdgeIndex.h"
#include "state_validity/ObstacleSet.h"

#include <memory>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

namespace parking
{
    /** \brief The obstacles as bodies of FCL, in the local frame.

        Polygons become convex prisms of two metres height, rectangles boxes, the outside of the bounds four boxes; a
        dynamic tree of axis-parallel boxes is the broad phase. The narrow phase is libccd's (the independent solver
        misses deep penetrations of convex bodies). Const calls from several threads are safe. */
    class FclWorld
    {
    public:
        /** \brief \param halfLength, halfWidth of the boxes that will be asked about, in metres

            Throws parking::Error when a polygon is not simple. */
        FclWorld(const ObstacleSet &obstacles, double halfLength, double halfWidth);

        /** \brief Does the box touch any obstacle, in FCL's judgement? Its size is that given to the constructor. */
        bool collides(const OrientedBox &box) const;

        /** \brief Number of bodies, the four of the bounds included. */
        std::size_t size() const
        {
            return objects_.size();
        }

    private:
        void add(const std::shared_ptr<fcl::CollisionGeometryd> &geometry, const fcl::Transform3d &pose);
        void addBox(const Eigen::Vector2d &min, const Eigen::Vector2d &max);

        fcl::CollisionObjectd body_;  ///< copied for each question
        std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
        fcl::DynamicAABBTreeCollisionManagerd manager_;
    };
}  // namespace parking
