#pragma once

#include "state_validity/DistanceField.h"
#include "state_validity/EdgeIndex.h"
#include "state_validity/ObstacleSet.h"

namespace parking
{
    /** \brief Collision test and clearance of a circle, the paper's model of the car (section "Introducing Vehicle
        Volume").

        The results are exact for grids and polygons. The distance field decides clear cases, the distance to the
        obstacles' edges the others. Const calls from several threads are safe. */
    class CircleChecker
    {
    public:
        /** \brief A checker for a circle of this radius. Throws parking::Error unless \e radius (metres) is
            positive. */
        CircleChecker(ObstacleSet obstacles, double radius);

        /** \brief Whether the circle about (x, y), in the coordinates of the obstacle set, touches no obstacle. False
            if x or y is not finite. */
        bool isFree(double x, double y) const;

        /** \brief Distance in metres between the circle and the nearest obstacle; 0 if they touch. The result is exact
            up to a metre and a lower bound beyond. */
        double clearance(double x, double y) const;

        /** \brief Share of the straight line between two points along which the circle is free, 1 for the whole line.

            The share ends where the distance to an obstacle falls below a millimetre, or below that at the start if it
            is smaller. The circle at \e from must be free. */
        double freeShare(const Pose &from, const Pose &to) const;

    private:
        double distance(double x, double y) const;

        ObstacleSet obstacles_;
        double radius_;
        DistanceField field_;
        EdgeIndex edges_;
    };
}  // namespace parking
