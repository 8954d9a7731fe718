#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <cmath>
#include <cstddef>
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
        double clearanceWeight{0.0};        ///< extra cost per metre driven in touch with an obstacle
        double clearanceRange{1.0};         ///< metres of clearance from which on there is no extra cost
        double fullLockCurvature{1.0};      ///< 1/m, of full lock
        double preferredClearance{0.0};     ///< metres that the car keeps from obstacles where that is cheap; 0: none
        double clearanceCost{0.0};          ///< extra cost per metre driven nearer than that
        double samplesApart{0.25};          ///< metres from one look at what is driven nearer to the next

        /** \brief Cost of driving \e segment in the direction in which the car will drive, wherever it is. */
        double drive(const PathPiece &segment) const
        {
            const double length = std::abs(segment.length);
            return segment.length < 0.0 ? length * (1.0 + reversePenalty) : length;
        }

        /** \brief Does it cost anything to be nearer than preferred? */
        bool prefersClearance() const
        {
            return preferredClearance > 0.0 && clearanceCost > 0.0;
        }

        /** \brief Do obstacles nearby cost anything? */
        bool pricesCloseness() const
        {
            return clearanceWeight > 0.0 || prefersClearance();
        }

        /** \brief Extra cost of driving \e segment from \e from because of the obstacles nearby; the same in either
            direction.

            The cost of clearanceWeight falls linearly with the clearance and is sampled every clearanceRange metres.
            What is driven nearer than preferredClearance is sampled, too, but for what the environment knows to be
            clear of obstacles by as much: a motion that does not cost anything keeps it everywhere.

            \param clear metres at the beginning that are known to keep preferredClearance; negative: ask for them
            \param most what comes out above this may be too little: whoever asks has no use for it
            \param patience of those who price what may be long; once it is over, what comes out is too little */
        double closeness(const Pose &from, const PathPiece &segment, MotionEnvironment &environment,
                         double clear = -1.0, double most = std::numeric_limits<double>::infinity(),
                         Patience *patience = nullptr) const;

        /** \brief Cost of what happens at standstill or in passing between two segments. */
        double join(const PathPiece &before, const PathPiece &after) const
        {
            double cost = 0.0;
            if (before.length * after.length < 0.0)
                cost += gearChangePenalty;
            if (steeringChangePenalty > 0.0)
                cost += steeringChangePenalty * std::abs(after.curvature - before.endCurvature()) / fullLockCurvature;
            return cost;
        }
    };

    /** \brief Cost of an analytic curve, wherever it is.

        \param before, after what is driven before and after it, if anything: what joining them costs is added, unless
        the curve is empty */
    double curveCost(const CostModel &model, const ReedsSheppCurve &curve, const PathPiece *before = nullptr,
                     const PathPiece *after = nullptr);

    /** \brief Extra cost of an analytic curve that begins at \e from, because of the obstacles nearby; above \e most
        it may be too little. */
    double curveCloseness(const CostModel &model, const Pose &from, const ReedsSheppCurve &curve,
                          MotionEnvironment &environment, double most = std::numeric_limits<double>::infinity());

    /** \brief Cost of a whole path, wherever it is. */
    double costWithoutCloseness(const CostModel &model, const Path &path);

    /** \brief Extra cost of a whole path because of the obstacles nearby. */
    double pathCloseness(const CostModel &model, const Path &path, MotionEnvironment &environment);

    /** \brief Cost of a whole path, closeness included. */
    double pathCost(const CostModel &model, const Path &path, MotionEnvironment &environment);

    /** \brief How many looks at the clearance there are between two questions whether to stop: some checkers take a
        tenth of a millisecond for one. */
    constexpr std::size_t LOOKS_BETWEEN_STOPS = 64;

    /** \brief The same as without \e stop. None when that says that it is time to stop, or when the environment was
        interrupted: what a path costs is then not known. */
    std::optional<double> pathCloseness(const CostModel &model, const Path &path, MotionEnvironment &environment,
                                        const StopFunction &stop);

    /** \brief A path and what it costs. */
    struct PricedPath
    {
        Path path;                      ///< what is driven
        std::vector<double> closeness;  ///< extra cost of each of its pieces because of the obstacles nearby
        double cost{0.0};               ///< of the whole, closeness included
    };

    /** \brief What a path costs, piece by piece; none when it is time to stop before that is known, or when the
        environment was interrupted. */
    std::optional<PricedPath> pricePath(const CostModel &model, Path path, MotionEnvironment &environment,
                                        const StopFunction &stop);
}  // namespace parking::search
