#include "automatic_parking/Replanning.h"

#include "path_tracking/trajectory/Splice.h"

#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        Replan failed(const std::string &reason)
        {
            Replan none;
            none.failure = reason;
            return none;
        }

        /** The motion \e begin, continued along a new plan from its end. */
        Replan continued(const ReplanRequest &request, const TimedMotion &begin)
        {
            const MotionKnot &last = begin.knots.back();
            Replan replan;
            replan.plan = request.plan(endOf(begin, request.car));
            if (!replan.plan.found)
                return failed(replan.plan.message);
            replan.motion = begin;
            if (replan.plan.path.pieces.empty())  // the goal is reached
                return last.v == 0.0 ? replan : failed("the car is too fast to stop at the goal");
            if (last.v * replan.plan.path.pieces.front().direction() < 0.0)
                return failed("the new path starts in the other direction");
            auto trajectory = request.optimize(replan.plan, last.steering, std::abs(last.v));
            if (!trajectory)
                return failed("the new path is too narrow for a car in motion");
            if (trajectory->trajectory.motion.knots.empty())
                return failed(trajectory->trajectory.reason);
            replan.motion = joined(begin, trajectory->trajectory.motion);
            replan.trajectory = std::move(*trajectory);
            return request.isFree(replan.motion) ? replan : failed("the new motion is not free");
        }
    }  // namespace

    Replan replan(const ReplanRequest &request)
    {
        const TimedMotion begin = beginOf(request.motion, request.splice);
        if (begin.knots.back().v != 0.0 && request.isFree(begin))
        {
            Replan found = continued(request, begin);
            if (found.failure.empty())
                return found;
        }
        for (const double time : {request.splice, request.now})
        {
            const double deceleration = time > request.now ? request.deceleration : request.car.maxAcceleration;
            const TimedMotion stopping = stopAfter(request.motion, request.car, time, deceleration);
            if (!request.isFree(stopping))
                continue;
            Replan found = continued(request, stopping);
            found.stops = true;
            return found;
        }
        return failed("the path to a stop is not free");
    }
}  // namespace parking
