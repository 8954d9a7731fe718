#pragma once

#include "benchmarks/worlds/PolygonOracle.h"
#include "parking_geometry/FootprintQueries.h"

#include <limits>
#include <utility>
#include <vector>

namespace parking_test
{
    using namespace parking;

    /** An axis-parallel square round (x, y). */
    inline Polygon square(double x, double y, double halfSize)
    {
        return {{x - halfSize, y - halfSize},
                {x + halfSize, y - halfSize},
                {x + halfSize, y + halfSize},
                {x - halfSize, y + halfSize}};
    }

    /** \brief The oracle's answers for one car among polygons, as FootprintQueries give them: touching is free, and the
        world has no bounds. */
    class PolygonWorld
    {
    public:
        /** \param touching how deep a body may reach into an obstacle and still count as touching, metres */
        PolygonWorld(const Vehicle &vehicle, std::vector<Polygon> obstacles, double touching = 1e-9)
          : vehicle_(vehicle),
            oracle_(std::move(obstacles), {{-INFINITE, -INFINITE}, {INFINITE, INFINITE}}),
            touching_(touching)
        {
        }

        bool isFree(const Pose &pose) const
        {
            return oracle_.isFree(pose, vehicle_, -touching_);
        }

        /** The exact distance; 0 when colliding or touching. */
        double clearance(const Pose &pose) const
        {
            return oracle_.clearance(pose, vehicle_);
        }

        /** Callables that refer to this world; isPathFree is left to the library. */
        FootprintQueries queries() const
        {
            FootprintQueries result;
            result.isFree = [this](const Pose &pose)
            {
                return isFree(pose);
            };
            result.clearance = [this](const Pose &pose)
            {
                return clearance(pose);
            };
            return result;
        }

        /** Is the whole motion free, looked at every \e finest metres? */
        bool isPathFree(const Path &path, double finest = 1e-4) const
        {
            return oracle_.isPathFree(path, vehicle_, finest, -touching_);
        }

    private:
        static constexpr double INFINITE = std::numeric_limits<double>::infinity();

        Vehicle vehicle_;
        PolygonOracle oracle_;
        double touching_;
    };
}  // namespace parking_test
