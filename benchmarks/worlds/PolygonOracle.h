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
    /** \brief Says whether a car's rectangle touches an obstacle: the judge of all other collision tests.

        Written to be obviously right, with nothing of the library in it: every obstacle is carried into the frame of
        the car in extended precision, where the body is an axis-parallel rectangle round the origin. Obstacles are
        solid and closed, so touching is a collision; the outside of the bounds, and the bounds themselves, are an
        obstacle. Exact up to about 1e-15 m, also where coordinates are in the billions: they are subtracted from each
        other before anything else. */
    class PolygonOracle
    {
    public:
        /** \brief Solid polygons, of any orientation, within \e bounds, which may be infinite. */
        PolygonOracle(std::vector<parking::Polygon> obstacles, const parking::Box &bounds);

        /** \brief The cells of \e grid that are occupied, those that are unknown too unless told otherwise. */
        explicit PolygonOracle(const parking::OccupancyGrid &grid, bool unknownIsOccupied = true);

        /** \brief What the scenario has: a grid, or polygons within its bounds; in its local coordinates. */
        explicit PolygonOracle(const parking::Scenario &scenario);

        /** \param margin metres by which the body is enlarged on each side; negative to shrink it */
        bool isFree(const parking::Pose &pose, const parking::Vehicle &vehicle, double margin = 0.0) const;

        /** \brief The distance between the body and the nearest obstacle; 0 when they touch. Not for grids. */
        double clearance(const parking::Pose &pose, const parking::Vehicle &vehicle, double margin = 0.0) const;

        /** \brief Is the body free at both ends of an arc, and every \e step metres between them?

            Steps are left out where the body is free even when enlarged by more than it moves until then.

            \param length signed metres */
        bool isArcFree(const parking::Pose &from, double curvature, double length, const parking::Vehicle &vehicle,
                       double step, double margin = 0.0) const;

        /** \brief Likewise of a whole path; turning on the spot, the farthest corner moves by \e step at most. */
        bool isPathFree(const parking::Path &path, const parking::Vehicle &vehicle, double step,
                        double margin = 0.0) const;

    private:
        struct Body;

        bool isFreeOfCells(const Body &world) const;

        std::vector<parking::Polygon> obstacles_;
        std::vector<parking::Box> boxes_;  ///< round each obstacle
        parking::Box bounds_;
        std::optional<parking::OccupancyGrid> grid_;
        bool unknownIsOccupied_{true};
    };
}  // namespace parking_test
