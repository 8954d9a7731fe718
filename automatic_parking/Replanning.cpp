#include "automatic_parking/Replanning.h"

#include "path_tracking/trajectory/Splice.h"

#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        /** The motion \e begin, continued along a new plan from its end. */
        std::optional<Replan> continued(const ReplanRequest &request, const TimedMotion &begin)
        {
            const MotionKnot &last = begin.knots.back();
            Replan replan;
            replan.plan = request.plan(endOf(begin, request.car));
            if (!replan.plan.found)
                return std::nullopt;
            replan.motion = begin;
            if (replan.plan.path.pieces.empty())  // the car stands at the goal
                return last.v == 0.0 ? std::optional(std::move(replan)) : std::nullopt;
            if (last.v * replan.plan.path.pieces.front().direction() < 0.0)
                return std::nullopt;
            auto trajectory = request.optimize(replan.plan, last.steering, std::abs(last.v));
            if (!trajectory || trajectory->trajectory.motion.knots.empty())
                return std::nullopt;
            replan.motion = joined(begin, trajectory->trajectory.motion);
            replan.trajectory = std::move(*trajectory);
            return replan;
        }
    }  // namespace

    std::optional<Replan> replan(const ReplanRequest &request)
    {
        const TimedMotion begin = beginOf(request.motion, request.splice);
        if (begin.knots.back().v != 0.0 && request.isFree(begin))
        {
            std::optional<Replan> found = continued(request, begin);
            if (found && request.isFree(found->motion))
                return found;
        }
        for (const double time : {request.splice, request.now})
        {
            const TimedMotion stopping = stopAfter(request.motion, request.car, time, request.deceleration);
            if (!request.isFree(stopping))
                continue;
            std::optional<Replan> found = continued(request, stopping);
            if (!found || !request.isFree(found->motion))
                return std::nullopt;
            found->stops = true;
            return found;
        }
        return std::nullopt;
    }
}  // namespace parking
