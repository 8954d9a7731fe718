#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "ompl_improved_astar/search/models/CurveCheck.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <cstdint>
#include <vector>

namespace parking::search
{
    /** \brief Which curves between two knots are tried. */
    enum class CurveChoice
    {
        Cheapest,  ///< the cheapest one: among the curves tried in vain most are the others
        All        ///< every word, in the order of cost
    };

    /** \brief Makes a drivable path cheaper by replacing parts of it with curves of bounded curvature.

        The path is cut at knots; between two knots curves that are cheaper than the part they would replace are tried,
        and the first free one taken. The path stays free and drivable, keeps its ends and never becomes more expensive,
        by the closeness to obstacles as it is sampled along its pieces; each replacement makes it cheaper by a certain
        amount, so that a pass ends. Deterministic. */
    class PathShortener
    {
    public:
        /** \brief What is referred to must outlive it. \param cost by which paths become cheaper */
        PathShortener(MotionEnvironment &environment, const ReedsShepp &curves, const CostModel &cost)
          : environment_(environment),
            curves_(curves),
            cost_(cost)
        {
        }

        /** \brief One pass over the pairs of knots, those farthest apart first.

            \param spacing largest distance between knots in metres; ends of pieces are knots, too
            \param offset metres to the first knot within each piece, so that passes can differ
            \param widest pairs of knots farther apart than this along the path, in metres, are left out
            \return whether the path became cheaper; not so by what there is no time to price */
        bool pass(Path &path, double spacing, double offset, double widest, CurveChoice choice,
                  const StopFunction &stop);

        /** \brief Curves tried in all passes so far. */
        std::uint64_t connections() const
        {
            return connectionCount_;
        }

    private:
        struct Piece
        {
            Arc segment;
            Pose from;
            std::size_t arc;         ///< which one of the path it is a part of
            bool isPlain;            ///< that arc is straight or at full lock for a quarter of a turn at most
            double closeness{-1.0};  ///< what it costs; negative: not known yet
        };

        bool cut(const Path &path, double spacing, double offset, const StopFunction &stop);
        bool priceCloseness(const std::vector<Piece> &before, const StopFunction &stop);
        bool isShortest(std::size_t i, std::size_t j) const;
        bool replace(std::size_t i, std::size_t j, CurveChoice choice, Path &path);

        MotionEnvironment &environment_;
        const ReedsShepp &curves_;
        CostModel cost_;
        std::vector<Piece> pieces_, cutBefore_;
        Path replaced_;  // what the path was before a part of it was replaced
        std::vector<double> costBefore_, closenessBefore_;
        std::vector<ReedsSheppCurve> candidates_;
        std::vector<PricedCurve> order_;
        std::uint64_t connectionCount_{0};
    };
}  // namespace parking::search
