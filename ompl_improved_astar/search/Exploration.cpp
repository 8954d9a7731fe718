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
        indices_.clear();
        places_.clear();
        items_.clear();
        freeItem_ = NOTHING;
        waiting_ = {};
        number_ = std::numeric_limits<std::uint32_t>::max();
    }

    void Exploration::noteExpansion(const Pose &pose, NodeIndex node)
    {
        counts_.add(pose);
        last_.set(counts_.placeOf(pose), node);
    }

    std::uint32_t Exploration::placeAt(std::uint64_t key)
    {
        std::uint32_t place = indices_.find(key);
        if (place == CellTable::NONE)
        {
            place = static_cast<std::uint32_t>(places_.size());
            places_.push_back({key});
            indices_.set(key, place);
        }
        return place;
    }

    void Exploration::enqueue(std::uint32_t index)
    {
        Place &place = places_[index];
        place.expansions = counts_.at(place.key);
        place.number = items_[place.top].number;
        waiting_.push({place.expansions, place.number, index});
    }

    void Exploration::push(const Pose &pose, std::size_t level, NodeIndex node)
    {
        const std::uint32_t index = placeAt(counts_.placeOf(pose));
        std::uint32_t &top = places_[index].top;
        const Item item{node, static_cast<std::uint32_t>(level), number_--, top};
        top = freeItem_ == NOTHING ? static_cast<std::uint32_t>(items_.size()) : freeItem_;
        if (freeItem_ == NOTHING)
            items_.push_back(item);
        else
        {
            freeItem_ = items_[top].below;
            items_[top] = item;
        }
        enqueue(index);
    }

    Exploration::Candidate Exploration::pop()
    {
        while (!waiting_.empty())
        {
            const Waiting best = waiting_.top();
            waiting_.pop();
            Place &place = places_[best.place];
            if (place.top == NOTHING || best.expansions != place.expansions || best.number != place.number)
                continue;
            // Where there were expansions since, the place is not as new any more as it was.
            if (counts_.at(place.key) != best.expansions)
            {
                enqueue(best.place);
                continue;
            }
            const std::uint32_t taken = place.top;
            place.top = items_[taken].below;
            items_[taken].below = freeItem_;
            freeItem_ = taken;
            if (place.top != NOTHING)
                enqueue(best.place);
            return {items_[taken].node, items_[taken].level};
        }
        return {};
    }

    std::size_t Exploration::bytes() const
    {
        constexpr std::size_t GROWING = 3;  // an array that grows is there twice, once of double the size
        return counts_.bytes() + last_.bytes() + indices_.bytes() +
               GROWING *
                   (places_.size() * sizeof(Place) + items_.size() * sizeof(Item) + waiting_.size() * sizeof(Waiting));
    }
}  // namespace parking::search
