#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "ompl_improved_astar/search/SearchTuning.h"
#include "ompl_improved_astar/search/models/CurveCheck.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace parking::search
{
    /** \brief Moves the places where a car turns round: drives parts of a path forwards that it drives in reverse, and
        the other way about.

        Where a way is as long as it is narrow, a search and shortening keep the heading with which they have come along
        it, and turn round where that has led them, however dear it is there. Here the path is cut at knots. At each the
        car may stand as on the path, or turned round on the same ground; it gets along the path, along the turned knots
        by curves of bounded curvature, and from the ones to the others by such curves where it has room to turn. A
        cheap way through these is found by A* with lazy evaluation: bounds first, then the cost of the cheapest curve,
        and only at last whether one is free (after B. Cohen, M. Phillips and M. Likhachev, "Planning single-arm
        manipulations with n-arm robots", 2014). It is the cheapest but for the joins: a pose is left from where it was
        reached for the least, forwards or in reverse. Free and drivable, with the path's own ends. Deterministic. */
    class PathTurner
    {
    public:
        /** \brief What is referred to must outlive it.

            \param curves forwards and in reverse \param cost by which paths are compared */
        PathTurner(MotionEnvironment &environment, const ReedsShepp &curves, const CostModel &cost,
                   const SearchTuning &tuning)
          : environment_(environment),
            curves_(curves),
            cost_(cost),
            tuning_(tuning)
        {
        }

        /** \brief Replaces a path, which must not be empty, by a cheaper one with a part that is driven the
            other way round.

            \param mostCost a path that costs as much is of no use. As reckoned here: clearance is sampled, so that the
            cost of the whole is not quite the sum of its parts'
            \return whether it was replaced */
        bool pass(Path &path, double mostCost, const StopFunction &stop);

        /** \brief Pairs of poses between which curves were swept in all passes so far. */
        std::uint64_t connections() const
        {
            return connectionCount_;
        }

    private:
        /** A place of the path where it is cut. */
        struct Knot
        {
            double driven;     ///< metres along the path
            double cost;       ///< of the path up to there
            PathPiece before;  ///< leads there
            PathPiece after;   ///< leads on
        };

        /** A pose at which the car may stand, and the cheapest way to it. There are three for each knot, kind by kind:
            on the path before the car has turned round, turned, and on the path again. */
        struct Place
        {
            Pose pose;
            std::optional<bool> isFree{};
            double least;      ///< that is left to the end of the path
            double cost{0.0};  ///< from its beginning, once it is closed
            bool isClosed{false};
            std::size_t from{0};          ///< the place before
            std::size_t curve{NO_CURVE};  ///< by which curve
            PathPiece last{};             ///< of that
        };

        /** A way from one place to another. */
        struct Link
        {
            std::size_t from, to;
            double least;  ///< that it costs
        };

        /** What is known of what a link costs. */
        enum class Knowledge
        {
            Bound,     ///< at least so much
            Cheapest,  ///< so much if the cheapest curve is free
            Whole      ///< so much
        };

        /** A link from a closed place. */
        struct Offer
        {
            double least;  ///< cost of a path by it
            double cost;   ///< up to its end
            std::size_t from, to;
            Knowledge knowledge;
            std::size_t curve;
        };

        static constexpr std::size_t NO_CURVE = static_cast<std::size_t>(-1);  // along the path, or none chosen yet

        bool isTurned(std::size_t place) const
        {
            return place >= knots_.size() && place < 2 * knots_.size();
        }

        static bool isDearer(const Offer &a, const Offer &b)
        {
            return a.least > b.least;
        }

        bool cut(const Path &path, const StopFunction &stop);
        void link();
        void boundFromEnd();
        bool isFree(Place &place);
        void offer(const Offer &offer);
        void close(const Offer &offer);
        /** Finds out more about a curve that is offered. \param isLast not only what it costs, but whether it is free
         */
        void look(const Offer &offer, bool isLast);
        bool findCheapest(const StopFunction &stop);
        Path assemble(const Path &path) const;

        MotionEnvironment &environment_;
        const ReedsShepp &curves_;
        CostModel cost_;
        SearchTuning tuning_;
        double mostCost_{0.0};
        std::vector<Knot> knots_;
        std::vector<Place> places_;
        std::vector<Link> links_;             // sorted by where they begin
        std::vector<std::size_t> firstLink_;  // of each place, and the number of all
        std::vector<Offer> offers_;           // a heap
        std::vector<ReedsSheppCurve> free_;   // curves that links were found to be
        std::vector<ReedsSheppCurve> candidates_;
        std::vector<PricedCurve> order_;
        std::uint64_t connectionCount_{0};
    };
}  // namespace parking::search
