#pragma once

#include "parking_geometry/Pose.h"

namespace parking::search
{
    /** \brief What the grid search asks of the world. */
    class GridEnvironment
    {
    public:
        virtual ~GridEnvironment() = default;

        /** \brief Is the car free of obstacles at \e pose? */
        virtual bool isFree(const Pose &pose) = 0;

        /** \brief Is the straight motion, with the heading turning evenly along it, free? \e from is known to be, \e to
            may not be. */
        virtual bool isMotionFree(const Pose &from, const Pose &to) = 0;

        /** \brief Does isFree() depend on the heading? Not so for the paper's circle round the car. */
        virtual bool headingMatters() const = 0;
    };
}  // namespace parking::search
