#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace parking::search
{
    /** \brief Cost of driving from pose to pose along the motions of a state space, for objectives of other planners.

        Motions of a plain SE2 space are straight lines, driven in reverse if the mean heading points backwards. Their
        curvature is the turn over the length, at most full lock. */
    class DrivingCost
    {
    public:
        /** \brief Adds the curve of the space from pose \e i - 1 to pose \e i to a path. */
        using CurveFunction = std::function<void(std::size_t i, Path &)>;

        /** \brief Throws parking::Error for parameters out of range.

            \param turningRadius of the curves of the space in metres; 0: a plain SE2 space, on which the parameter
            counts */
        DrivingCost(const PlannerParameters &weights, double turningRadius);

        /** \brief The cost of motions. */
        const CostModel &model() const
        {
            return model_;
        }

        /** \brief Cost of driving through \e poses; infinite if a pose is not finite or a motion is longer than a
            thousand kilometres. \param curve is not called on a plain SE2 space */
        double along(const std::vector<Pose> &poses, const CurveFunction &curve, MotionEnvironment &environment) const;

    private:
        CostModel model_;
        bool isPlain_;
    };
}  // namespace parking::search
