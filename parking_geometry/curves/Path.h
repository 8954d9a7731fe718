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

    /** \brief What a Path is made of: a drive whose curvature changes evenly with the distance, or a turn on the spot.

        Arcs and straight lines have no sharpness; a piece with sharpness is a clothoid. No car turns on the spot: such
        pieces join the straight moves of the paper's grid planner, whose heading jumps from one to the next. */
    struct PathPiece
    {
        double curvature{0.0};  ///< 1/m where the piece begins, positive to the left
        double length{0.0};     ///< metres, negative when driven in reverse
        double sharpness{0.0};  ///< 1/m^2, change of curvature per metre driven, whichever the direction
        double turn{0.0};       ///< radians turned on the spot, positive to the left; the other members are then 0

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

        /** \brief The arc as a piece. */
        PathPiece(const Arc &arc) : curvature(arc.curvature), length(arc.length)
        {
        }

        /** Radians of a turn up to which its end alone says which way it goes. */
        static constexpr double LONGEST_TURN = 0.5 * PI;

        /** \brief A turn on the spot by \e angle radians. */
        static PathPiece turnOnTheSpot(double angle);

        /** \brief 1 forwards, -1 in reverse, 0 for what does not drive. */
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

        /** \brief The same motion from its end to its start. */
        PathPiece reversed() const;
    };

    /** \brief The pose after \e driven metres (0 to piece.driven()) of \e piece from \e pose, to about 1e-12 m; for a
        turn on the spot, the pose after all of it. The yaw is not wrapped. */
    Pose advance(const Pose &pose, const PathPiece &piece, double driven);

    /** \brief The pose at the end of \e piece. The yaw is not wrapped. */
    inline Pose advance(const Pose &pose, const PathPiece &piece)
    {
        return advance(pose, piece, piece.driven());
    }

    /** \brief One state of a sampled path; curvature and direction are those with which it is reached (the first state:
        those with which it is left). */
    struct PathState
    {
        Pose pose;              ///< of the rear axle; Path::sample() wraps the yaw
        double arcLength{0.0};  ///< metres driven since the start, never decreasing
        double curvature{0.0};  ///< 1/m, positive to the left
        int direction{1};       ///< 1 forwards, -1 in reverse
    };

    /** \brief States along a path, for drawing, writing and asking about poses: a picture of a Path, from which it is
        not made again. */
    using SampledPath = std::vector<PathState>;

    /** \brief A part of a path between two cusps: driven in one direction, from piece \e first to before \e last. */
    struct Stretch
    {
        std::size_t first{0};  ///< index of its first piece in Path::pieces
        std::size_t last{0};   ///< index of the piece behind its last one
        int direction{1};      ///< 1 forwards, -1 in reverse
        double begin{0.0};     ///< metres driven along the path before it: behind the first stretch, where a cusp is
    };

    /** \brief A path in exact form: where it starts, and its pieces in the order in which they are driven.

        From the search to the controller a path is this one type: curvature, direction and length travel with it and
        are never guessed back from samples. */
    struct Path
    {
        Pose start;                     ///< pose of the rear axle at the beginning
        std::vector<PathPiece> pieces;  ///< what is driven from there, in order

        /** \brief Metres driven, both directions counted positive. */
        double length() const;

        /** \brief Number of changes between forwards and reverse. */
        std::size_t cusps() const;

        /** \brief The pose at the end, yaw wrapped. */
        Pose end() const;

        /** \brief The same motion driven backwards from its end to its start. */
        Path reversed() const;

        /** \brief Adds a piece; pieces that do nothing are dropped and equal neighbouring arcs are merged. */
        void append(const PathPiece &piece);

        /** \brief Adds the pieces of a path that starts where this one ends. */
        void extend(const Path &path);

        /** \brief The pieces from \e first to before \e last as a path of their own, from where the first of them
            begins. */
        Path part(std::size_t first, std::size_t last) const;

        /** \brief What is left of the path behind its first \e driven metres (0 to length()); the piece that is under
            way there is cut, or left whole where it begins or ends within a nanometre. */
        Path rest(double driven) const;

        /** \brief The pose after \e driven metres (0 to length()): where rest() starts. */
        Pose at(double driven) const;

        /** \brief The stretches in order. A turn on the spot belongs to the stretch that it precedes; one at the very
            end belongs to the last stretch. Pieces that do nothing are passed over. Empty for a path that never
            drives. */
        std::vector<Stretch> stretches() const;

        /** \brief States no more than \e step metres apart, with every end of a piece among them.

            \param step metres, positive
            The last state of the sample is end() up to rounding. A turn on the spot is a second state at the same
            place. The curvature of a state is that of the path there; where two pieces meet with different curvatures,
            that of the earlier one. */
        SampledPath sample(double step) const;
    };

    /** \brief Metres driven along \e path. */
    double pathLength(const SampledPath &path);
}  // namespace parking
