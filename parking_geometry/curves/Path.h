#pragma once

#include "parking_geometry/Pose.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief A motion of constant curvature: an arc of a circle or a straight line. */
    struct Arc
    {
        double curvature{0.0};  ///< 1/m, positive to the left
        double length{0.0};     ///< metres, negative when driven in reverse
    };

    /** \brief A piece of a Path: a drive whose curvature is linear in the distance, or a turn on the spot.

        A piece with sharpness 0 is an arc or a straight line, any other drive is a clothoid. Cars cannot turn on the
        spot. Such pieces join the straight moves of the paper's grid planner, between which the heading jumps. */
    struct PathPiece
    {
        double curvature{0.0};  ///< curvature at the beginning, 1/m, positive to the left
        double length{0.0};     ///< metres, negative when driven in reverse
        double sharpness{0.0};  ///< change of curvature per metre driven in either direction, 1/m^2
        double turn{0.0};       ///< turn on the spot in radians, positive to the left; requires that the others are 0

        PathPiece() = default;

        /** \brief A drive.

            \param curvatureAtBegin 1/m, positive to the left
            \param signedLength metres, negative in reverse
            \param change 1/m^2, the sharpness */
        PathPiece(double curvatureAtBegin, double signedLength, double change = 0.0)
          : curvature(curvatureAtBegin),
            length(signedLength),
            sharpness(change)
        {
        }

        /** \brief A drive along \e arc. */
        PathPiece(const Arc &arc) : curvature(arc.curvature), length(arc.length)
        {
        }

        /** Largest turn on the spot in radians whose direction follows from its end heading alone. */
        static constexpr double MAX_TURN = 0.5 * PI;

        /** \brief A turn on the spot by \e angle radians. */
        static PathPiece turnOnTheSpot(double angle);

        /** \brief Direction of the drive: 1 forwards, -1 in reverse, 0 for a piece that does not drive. */
        int direction() const
        {
            return (length > 0.0) - (length < 0.0);
        }

        /** \brief Metres driven, not negative. */
        double driven() const
        {
            return length < 0.0 ? -length : length;
        }

        /** \brief Curvature after \e driven metres (0 to driven()). */
        double curvatureAt(double driven) const
        {
            return curvature + sharpness * driven;
        }

        /** \brief Curvature where the piece ends. */
        double endCurvature() const
        {
            return curvatureAt(driven());
        }

        /** \brief The same motion driven from its end to its start. */
        PathPiece reversed() const;
    };

    /** \brief The pose after \e driven metres (0 to piece.driven()) of \e piece from \e pose, accurate to about 1e-12
        m.

        For a turn on the spot, this is the pose after the whole turn. The yaw is not wrapped. */
    Pose advance(const Pose &pose, const PathPiece &piece, double driven);

    /** \brief The pose at the end of \e piece. The yaw is not wrapped. */
    inline Pose advance(const Pose &pose, const PathPiece &piece)
    {
        return advance(pose, piece, piece.driven());
    }

    /** \brief One state of a sampled path.

        Curvature and direction are those of the motion that ends in the state. The first state has those of the motion
        that begins in it. */
    struct PathState
    {
        Pose pose;              ///< pose of the rear axle; Path::sample() wraps the yaw
        double arcLength{0.0};  ///< metres driven since the start, never decreasing
        double curvature{0.0};  ///< 1/m, positive to the left
        int direction{1};       ///< 1 forwards, -1 in reverse
    };

    /** \brief States along a path for drawing, export and checks of poses. A Path cannot be recovered from them. */
    using SampledPath = std::vector<PathState>;

    /** \brief A part of a path between two cusps, driven in one direction: its pieces from \e first up to but excluding
        \e last. */
    struct Stretch
    {
        std::size_t first{0};  ///< index of its first piece in Path::pieces
        std::size_t last{0};   ///< index of the piece after its last one
        int direction{1};      ///< 1 forwards, -1 in reverse
        double begin{0.0};     ///< metres driven along the path before this stretch
    };

    /** \brief A path in exact form: its start and its pieces in driving order.

        Planners, smoothers and controllers share this type, so curvature, direction and length need not be estimated
        from samples. */
    struct Path
    {
        Pose start;                     ///< pose of the rear axle at the beginning
        std::vector<PathPiece> pieces;  ///< motions from the start, in driving order

        /** \brief Metres driven; both directions count as positive. */
        double length() const;

        /** \brief Number of changes between forwards and reverse. */
        std::size_t cusps() const;

        /** \brief The pose at the end, yaw wrapped. */
        Pose end() const;

        /** \brief The same motion driven backwards from its end to its start. */
        Path reversed() const;

        /** \brief Adds a piece. Pieces without motion are dropped and equal neighbouring arcs are merged. */
        void append(const PathPiece &piece);

        /** \brief Adds the pieces of a path that starts where this one ends. */
        void extend(const Path &path);

        /** \brief The pieces from \e first up to but excluding \e last as a path. */
        Path part(std::size_t first, std::size_t last) const;

        /** \brief The remainder of the path after its first \e driven metres (0 to length()).

            The piece at this place is cut unless it begins or ends within a nanometre. */
        Path rest(double driven) const;

        /** \brief The pose after \e driven metres (0 to length()), the start of rest(). */
        Pose at(double driven) const;

        /** \brief The stretches in order; empty for a path that never drives.

            A turn on the spot belongs to the stretch after it, a final one to the last stretch. Pieces without motion
            are skipped. */
        std::vector<Stretch> stretches() const;

        /** \brief States at most \e step metres apart that include both ends of every piece.

            The last state is end() up to rounding. A turn on the spot adds a second state at the same position. Where
            two pieces with different curvatures meet, the state has the curvature of the earlier one.
            \param step metres, positive */
        SampledPath sample(double step) const;
    };

    /** \brief Metres driven along \e path. */
    double pathLength(const SampledPath &path);
}  // namespace parking
