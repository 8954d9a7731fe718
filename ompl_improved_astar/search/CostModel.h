#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <algorithm>
#include <cmath>

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

        /** \brief Cost of driving \e segment from \e from, in the direction in which the car will drive.

            The extra cost of closeness falls linearly with the clearance and is sampled every clearanceRange metres. */
        double drive(const Pose &from, const PathPiece &segment, MotionEnvironment &environment) const
        {
            const double length = std::abs(segment.length);
            double cost = segment.length < 0.0 ? length * (1.0 + reversePenalty) : length;
            if (clearanceWeight > 0.0)
            {
                const double samples = std::max(1.0, std::ceil(length / clearanceRange));
                for (double i = 0.5; i < samples; i += 1.0)
                {
                    const Pose pose = advance(from, segment.curvature, segment.length * i / samples);
                    const double closeness = 1.0 - environment.clearance(pose) / clearanceRange;
                    cost += clearanceWeight * std::max(0.0, closeness) * length / samples;
                }
            }
            return cost;
        }

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

    /** \brief Cost of an analytic curve that begins at \e from. */
    inline double curveCost(const CostModel &model, const Pose &from, const ReedsSheppCurve &curve,
                            MotionEnvironment &environment)
    {
        double cost = 0.0;
        Pose pose = from;
        for (std::size_t i = 0; i < curve.count; ++i)
        {
            cost += model.drive(pose, curve.pieces[i], environment) +
                    (i > 0 ? model.join(curve.pieces[i - 1], curve.pieces[i]) : 0.0);
            if (model.clearanceWeight > 0.0)
                pose = advance(pose, curve.pieces[i].curvature, curve.pieces[i].length);
        }
        return cost;
    }

    /** \brief Cost of a whole path. */
    inline double pathCost(const CostModel &model, const Path &path, MotionEnvironment &environment)
    {
        double cost = 0.0;
        Pose pose = path.start;
        for (std::size_t i = 0; i < path.pieces.size(); ++i)
        {
            const PathPiece &segment = path.pieces[i];
            cost += model.drive(pose, segment, environment) + (i > 0 ? model.join(path.pieces[i - 1], segment) : 0.0);
            pose = advance(pose, segment.curvature, segment.length);
        }
        return cost;
    }
}  // namespace parking::search
