#pragma once

#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Polygon.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <optional>
#include <vector>

namespace parking_test
{
    /** \brief Reference for all other collision checks: whether a car's rectangle touches an obstacle.

        It shares no code with the library, for obvious correctness. Every obstacle is transformed into the frame of the
        car in extended precision, where the body is an axis-parallel rectangle round the origin. Obstacles are solid
        and closed, so that contact is a collision. The outside of the bounds, and the bounds themselves, are an
        obstacle. It is exact up to about 1e-15 m, also for coordinates in the billions, since these are subtracted from
        each other first. */
    class PolygonOracle
    {
    public:
        /** \brief Solid polygons, of any orientation, within \e bounds, which may be infinite. */
        PolygonOracle(std::vector<parking::Polygon> obstacles, const parking::Box &bounds);

        /** \brief The occupied cells of \e grid, including unknown ones by default. */
        explicit PolygonOracle(const parking::OccupancyGrid &grid, bool unknownIsOccupied = true);

        /** \brief The obstacles of the scenario in its local coordinates: a grid, or polygons within its bounds. */
        explicit PolygonOracle(const parking::Scenario &scenario);

        /** \brief Whether the body is free at \e pose.

            \param margin metres by which the body is enlarged on each side; negative to shrink it. Around an outline
           the enlarged body is the area within that distance. */
        bool isFree(const parking::Pose &pose, const parking::Vehicle &vehicle, double margin = 0.0) const;

        /** \brief The distance between the body and the nearest obstacle; 0 in contact. Not for grids. */
        double clearance(const parking::Pose &pose, const parking::Vehicle &vehicle, double margin = 0.0) const;

        /** \brief Whether the body is free at both ends of an arc, and every \e step metres between them.

            Steps are skipped if the body is free even when enlarged by more than its motion.

            \param length signed metres */
        bool isArcFree(const parking::Pose &from, double curvature, double length, const parking::Vehicle &vehicle,
                       double step, double margin = 0.0) const;

        /** \brief Whether the body is free along a path, every \e step metres. In turns on the spot the farthest corner
            moves by at most \e step. */
        bool isPathFree(const parking::Path &path, const parking::Vehicle &vehicle, double step,
                        double margin = 0.0) const;

    private:
        struct Body;

        bool isFreeOfCells(const Body &world) const;

        std::vector<parking::Polygon> obstacles_;
        std::vector<parking::Box> boxes_;  ///< bounding box of each obstacle
        parking::Box bounds_;
        std::optional<parking::OccupancyGrid> grid_;
        bool unknownIsOccupied_{true};
    };
}  // namespace parking_test
