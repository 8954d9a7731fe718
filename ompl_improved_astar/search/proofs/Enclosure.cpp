#include "ompl_improved_astar/search/proofs/Enclosure.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr int BITS = 64;

        bool has(const BodyCells::Headings &set, int bit)
        {
            return (set[static_cast<std::size_t>(bit / BITS)] >> (bit % BITS) & 1U) != 0;
        }

        void add(BodyCells::Headings &set, int bit)
        {
            set[static_cast<std::size_t>(bit / BITS)] |= std::uint64_t{1} << (bit % BITS);
        }

        bool isEmpty(const BodyCells::Headings &set)
        {
            return (set[0] | set[1]) == 0;
        }
    }  // namespace

    void Enclosure::begin(const BodyCells &body, const std::vector<Pose> &roots, const std::vector<Pose> &targets,
                          double side, int headings, std::size_t mostColumns, Ahead ahead)
    {
        body_ = &body;
        side_ = side;
        headings_ = headings;
        mostColumns_ = mostColumns;
        seen_ = 0;
        verdict_ = Verdict::Unknown;
        columns_.clear();
        waiting_ = {};
        entered_ = 0;
        ahead_ = std::move(ahead);
        if (!roots.empty())
        {
            const Pose middle = body.middle(roots.front());
            origin_ = {middle.x, middle.y};
        }
        targets_.clear();
        for (const Pose &target : targets)
            targets_.push_back(cellOf(target));
        for (const Pose &root : roots)
        {
            const Cell cell = cellOf(root);
            Headings heading{};
            add(heading, cell.heading);
            enter(cell.place, heading);
        }
    }

    Enclosure::Cell Enclosure::cellOf(const Pose &pose) const
    {
        const Pose middle = body_->middle(pose);
        // What is out of the grid's reach is a place that it does not contain, whichever.
        const auto index = [this](double value)
        {
            constexpr double BEYOND = 2.0 * TiledGrid<Column>::REACH;
            return static_cast<std::int32_t>(std::clamp(std::floor(value / side_), -BEYOND, BEYOND));
        };
        const double turn = (wrapAngle(middle.yaw) + PI) / (2.0 * PI) * headings_;
        return {{index(middle.x - origin_.x()), index(middle.y - origin_.y())},
                std::clamp(static_cast<int>(turn), 0, headings_ - 1)};
    }

    Eigen::Vector2d Enclosure::middleOf(const Place &place) const
    {
        return origin_ + side_ * Eigen::Vector2d(place.first + 0.5, place.second + 0.5);
    }

    void Enclosure::enter(const Place &place, const Headings &headings)
    {
        if (!TiledGrid<Column>::contains(place.first, place.second))
        {
            verdict_ = Verdict::TooLarge;
            return;
        }
        Column &column = columns_.at(place.first, place.second);
        const bool waits = !isEmpty(column.entered);
        for (std::size_t i = 0; i < headings.size(); ++i)
            column.entered[i] |= headings[i] & ~column.reached[i] & ~column.blocked[i];
        if (waits || isEmpty(column.entered))
            return;
        const Eigen::Vector2d at = middleOf(place);
        // Whole cells: what is about as near is seen in the order in which it came, and then less often again.
        waiting_.emplace(ahead_ ? std::floor(ahead_(at.x(), at.y()) / side_) : 0.0, entered_++, place);
    }

    /** Turning on the spot: the headings that are reached from some of the open ones. */
    Enclosure::Headings Enclosure::spread(Headings from, const Headings &open) const
    {
        const std::size_t last = static_cast<std::size_t>(headings_ - 1) / BITS;
        const int top = (headings_ - 1) % BITS;
        for (Headings before{}; from != before;)
        {
            before = from;
            // All at once by one part of the circle to either side; beyond the last part comes the first.
            const std::uint64_t wraps = before[last] >> top & 1U;
            from[0] |= (before[0] << 1 | wraps) | (before[0] >> 1 | before[1] << (BITS - 1));
            from[1] |= (before[1] << 1 | before[0] >> (BITS - 1)) | before[1] >> 1;
            from[last] |= (before[0] & 1U) << top;
            for (std::size_t i = 0; i < from.size(); ++i)
                from[i] &= open[i];
        }
        return from;
    }

    void Enclosure::see(const Place &place)
    {
        Column &column = columns_.at(place.first, place.second);
        if (!column.asked)
        {
            const Eigen::Vector2d at = middleOf(place);
            column.blocked = body_->blocked(at.x(), at.y());
        }
        column.asked = true;
        Headings open{}, fresh{};
        const std::size_t last = static_cast<std::size_t>(headings_ - 1) / BITS;
        const std::uint64_t ofLast = ~std::uint64_t{0} >> (BITS - 1 - (headings_ - 1) % BITS);
        const Headings all{last > 0 ? ~std::uint64_t{0} : ofLast, last > 0 ? ofLast : 0};
        for (std::size_t i = 0; i < open.size(); ++i)
        {
            open[i] = all[i] & ~column.blocked[i] & ~column.reached[i];
            fresh[i] = column.entered[i] & open[i];
        }
        column.entered = {};
        if (isEmpty(fresh))
            return;
        fresh = open == all ? all : spread(fresh, open);
        for (std::size_t i = 0; i < fresh.size(); ++i)
            column.reached[i] |= fresh[i];
        for (const Cell &target : targets_)
            if (target.place == place && has(fresh, target.heading))
                verdict_ = Verdict::Connected;
        for (const auto &[dx, dy] : {Place{1, 0}, Place{-1, 0}, Place{0, 1}, Place{0, -1}})
            enter({place.first + dx, place.second + dy}, fresh);
    }

    Enclosure::Verdict Enclosure::widen(std::size_t columns)
    {
        for (; columns > 0 && verdict_ == Verdict::Unknown; --columns)
        {
            if (waiting_.empty())
                return verdict_ = Verdict::Closed;
            if (seen_ >= mostColumns_)
                return verdict_ = Verdict::TooLarge;
            const Place place = std::get<Place>(waiting_.top());
            waiting_.pop();
            ++seen_;
            see(place);
        }
        return verdict_;
    }
}  // namespace parking::search
