#pragma once

#include "parking_geometry/curves/ReedsShepp.h"

#include <ompl/base/State.h>
#include <ompl/base/StateSpace.h>

namespace parking
{
    /** \brief Which of OMPL's planar spaces a space is. */
    enum class SpaceKind
    {
        SE2,         ///< straight lines, along which the heading turns evenly
        ReedsShepp,  ///< arcs at the turning radius, forwards and in reverse
        Dubins       ///< the same, forwards only
    };

    /** \brief What OMPL's planar spaces do between two states, in the terms of this project.

        The only part of the project that touches OMPL's own curve types. Const calls from several threads are safe. */
    class CurveSpace
    {
    public:
        /** \brief Looks at \e space, which must outlive this object.

            Throws ompl::Exception when it is neither an SE2, nor a Reeds-Shepp, nor a Dubins space. */
        explicit CurveSpace(const ompl::base::StateSpace &space);

        /** \brief Which of them this one is. */
        SpaceKind kind() const
        {
            return kind_;
        }

        /** \brief The radius that the space's curves turn with, in metres, up to rounding; 0 for a plain SE2 space.

            OMPL has no getter for it. Its distance is the radius times the length of the curve for radius 1, and that
            length is at hand. */
        double turningRadius() const
        {
            return turningRadius_;
        }

        /** \brief The arcs that the space's interpolate() follows from one state to another, in its order.

            Dubins spaces made symmetric drive the curve from \e to back in reverse where that one is shorter; the
            lengths are negative then. Pieces without length are left out. Where there is no curve (states that are not
            finite) the length of \e curve is infinite and it has no pieces.

            Not for a plain SE2 space, whose states are joined by straight lines: throws ompl::Exception. */
        void curve(const ompl::base::State *from, const ompl::base::State *to, ReedsSheppCurve &curve) const;

        /** \brief The same between states at two poses, which it allocates. */
        void curve(const Pose &from, const Pose &to, ReedsSheppCurve &curve) const;

    private:
        const ompl::base::StateSpace *space_;
        SpaceKind kind_{SpaceKind::SE2};
        double turningRadius_{0.0};
        bool symmetric_{false};  ///< a Dubins space that takes the shorter curve of the two directions
    };
}  // namespace parking
