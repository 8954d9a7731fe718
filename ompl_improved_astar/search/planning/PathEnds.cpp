#include "ompl_improved_astar/search/planning/PathEnds.h"

#include <algorithm>
#include <cmath>

namespace parking::search
{
    namespace
    {
        constexpr double LENGTH_UNIT = 1e-3;  // metres, of straights that an obstacle cuts

        double deviation(const Pose &a, const Pose &b)
        {
            return positionDistance(a, b) + std::abs(wrapAngle(a.yaw - b.yaw));
        }

        /** Metres of the straight from \e pose, by its sign ahead or behind, that are free. */
        double freeStraight(const Pose &pose, double straight, double clearance, bool isGoal,
                            MotionEnvironment &environment)
        {
            double free = environment.freeLength(pose, {0.0, straight});
            if (free < std::abs(straight))
                free = LENGTH_UNIT * std::floor(std::max(0.0, free - clearance) / LENGTH_UNIT);
            const Pose other = advance(pose, 0.0, std::copysign(free, straight));
            const Path motion = isGoal ? Path{other, {{0.0, -std::copysign(free, straight)}}}
                                       : Path{pose, {{0.0, std::copysign(free, straight)}}};
            return free > 0.0 && environment.acceptPath(motion) ? free : 0.0;
        }
    }  // namespace

    void PathEnds::add(const Escape &escape)
    {
        motions_.push_back({escape.start, escape.end(), escape.arc, escape});
    }

    std::vector<Pose> PathEnds::add(const Pose &pose, double straight, double clearance, bool isGoal, bool forwardOnly,
                                    MotionEnvironment &environment)
    {
        const std::size_t first = motions_.size();
        if (straight > 0.0)
        {
            double ahead = 0.0, behind = 0.0;
            if (!(forwardOnly && isGoal))
                ahead = freeStraight(pose, straight, clearance, isGoal, environment);
            if (!(forwardOnly && !isGoal))
                behind = freeStraight(pose, -straight, clearance, isGoal, environment);
            const double longer = std::max(ahead, behind);
            for (const double length : {ahead, -behind})
                if (longer > 0.0 && std::abs(length) == longer)
                    motions_.push_back({pose, advance(pose, 0.0, length), {0.0, isGoal ? -length : length}, {}});
        }
        if (motions_.size() == first)
            motions_.push_back({pose, pose, {}, {}});
        std::vector<Pose> roots;
        for (std::size_t i = first; i < motions_.size(); ++i)
            roots.push_back(motions_[i].root);
        return roots;
    }

    const EndMotion *PathEnds::at(const Pose &pose) const
    {
        const auto found = std::min_element(motions_.begin(), motions_.end(),
                                            [&pose](const EndMotion &a, const EndMotion &b)
                                            { return deviation(a.root, pose) < deviation(b.root, pose); });
        return found == motions_.end() ? nullptr : &*found;
    }

    double PathEnds::minLength() const
    {
        double least = motions_.empty() ? 0.0 : HUGE_VAL;
        for (const EndMotion &motion : motions_)
            least = std::min(least, std::abs(motion.arc.length));
        return least;
    }
}  // namespace parking::search
