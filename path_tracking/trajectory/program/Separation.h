#pragma once

#include "parking_geometry/Pose.h"
#include "path_tracking/trajectory/program/ConvexPiece.h"
#include "path_tracking/trajectory/program/MotionProblem.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace parking
{
    /** \brief A line that separates a part of a body from a convex piece: a side of one of them. */
    struct Separator
    {
        bool ofBody{false};    ///< whether it is a side of the part, otherwise of the piece
        std::size_t piece{0};  ///< index of the piece, unless a side of the part
        std::size_t side{0};   ///< index of the side of the piece or of the part

        /** \brief Whether both are the same side. */
        bool operator==(const Separator &other) const
        {
            return ofBody == other.ofBody && side == other.side && (ofBody || piece == other.piece);
        }
    };

    /** \brief A pose of a guessed motion at which separation is required. */
    struct GuessedCheckpoint
    {
        std::size_t interval{0};  ///< index into MotionProblem::directions
        double fraction{1.0};     ///< of the interval
        Pose pose;                ///< guessed there
        bool fixed{false};        ///< whether the pose is fixed, and needs no constraints
    };

    /** \brief Options of a SeparationPlan. */
    struct SeparationOptions
    {
        double margin{0.002};            ///< metres between body and obstacles
        double range{1.0};               ///< metres within which pieces are considered
        std::vector<std::size_t> known;  ///< pieces known to cause collisions; they are considered within 15 m
    };

    /** \brief Chooses lines that separate a moving body from obstacles.

        The body consists of convex parts. At every checkpoint each pair of a part and a nearby piece receives the line
        with the largest gap, among the sides of both (separating axes). A piece wholly behind the line of another needs
        no line of its own.

        If the line for a pair changes between two checkpoints, one of the two must satisfy both lines. Otherwise a
        corner could cross in between. If that would require more than a centimetre of overlap, checkpoints are
        inserted. */
    class SeparationPlan
    {
    public:
        /** \param body parts of the body in the frame of the car
            \param poseAt the guessed pose at a fraction of an interval
            \param interrupted polled at every checkpoint; once it returns true, the plan remains incomplete; may be
            empty */
        SeparationPlan(const std::vector<ConvexPiece> &pieces, const std::vector<ConvexPiece> &body,
                       SeparationOptions options, std::vector<GuessedCheckpoint> checkpoints,
                       const std::function<Pose(std::size_t interval, double fraction)> &poseAt,
                       const std::function<bool()> &interrupted = {});

        /** \brief Whether the plan was not interrupted. An incomplete plan cannot be used. */
        bool isComplete() const
        {
            return isComplete_;
        }

        /** \brief Writes checkpoints and rows into \e problem. */
        void write(MotionProblem &problem) const;

        /** \brief The pieces considered at the first checkpoint. */
        std::vector<std::size_t> nearFirst() const;

    private:
        /** The line between a part of the body and a piece. */
        struct Choice
        {
            std::size_t part, piece;
            Separator line;
            double gap;

            bool isBefore(const Choice &other) const
            {
                return part != other.part ? part < other.part : piece < other.piece;
            }

            bool isOfPairOf(const Choice &other) const
            {
                return part == other.part && piece == other.piece;
            }
        };

        struct Place
        {
            GuessedCheckpoint point;
            double cosine, sine;
            std::vector<Choice> choices;  // by part and piece
            std::vector<Choice> extra;    // lines of a neighbour
        };

        const std::vector<std::size_t> &candidatesWithin(const Box &region) const;
        Place makePlace(const GuessedCheckpoint &point, const Place *before) const;
        void addChoices(Place &place, std::size_t part, const std::vector<std::size_t> &candidates,
                        const Place *before) const;
        Choice best(const Place &place, std::size_t part, std::size_t piece) const;
        double gap(const Place &place, const Separator &line, std::size_t part, std::size_t piece) const;
        bool refine(const std::function<Pose(std::size_t, double)> &poseAt, const std::function<bool()> &interrupted);
        bool goesOn(const std::function<bool()> &interrupted);
        void joinNeighbours();
        void addRows(const Place &place, std::size_t part, std::vector<BodyRow> &rows) const;
        void addBodySide(const Place &place, std::size_t part, std::size_t side, const std::vector<std::size_t> &pieces,
                         std::vector<BodyRow> &rows) const;
        void share(Place &place, std::size_t part) const;

        const std::vector<ConvexPiece> &pieces_;
        const std::vector<ConvexPiece> &body_;
        SeparationOptions options_;
        std::vector<std::uint8_t> isKnown_;  // per piece
        Eigen::Vector2d middle_;             // of the body in the frame of the car
        double reach_;                       // of the body round its middle
        std::vector<std::size_t> candidates_;
        // Those of a part of the world that holds several checkpoints.
        mutable Box part_{{1.0, 1.0}, {-1.0, -1.0}};
        mutable std::vector<std::size_t> partCandidates_;
        std::vector<double> margins_;  // per piece
        std::vector<Place> places_;
        bool isComplete_{true};
    };

    /** \brief The pieces within \e range metres of a body at \e pose; one may occur for each part of the body. */
    std::vector<std::size_t> piecesNear(const std::vector<ConvexPiece> &pieces, const std::vector<ConvexPiece> &body,
                                        const Pose &pose, double range);
}  // namespace parking
