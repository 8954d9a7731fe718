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

namespace parking
{
    struct PlannerParameters;
}

namespace parking::search
{
    /** \brief Cost of motions: one model for motion primitives, analytic curves and whole paths.

        The unit is a metre driven forwards with sufficient clearance. No motion costs less than its length. */
    struct CostModel
    {
        double reversePenalty{0.0};         ///< extra cost per metre in reverse
        double gearChangePenalty{0.0};      ///< cost of each change between forwards and reverse
        double steeringChangePenalty{0.0};  ///< cost of turning the wheels from straight to full lock
        double fullLockCurvature{1.0};      ///< 1/m, of full lock
        double preferredClearance{0.0};     ///< metres kept from obstacles if that is cheap; 0: none
        double clearanceCost{0.0};          ///< extra cost per metre driven closer than that
        double sampleSpacing{0.1};          ///< metres between the poses at which the clearance is sampled

        /** \brief Cost of driving \e piece in its own direction, obstacles ignored. */
        double drive(const PathPiece &piece) const
        {
            const double length = std::abs(piece.length);
            return piece.length < 0.0 ? length * (1.0 + reversePenalty) : length;
        }

        /** \brief Cost of changing direction and steering between two pieces. */
        double join(const PathPiece &before, const PathPiece &after) const
        {
            const double cost = before.length * after.length < 0.0 ? gearChangePenalty : 0.0;
            return cost + steeringChangePenalty * std::abs(after.curvature - before.endCurvature()) / fullLockCurvature;
        }

        /** \brief Whether driving closer to obstacles than preferred costs anything. */
        bool prefersClearance() const
        {
            return preferredClearance > 0.0 && clearanceCost > 0.0;
        }

        /** \brief Extra cost of driving \e piece from \e from closer to obstacles than preferred; equal in both
            directions.

            The clearance is sampled where the environment cannot prove it. A motion without extra cost keeps it
            everywhere.

            \param clear metres at the beginning that are known to keep the preferred clearance; negative: unknown
            \param max a result above this may be too low */
        double proximity(const Pose &from, const PathPiece &piece, MotionEnvironment &environment, double clear = -1.0,
                         double max = std::numeric_limits<double>::infinity()) const;
    };

    /** \brief The cost model with the weights of \e parameters for a car of this turning radius in metres. */
    CostModel costModel(const PlannerParameters &parameters, double turningRadius);

    /** \brief Cost of an analytic curve, obstacles ignored.

        \param before, after adjacent pieces, or nullptr: the cost of joining them is added, unless the curve is
        empty */
    double curveCost(const CostModel &model, const ReedsSheppCurve &curve, const PathPiece *before = nullptr,
                     const PathPiece *after = nullptr);

    /** \brief A path and what it costs. */
    struct PricedPath
    {
        Path path;                      ///< what is driven
        std::vector<double> proximity;  ///< extra cost of each piece for closeness to obstacles
        double cost{0.0};               ///< of the whole, proximity included

        /** \brief Extra cost of the whole path for closeness to obstacles. */
        double totalProximity() const;
    };

    /** \brief Computes the cost of a path piece by piece. The result is invalid if the environment wasInterrupted(). */
    PricedPath price(const CostModel &model, Path path, MotionEnvironment &environment);

    /** \brief Computes the cost of a path; std::nullopt if \e stop returned true or the environment was interrupted. */
    std::optional<PricedPath> price(const CostModel &model, Path path, MotionEnvironment &environment,
                                    const StopFunction &stop);
}  // namespace parking::search
