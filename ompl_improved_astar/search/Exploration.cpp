#include "ompl_improved_astar/search/Exploration.h"

#include <limits>

namespace parking::search
{
    void Exploration::begin(double side, unsigned int sectors)
    {
        clear();
        counts_.begin(side, sectors);
    }

    void Exploration::clear()
    {
        counts_.clear();
        last_.clear();
        waiting_ = {};
        number_ = std::numeric_limits<std::uint32_t>::max();
    }

    void Exploration::noteExpansion(const Pose &pose, NodeIndex node)
    {
        counts_.add(pose);
        last_.set(counts_.placeOf(pose), node);
    }

    void Exploration::push(const Pose &pose, std::size_t level, NodeIndex node)
    {
        const std::uint64_t place = counts_.placeOf(pose);
        waiting_.push({counts_.at(place), number_--, place, {node, level}});
    }

    Exploration::Candidate Exploration::pop()
    {
        while (!waiting_.empty())
        {
            Waiting best = waiting_.top();
            waiting_.pop();
            const std::uint32_t expansions = counts_.at(best.place);
            if (expansions == best.expansions)
                return best.candidate;
            // Its place is not as new any more as it was.
            best.expansions = expansions;
            waiting_.push(best);
        }
        return {};
    }

    std::size_t Exploration::bytes() const
    {
        constexpr std::size_t GROWING = 3;  // an array that grows is there twice, once of double the size
        return counts_.bytes() + last_.bytes() + GROWING * waiting_.size() * sizeof(Waiting);
    }
}  // namespace parking::search
