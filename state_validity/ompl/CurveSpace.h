#pragma once

#include "parking_geometry/curves/Path.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <ompl/base/State.h>
#include <ompl/base/StateSpace.h>

namespace parking
{
    /** \brief Kind of a planar state space of OMPL. */
    enum class SpaceKind
    {
        SE2,         ///< straight lines along which the heading changes linearly
        ReedsShepp,  ///< arcs at the turning radius, forwards and in reverse
        Dubins       ///< arcs at the turning radius, forwards only
    };

    /** \brief The motions of OMPL's planar spaces between two states, as arcs of this project.

        Only this class uses OMPL's own curve types. Const calls from several threads are safe. */
    class CurveSpace
    {
    public:
        /** \brief Inspects \e space, which must outlive this object.

            Throws ompl::Exception unless it is an SE2, Reeds-Shepp or Dubins space. */
        explicit CurveSpace(const ompl::base::StateSpace &space);

        /** \brief Kind of the space. */
        SpaceKind kind() const
        {
            return kind_;
        }

        /** \brief Turning radius of the space's curves in metres, up to rounding; 0 for a plain SE2 space.

            OMPL has no getter for it. The class divides a distance of the space by the known length of the same curve
            for radius 1. */
        double turningRadius() const
        {
            return turningRadius_;
        }

        /** \brief Writes the arcs that the space's interpolate() follows from one state to another into \e curve.

            A symmetric Dubins space drives the curve from \e to to \e from in reverse if it is shorter. Its lengths are
            then negative. Pieces without length are omitted. For states that are not finite, \e curve has no pieces and
            an infinite length.
            Throws ompl::Exception for a plain SE2 space, whose states are joined by straight lines. */
        void curve(const ompl::base::State *from, const ompl::base::State *to, ReedsSheppCurve &curve) const;

        /** \brief Writes the arcs that the space's interpolate() follows between two poses into \e curve. Allocates two
            states for this. */
        void curve(const Pose &from, const Pose &to, ReedsSheppCurve &curve) const;

        /** \brief Adds the curve from one state to another to \e path. Pieces shorter than a tenth of a micrometre are
            rounding of a curve's formula and left out. */
        void append(const ompl::base::State *from, const ompl::base::State *to, Path &path) const;

    private:
        const ompl::base::StateSpace *space_;
        SpaceKind kind_{SpaceKind::SE2};
        double turningRadius_{0.0};
        bool symmetric_{false};  ///< whether a Dubins space takes the shorter curve of both directions
    };
}  // namespace parking
