#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <vector>

namespace parking
{
    /** \brief A piece whose curvature changes linearly with the distance driven; arcs and lines have no sharpness. */
    struct ClothoidSegment
    {
        double curvature{0.0};  ///< 1/m where the piece begins, positive to the left
        double sharpness{0.0};  ///< 1/m^2, change of curvature per metre driven, whichever the direction
        double length{0.0};     ///< metres, negative when driven in reverse

        /** \brief Curvature where the piece ends. */
        double endCurvature() const
        {
            return curvature + sharpness * (length < 0.0 ? -length : length);
        }
    };

    /** \brief The pose after \e driven metres (0 to |length|) of \e segment, to about 1e-12 m. The yaw is not wrapped.
     */
    Pose advance(const Pose &pose, const ClothoidSegment &segment, double driven);

    /** \brief A drivable path in exact form: a start pose and pieces of linear curvature. */
    struct ClothoidPath
    {
        Pose start;
        std::vector<ClothoidSegment> pieces;

        /** \brief Metres driven, both directions counted positive. */
        double length() const;

        /** \brief The pose at the end, yaw wrapped. */
        Pose end() const;

        /** \brief States no more than \e step metres (positive) apart, with every end of a piece among them.

            The curvature of a state is that of the path there (where two pieces meet with different curvatures, that
            of the earlier one); the first state carries the curvature with which it is left. */
        SampledPath sample(double step) const;

        /** \brief The same with states at even distances, whatever the ends of the pieces: fewer where pieces are
            short. All pieces must have one direction. */
        SampledPath sampleEvenly(double step) const;
    };
}  // namespace parking
