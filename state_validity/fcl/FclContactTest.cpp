#include "state_validity/fcl/FclContactTest.h"

#include "state_validity/ConvexDecomposition.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

namespace parking
{
    namespace
    {
        // FCL's default of 1e-6 misses contacts up to 7e-7 m deep where sides are nearly parallel.
        constexpr double SOLVER_TOLERANCE = 1e-10;
        constexpr double HEIGHT = 2.0;  // of obstacles; the body, half as high, lies well inside

        std::shared_ptr<fcl::CollisionGeometryd> makePrism(const Polygon &outline, const Eigen::Vector2d &centre,
                                                           double height)
        {
            const int count = static_cast<int>(outline.size());
            auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
            for (const double z : {-0.5 * height, 0.5 * height})
                for (const Eigen::Vector2d &corner : outline)
                    vertices->emplace_back(corner.x() - centre.x(), corner.y() - centre.y(), z);
            // Each face is given by its number of corners and their indices, counter-clockwise from outside.
            auto faces = std::make_shared<std::vector<int>>();
            faces->push_back(count);
            for (int i = count - 1; i >= 0; --i)
                faces->push_back(i);
            faces->push_back(count);
            for (int i = 0; i < count; ++i)
                faces->push_back(count + i);
            for (int i = 0; i < count; ++i)
            {
                const int next = (i + 1) % count;
                faces->insert(faces->end(), {4, i, next, count + next, count + i});
            }
            return std::make_shared<fcl::Convexd>(vertices, count + 2, faces);
        }

        struct Query
        {
            fcl::CollisionRequestd request;
            fcl::CollisionResultd result;
        };

        bool collidePair(fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *data)
        {
            auto *query = static_cast<Query *>(data);
            fcl::collide(a, b, query->request, query->result);
            return query->result.isCollision();
        }

        /** The obstacles as bodies of FCL, in the local frame.

            Polygons become convex prisms of two metres height, rectangles boxes, the outside of the bounds four boxes.
            A dynamic tree of axis-parallel boxes is the broad phase. The narrow phase is libccd's (the independent
            solver misses deep penetrations of convex bodies). Const calls from several threads are safe. */
        class FclWorld
        {
        public:
            /** \brief \param body the queried body: a box, or a convex prism for each of its pieces

                Throws parking::Error if a polygon is not simple. */
            FclWorld(const ObstacleSet &obstacles, const Body &body);

            /** \brief Whether the body with the bounding rectangle \e box touches an obstacle, by FCL. */
            bool collides(const OrientedBox &box) const;

        private:
            void add(const std::shared_ptr<fcl::CollisionGeometryd> &geometry, const fcl::Transform3d &pose);
            void addBox(const Eigen::Vector2d &min, const Eigen::Vector2d &max);

            std::vector<fcl::CollisionObjectd> body_;  ///< its parts, copied for each query
            std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
            fcl::DynamicAABBTreeCollisionManagerd manager_;
        };

        FclWorld::FclWorld(const ObstacleSet &obstacles, const Body &body)
        {
            if (body.pieces.empty())
                body_.emplace_back(
                    std::make_shared<fcl::Boxd>(2.0 * body.halfLength, 2.0 * body.halfWidth, 0.5 * HEIGHT));
            for (const Polygon &piece : body.polygons())
                body_.emplace_back(makePrism(piece, {0.0, 0.0}, 0.5 * HEIGHT));
            for (const Polygon &polygon : obstacles.polygons())
                for (const Polygon &piece : convexPieces(polygon))
                {
                    Eigen::Vector2d centre(0.0, 0.0);
                    for (const Eigen::Vector2d &corner : piece)
                        centre += corner / static_cast<double>(piece.size());
                    fcl::Transform3d pose = fcl::Transform3d::Identity();
                    pose.translation() = fcl::Vector3d(centre.x(), centre.y(), 0.0);
                    add(makePrism(piece, centre, HEIGHT), pose);
                }
            for (const Box &rectangle : obstacles.rectangles())
                addBox(rectangle.min, rectangle.max);

            const Eigen::Vector2d &low = obstacles.bounds().min, &high = obstacles.bounds().max;
            const double thick = 10.0 + (high - low).norm();
            addBox({low.x() - thick, low.y() - thick}, {low.x(), high.y() + thick});
            addBox({high.x(), low.y() - thick}, {high.x() + thick, high.y() + thick});
            addBox({low.x(), low.y() - thick}, {high.x(), low.y()});
            addBox({low.x(), high.y()}, {high.x(), high.y() + thick});

            std::vector<fcl::CollisionObjectd *> all;
            for (const auto &object : objects_)
                all.push_back(object.get());
            manager_.registerObjects(all);
            manager_.setup();
        }

        void FclWorld::add(const std::shared_ptr<fcl::CollisionGeometryd> &geometry, const fcl::Transform3d &pose)
        {
            objects_.push_back(std::make_unique<fcl::CollisionObjectd>(geometry, pose));
            objects_.back()->computeAABB();
        }

        void FclWorld::addBox(const Eigen::Vector2d &min, const Eigen::Vector2d &max)
        {
            const Eigen::Vector2d size = max - min, centre = 0.5 * (min + max);
            fcl::Transform3d pose = fcl::Transform3d::Identity();
            pose.translation() = fcl::Vector3d(centre.x(), centre.y(), 0.0);
            add(std::make_shared<fcl::Boxd>(size.x(), size.y(), HEIGHT), pose);
        }

        bool FclWorld::collides(const OrientedBox &box) const
        {
            fcl::Transform3d pose = fcl::Transform3d::Identity();
            pose.linear()(0, 0) = box.cosine;
            pose.linear()(0, 1) = -box.sine;
            pose.linear()(1, 0) = box.sine;
            pose.linear()(1, 1) = box.cosine;
            pose.translation() = fcl::Vector3d(box.x, box.y, 0.0);
            // A copy shares the shape. Another object would write to the shape while other threads read it.
            return std::any_of(body_.begin(), body_.end(),
                               [&](fcl::CollisionObjectd part)
                               {
                                   part.setTransform(pose);
                                   part.computeAABB();
                                   Query query;
                                   query.request = fcl::CollisionRequestd(1, false);
                                   query.request.gjk_solver_type = fcl::GST_LIBCCD;
                                   query.request.gjk_tolerance = SOLVER_TOLERANCE;
                                   manager_.collide(&part, &query, collidePair);
                                   return query.result.isCollision();
                               });
        }
    }  // namespace

    ContactTestMaker fclContactTest()
    {
        return [](const ObstacleSet &obstacles, const Body &body) -> ContactTest
        {
            return [world = std::make_shared<const FclWorld>(obstacles, body)](const OrientedBox &box)
            {
                return world->collides(box);
            };
        };
    }

    PlainFclChecker::PlainFclChecker(ObstacleSet obstacles, const Vehicle &vehicle, double margin)
      : obstacles_(std::move(obstacles)),
        body_(vehicle, margin),
        touches_(fclContactTest()(obstacles_, body_))
    {
    }

    bool PlainFclChecker::isFree(const Pose &pose) const
    {
        return isFinite(pose) && !touches_(body_.at(obstacles_.toLocal(pose)));
    }
}  // namespace parking
