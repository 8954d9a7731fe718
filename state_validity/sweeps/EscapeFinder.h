#pragma once

#include "parking_geometry/OrientedBox.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/EdgeIndex.h"
#include "state_validity/FootprintChecker.h"
#include "state_validity/sweeps/Escape.h"

#include <vector>

namespace parking
{
    /** \brief Finds escapes from shallow contact, such as those that a wrong pose estimate or a coarse map cause.

        The depth of a contact is the smallest distance by which all sides of the body must move inwards so that it
        touches nothing. The body is the vehicle's rectangle with the checker's margin. */
    class EscapeFinder
    {
    public:
        /** \brief Metres by which the depth may exceed its minimum so far during an escape. */
        static constexpr double DEPTH_TOLERANCE = 1e-4;

        /** \brief A finder in the world of \e checker, which must outlive it. */
        explicit EscapeFinder(const FootprintChecker &checker);

        /** \brief Depth of the contact at \e pose in metres, rounded up to a micrometre; 0 for a free pose, infinite
            if it exceeds \e maxDepth or a quarter of the body's width. */
        double depth(const Pose &pose, double maxDepth) const;

        /** \brief Escapes from a pose in contact, shortest first; empty if there are none, or the contact is deeper
            than \e maxDepth metres.

            An escape is a straight line or one of several arcs, at most as long as the body. Along it the depth does
            not rise by more than DEPTH_TOLERANCE. This is proven by sweeping the body, with its sides moved inwards by
            the smallest depth so far, over each part of the motion.

            \param turningRadius minimum turning radius, metres
            \param forwardOnly whether the car cannot reverse */
        std::vector<Escape> find(const Pose &pose, double maxDepth, double turningRadius, bool forwardOnly) const;

    private:
        OrientedBox shrunkBody(const Pose &pose, double by) const;
        bool isFree(const Pose &pose, double depth) const;
        bool isStepFree(const Pose &from, const Arc &step, double depth) const;
        double escapeLength(const Pose &from, const Arc &direction, double depth) const;

        const FootprintChecker &checker_;
        double centreOffset_, halfLength_, halfWidth_;
        EdgeIndex edges_;
    };
}  // namespace parking
