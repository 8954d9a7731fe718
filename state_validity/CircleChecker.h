#pragma once

#include "state_validity/DistanceField.h"
#include "state_validity/EdgeIndex.h"
#include "state_validity/ObstacleSet.h"

namespace parking
{
    /** \brief Is a circle free of obstacles, and how far is it from them? The paper's model of the car (section
        "Introducing Vehicle Volume").

        Exact on occupancy grids and among polygons alike: the distance field decides where it can, the distance to the
        obstacles' edges elsewhere. Const calls from several threads are safe. */
    class CircleChecker
    {
    public:
        /** \brief \param radius metres, positive; otherwise parking::Error */
        CircleChecker(ObstacleSet obstacles, double radius);

        /** \brief Is the circle round (x, y), in the coordinates of the obstacle set, free? False where x or y is not
            finite. */
        bool isFree(double x, double y) const;

        /** \brief The distance between the circle and the nearest obstacle; 0 when they touch. Exact up to a metre, a
            lower bound beyond. */
        double clearance(double x, double y) const;

        /** \brief How much of the straight line between two points the circle can go along: 1 when all of it, otherwise
            the share up to where it comes nearer than a millimetre, or than it is at the start if that is less. The
            first point is taken to be free. */
        double freeShare(const Pose &from, const Pose &to) const;

    private:
        double distance(double x, double y) const;

        ObstacleSet obstacles_;
        double radius_;
        DistanceField field_;
        EdgeIndex edges_;
    };
}  // namespace parking
