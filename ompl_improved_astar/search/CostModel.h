#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace parking::search
{
    /** \brief What a motion costs: one model for motion primitives, analytic curves and whole paths.

        The unit is the metre driven forwards with room on all sides. No motion costs less than its length. */
    struct CostModel
    {
        double reversePenalty{0.0};         ///< extra cost per metre in reverse
        double gearChangePenalty{0.0};      ///< cost of each change between forwards and reverse
        double steeringChangePenalty{0.0};  ///< cost of turning the wheels from straight to full lock
        double fullLockCurvature{1.0};      ///< 1/m, of full lock
        double preferredClearance{0.0};     ///< metres that the car keeps from obstacles where that is cheap; 0: none
        double clearanceCost{0.0};          ///< extra cost per metre driven nearer than that
        double sampleSpacing{0.1};          ///< metres between the poses at which the clearance is sampled

        /** \brief Cost of driving \e piece in the direction in which the car will drive, wherever it is. */
        double drive(const PathPiece &piece) const
        {
            const double length = std::abs(piece.length);
            return piece.length < 0.0 ? length * (1.0 + reversePenalty) : length;
        }

        /** \brief Cost of what happens at standstill or in passing between two pieces. */
        double join(const PathPiece &before, const PathPiece &after) const
        {
            const double cost = before.length * after.length < 0.0 ? gearChangePenalty : 0.0;
            return cost + steeringChangePenalty * std::abs(after.curvature - before.endCurvature()) / fullLockCurvature;
        }

        /** \brief Does it cost anything to be nearer to obstacles than preferred? */
        bool prefersClearance() const
        {
            return preferredClearance > 0.0 && clearanceCost > 0.0;
        }

        /** \brief Extra cost of driving \e piece from \e from nearer to obstacles than preferred; the same in either
            direction.

            The clearance is sampled where the environment does not know that it is kept: a motion that costs nothing
            keeps it everywhere.

            \param clear metres at the beginning that are known to keep the preferred clearance; negative: unknown
            \param max a result above this may be too low: the caller has no use for it */
        double proximity(const Pose &from, const PathPiece &piece, MotionEnvironment &environment, double clear = -1.0,
                         double max = std::numeric_limits<double>::infinity()) const;
    };

    /** \brief Cost of an analytic curve, wherever it is.

        \param before, after what is driven before and after it, if anything: the cost of joining them is added, unless
        the curve is empty */
    double curveCost(const CostModel &model, const ReedsSheppCurve &curve, const PathPiece *before = nullptr,
                     const PathPiece *after = nullptr);

    /** \brief A path and what it costs. */
    struct PricedPath
    {
        Path path;                      ///< what is driven
        std::vector<double> proximity;  ///< extra cost of each of its pieces because of the obstacles nearby
        double cost{0.0};               ///< of the whole, proximity included

        /** \brief Extra cost of the whole path because of the obstacles nearby. */
        double totalProximity() const;
    };

    /** \brief Prices a path piece by piece. The result is meaningless if the environment wasInterrupted(). */
    PricedPath price(const CostModel &model, Path path, MotionEnvironment &environment);

    /** \brief The same; nothing if \e stop says so meanwhile, or the environment was interrupted. */
    std::optional<PricedPath> price(const CostModel &model, Path path, MotionEnvironment &environment,
                                    const StopFunction &stop);
}  // namespace parking::search
