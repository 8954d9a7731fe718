#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace parking::search
{
    /** \brief Leads paths through poses beside them: cuts a part out and fills the gap with two curves of bounded
        curvature that meet at a given pose. Deterministic. */
    class GapBridge
    {
    public:
        /** \brief A path without some part in its middle. */
        struct Gap
        {
            Path before;  ///< up to where it begins
            Path after;   ///< from where it ends
            Pose from;    ///< where it begins
            double cost;  ///< of what was cut out, with the joins at its ends

            /** \brief The last piece before it, null where the path begins with it. */
            const PathPiece *pieceBefore() const
            {
                return before.pieces.empty() ? nullptr : &before.pieces.back();
            }

            /** \brief The first piece after it, null where the path ends with it. */
            const PathPiece *pieceAfter() const
            {
                return after.pieces.empty() ? nullptr : &after.pieces.front();
            }
        };

        /** \brief A path through some pose in a gap. */
        struct Bridged
        {
            Path path;     ///< from start to end
            double cost;   ///< of what fills the gap, with the joins at its ends
            double reach;  ///< metres along the path to that pose
        };

        /** \brief What is referred to must outlive it. \param cost by which curves are chosen and priced */
        GapBridge(MotionEnvironment &environment, const ReedsShepp &curves, const CostModel &cost)
          : environment_(environment),
            curves_(curves),
            cost_(cost)
        {
        }

        /** \brief Cuts out what lies between \e begin and \e end, metres along the path, of which the latter is more.

            \param priced its cost, by the same model; what is cut out whole is not priced again. Pieces that could be
            one, as Path::append() makes them, are one */
        Gap cutOut(const PricedPath &priced, double begin, double end);

        /** \brief Whether the cheapest curve from end to end of the gap, free or not, costs less than \e bound.

            If not, two curves through a pose in between hardly ever do: with penalties the cheapest of all ways need
            not be one of the curves. Where both ends are the same pose, nothing leads from one to the other. */
        bool canCostLess(const Gap &gap, double bound);

        /** \brief The path through \e pose by the cheapest curve to it and the cheapest one from it on, if both are
            free.

            \param pose is free
            \param bound what fills the gap must cost less than this
            \param mostCusps the whole path may have */
        std::optional<Bridged> lead(const Gap &gap, const Pose &pose, double bound, std::size_t mostCusps);

        /** \brief Pairs of poses between which curves were looked for so far. */
        std::uint64_t connections() const
        {
            return connectionCount_;
        }

    private:
        /** A curve to or from the pose, and what it costs with the join at its other end. */
        struct Leg
        {
            double cost;
            ReedsSheppCurve curve;
        };

        std::optional<Leg> cheapest(const Pose &from, const Pose &to, const PathPiece *before, const PathPiece *after,
                                    double bound);

        MotionEnvironment &environment_;
        const ReedsShepp &curves_;
        CostModel cost_;
        std::vector<ReedsSheppCurve> candidates_;
        std::uint64_t connectionCount_{0};
    };
}  // namespace parking::search
