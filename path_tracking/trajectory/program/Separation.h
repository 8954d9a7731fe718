#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "path_tracking/trajectory/program/ConvexPiece.h"
#include "path_tracking/trajectory/program/MotionProblem.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace parking
{
    /** \brief A line that keeps a body and a convex piece apart: a side of either. */
    struct Separator
    {
        bool ofBody{false};    ///< of the body, and otherwise of the piece
        std::size_t piece{0};  ///< whose side it is, unless of the body
        std::size_t side{0};   ///< of the body: 0 front, 1 left, 2 rear, 3 right

        /** \brief Are they the same side? */
        bool operator==(const Separator &other) const
        {
            return ofBody == other.ofBody && side == other.side && (ofBody || piece == other.piece);
        }
    };

    /** \brief Where separation is asked for: a pose of a guessed motion. */
    struct GuessedCheckpoint
    {
        std::size_t interval{0};  ///< index into MotionProblem::directions
        double fraction{1.0};     ///< of the interval
        Pose pose;                ///< guessed there
        bool fixed{false};        ///< the pose keeps what it is: nothing is demanded of it
    };

    /** \brief What SeparationPlan needs to know. */
    struct SeparationOptions
    {
        double margin{0.002};            ///< metres between body and obstacles
        double range{1.0};               ///< metres within which pieces matter
        std::vector<std::size_t> known;  ///< pieces that are known to be in the way: they matter within 15 m
    };

    /** \brief Chooses lines that keep a moving body apart from obstacles.

        At every checkpoint each piece nearby gets the line with the largest gap, of the sides of piece and body
        (separating axes). A piece that lies wholly behind the line of another needs none of its own. Where the line for
        a piece changes from one checkpoint to the next, one of the two has to satisfy both: else a corner can slip
        through in between. Where that would ask for more than a centimetre of overlap, checkpoints are put between. */
    class SeparationPlan
    {
    public:
        /** \brief \param poseAt the guessed pose at a fraction of an interval
            \param interrupted asked at every checkpoint; once it says yes nothing more is done, and the plan is not
            complete; may be empty */
        SeparationPlan(const std::vector<ConvexPiece> &pieces, const Vehicle &vehicle, SeparationOptions options,
                       std::vector<GuessedCheckpoint> checkpoints,
                       const std::function<Pose(std::size_t interval, double fraction)> &poseAt,
                       const std::function<bool()> &interrupted = {});

        /** \brief Whether it was not interrupted. One that was is of no use. */
        bool isComplete() const
        {
            return isComplete_;
        }

        /** \brief Writes checkpoints and rows into \e problem. */
        void write(MotionProblem &problem) const;

        /** \brief The pieces that matter at the first checkpoint. */
        std::vector<std::size_t> nearFirst() const;

    private:
        struct Choice
        {
            std::size_t piece;
            Separator line;
            double gap;
        };

        struct Place
        {
            GuessedCheckpoint point;
            double cosine, sine;
            std::vector<Choice> choices;  // by piece
            std::vector<Choice> extra;    // lines of a neighbour
        };

        const std::vector<std::size_t> &candidatesWithin(const Box &region) const;
        Place makePlace(const GuessedCheckpoint &point, const Place *before) const;
        Choice best(const Place &place, std::size_t piece) const;
        double gap(const Place &place, const Separator &line, std::size_t piece) const;
        bool refine(const std::function<Pose(std::size_t, double)> &poseAt, const std::function<bool()> &interrupted);
        bool goesOn(const std::function<bool()> &interrupted);
        void joinNeighbours();
        void addRows(const Place &place, std::vector<BodyRow> &rows) const;
        void addBodySide(const Place &place, std::size_t side, const std::vector<std::size_t> &pieces,
                         std::vector<BodyRow> &rows) const;
        void share(Place &place) const;

        const std::vector<ConvexPiece> &pieces_;
        Vehicle vehicle_;
        SeparationOptions options_;
        std::vector<std::uint8_t> isKnown_;  // per piece
        double front_, rear_, half_;         // metres of the body's sides from the rear axle
        double reach_;                       // of the body round its middle
        std::vector<std::size_t> candidates_;
        // Those of a part of the world that holds several checkpoints.
        mutable Box part_{{1.0, 1.0}, {-1.0, -1.0}};
        mutable std::vector<std::size_t> partCandidates_;
        std::vector<double> margins_;  // per piece
        std::vector<Place> places_;
        bool isComplete_{true};
    };

    /** \brief The pieces that are within \e range metres of a body at \e pose. */
    std::vector<std::size_t> piecesNear(const std::vector<ConvexPiece> &pieces, const Vehicle &vehicle,
                                        const Pose &pose, double range);
}  // namespace parking
