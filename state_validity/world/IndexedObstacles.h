#pragma once

#include "parking_geometry/OccupancyGrid.h"
#include "state_validity/DistanceField.h"
#include "state_validity/EdgeIndex.h"
#include "state_validity/ObstacleSet.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

namespace parking
{
    /** \brief The obstacles of a world, their distance field and their edge indices, shared by all checkers of this
        world.

        update() changes cells of a grid world in place. All checkers of the world then use the changed cells. Its cost
        depends on the changed cells and on the reach of the field, not on the size of the map.

        Const calls from several threads are safe. update() requires exclusive access: no other thread may use this
        object or one of its checkers at the same time. A thread that checks during updates requires a copy() of the
        world. */
    class IndexedObstacles
    {
    public:
        /** \brief Reach of a field that covers the fast checks of passenger cars, in metres. */
        static constexpr double LOCAL_REACH = 4.0;

        /** \brief Indexes \e obstacles.

            \param fieldResolution side of the distance field's cells in metres, for polygon worlds; 0 selects it
            \param fieldReach metres up to which the distance field of a grid world is exact. A finite value makes
            update() fast. With an infinite one, update() computes the whole field.
            Throws parking::Error for an invalid resolution or reach. */
        explicit IndexedObstacles(ObstacleSet obstacles, double fieldResolution = 0.0,
                                  double fieldReach = std::numeric_limits<double>::infinity());

        IndexedObstacles(const IndexedObstacles &) = delete;
        IndexedObstacles &operator=(const IndexedObstacles &) = delete;

        /** \brief An independent copy of the current world, at the cost of copying the map and its field. */
        std::shared_ptr<IndexedObstacles> copy() const;

        /** \brief Obstacles of the world. */
        const ObstacleSet &obstacles() const
        {
            return obstacles_;
        }

        /** \brief Distance field of the world. */
        const DistanceField &field() const
        {
            return field_;
        }

        /** \brief The edge index with this reach in metres. It refers to this object, and is shared with other callers
            unless it has pieces of a body (see EdgeIndex). */
        std::shared_ptr<const EdgeIndex> edges(double reach, const std::vector<BodyPiece> &pieces = {}) const;

        /** \brief Changes cells of a grid world in place, see ObstacleSet::update().

            Afterwards all results equal those of an object made from the changed map.
            Throws parking::Error, and changes nothing, for a polygon world and for cells outside of the map. */
        void update(const GridUpdate &update);

        /** \brief Number of updates that have changed an obstacle. */
        std::uint64_t version() const
        {
            return version_;
        }

    private:
        struct Copy
        {
        };
        IndexedObstacles(Copy, const IndexedObstacles &other);

        ObstacleSet obstacles_;
        DistanceField field_;
        std::uint64_t version_{0};
        mutable std::mutex mutex_;  // of the list of indices
        mutable std::vector<std::weak_ptr<EdgeIndex>> indices_;
    };
}  // namespace parking
