#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "ompl_improved_astar/search/models/FreeCurves.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace parking::search
{
    /** \brief Makes a drivable path cheaper by replacing parts of it with curves of bounded curvature.

        A pass cuts the path at knots: the ends of its pieces, and some poses between them. Each knot offers the pose of
        the path (lane 0) and, in other lanes, poses moved by a step or turned round in place. Dynamic programming finds
        the cheapest path through these states, knot by knot: the path's own piece and curves from earlier states lead
        to each. Bounds are compared first, then costs, and collisions are checked last (after B. Cohen, M. Phillips and
        M. Likhachev, "Planning single-arm manipulations with n-arm robots", 2014).

        A curve from lane 0 to lane 0 shortens the path. A curve to another lane and one back move a pose, for example
        away from an obstacle or at a cusp. The turned lane drives a part of the path in the other direction. The path
        stays free and drivable, keeps its ends and never costs more. Equal inputs give equal paths. */
    class PathImprover
    {
    public:
        /** \brief Settings of one pass. Lengths in metres. */
        struct Pass
        {
            double spacing;      ///< largest distance between knots
            double offset{0.0};  ///< of the first knot within each piece, so that passes differ; 0: spacing
            double reach{std::numeric_limits<double>::infinity()};  ///< largest length that one curve replaces
            double step{0.0};  ///< distance by which poses at the ends of pieces are moved; 0: not moved
            std::size_t maxCurves{FreeCurves::MAX_CURVES};  ///< number of cheapest curves tried between two poses
            bool turnsCar{false};  ///< offer the car turned round at all knots instead of moved poses
        };

        /** \brief Creates an improver. \e environment and \e curves must outlive it.

            \param centreOffset metres from the rear axle ahead to the centre of the body, the pivot for turning
            round */
        PathImprover(MotionEnvironment &environment, const ReedsShepp &curves, const CostModel &cost,
                     double centreOffset)
          : environment_(environment),
            curves_(curves),
            cost_(cost),
            centreOffset_(centreOffset),
            freeCurves_(environment, curves, cost)
        {
        }

        /** \brief One pass over \e path.

            \param maxCusps maximum number of cusps of the result
            \return whether it was replaced by a cheaper one */
        bool improve(PricedPath &path, const Pass &pass, std::size_t maxCusps, const StopFunction &stop);

        /** \brief Number of pairs of poses between which curves were sought, over all passes. */
        std::uint64_t connections() const
        {
            return connections_;
        }

    private:
        static constexpr std::size_t NONE = static_cast<std::size_t>(-1);

        /** A place of the path where it is cut, and its piece that leads there. */
        struct Knot
        {
            double driven;  // metres along the path
            double cost;    // of the path up to there
            Arc piece;      // from the knot before
            double drive;   // cost of that piece without the join at its beginning
            bool isJoint;   // a piece of the path ends there
        };

        /** A pose at a knot, and the cheapest path to it. */
        struct State
        {
            Pose pose;
            double cost{std::numeric_limits<double>::infinity()};
            std::size_t from{NONE};   // the state before it
            std::size_t curve{NONE};  // by which it is reached from there; NONE: by the path's own piece
            PathPiece last;           // of what leads there
            bool isBlocked{false};
        };

        struct Offer
        {
            double bound;      // no path through the source costs less
            std::size_t from;  // the source

            bool operator<(const Offer &other) const
            {
                return bound < other.bound;
            }
        };

        bool cut(const PricedPath &path, const Pass &pass, const StopFunction &stop);
        void addStates(const Pass &pass);
        void followPath(std::size_t knot);
        void collectOffers(std::size_t knot, std::size_t lane, const Pass &pass, double max);
        bool reach(std::size_t knot, std::size_t lane, const Pass &pass, const StopFunction &stop);
        double usefulCost(std::size_t knot, const Pose &pose, const Pass &pass) const;
        void connect(std::size_t from, std::size_t to, const Pass &pass, double max, const PathPiece *after);
        Path assemble(const Pose &start) const;

        State &state(std::size_t knot, std::size_t lane)
        {
            return states_[knot * lanes_ + lane];
        }
        const State &state(std::size_t knot, std::size_t lane) const
        {
            return states_[knot * lanes_ + lane];
        }

        MotionEnvironment &environment_;
        const ReedsShepp &curves_;
        CostModel cost_;
        double centreOffset_;
        FreeCurves freeCurves_;
        std::size_t lanes_{1};
        std::vector<Knot> knots_;
        std::vector<State> states_;
        std::vector<Offer> offers_;
        std::vector<ReedsSheppCurve> taken_;  // curves that lead to states
        std::uint64_t connections_{0};
    };
}  // namespace parking::search
