#include "ompl_improved_astar/search/proofs/Enclosure.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace parking::search
{
    namespace
    {
        constexpr int BITS = 64;

        bool has(const HeadingSet &set, int bit)
        {
            return (set[static_cast<std::size_t>(bit / BITS)] >> (bit % BITS) & 1U) != 0;
        }

        void add(HeadingSet &set, int bit)
        {
            set[static_cast<std::size_t>(bit / BITS)] |= std::uint64_t{1} << (bit % BITS);
        }

        bool isEmpty(const HeadingSet &set)
        {
            return (set[0] | set[1]) == 0;
        }
    }  // namespace

    void Enclosure::begin(const BlockedHeadings &blocked, const std::vector<Pose> &roots,
                          const std::vector<Pose> &targets, const Cells &cells)
    {
        blocked_ = &blocked;
        cells_ = cells;
        seen_ = 0;
        verdict_ = Verdict::Unknown;
        columns_.clear();
        waiting_ = {};
        entered_ = 0;
        if (!roots.empty())
        {
            const Pose middle = advance(roots.front(), 0.0, cells.centreOffset);
            origin_ = {middle.x, middle.y};
        }
        targets_.clear();
        for (const Pose &target : targets)
            targets_.push_back(cellOf(target));
        for (const Pose &root : roots)
        {
            const Cell cell = cellOf(root);
            HeadingSet heading{};
            add(heading, cell.heading);
            enter(cell.place, heading);
        }
    }

    Enclosure::Cell Enclosure::cellOf(const Pose &pose) const
    {
        const Pose middle = advance(pose, 0.0, cells_.centreOffset);
        // What is out of the grid's reach is a place that it does not contain, whichever.
        const auto index = [this](double value)
        {
            constexpr double BEYOND = 2.0 * TiledGrid<Column>::REACH;
            return static_cast<std::int32_t>(std::clamp(std::floor(value / cells_.side), -BEYOND, BEYOND));
        };
        const double turn = (wrapAngle(middle.yaw) + PI) / (2.0 * PI) * cells_.headings;
        return {{index(middle.x - origin_.x()), index(middle.y - origin_.y())},
                std::clamp(static_cast<int>(turn), 0, cells_.headings - 1)};
    }

    std::int32_t Enclosure::cellsToTarget(const Place &place) const
    {
        std::int32_t nearest = std::numeric_limits<std::int32_t>::max();
        for (const Cell &target : targets_)
            nearest = std::min(nearest, std::max(std::abs(target.place.first - place.first),
                                                 std::abs(target.place.second - place.second)));
        return nearest;
    }

    void Enclosure::enter(const Place &place, const HeadingSet &headings)
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
        waiting_.emplace(cellsToTarget(place), entered_++, place);
    }

    /** Turning on the spot: the headings that are reached from some of the open ones. */
    HeadingSet Enclosure::spread(HeadingSet from, const HeadingSet &open) const
    {
        const std::size_t last = static_cast<std::size_t>(cells_.headings - 1) / BITS;
        const int top = (cells_.headings - 1) % BITS;
        for (HeadingSet before{}; from != before;)
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
            const Eigen::Vector2d middle =
                origin_ + cells_.side * Eigen::Vector2d(place.first + 0.5, place.second + 0.5);
            column.blocked = (*blocked_)(middle.x(), middle.y());
        }
        column.asked = true;
        HeadingSet open{}, fresh{};
        const std::size_t last = static_cast<std::size_t>(cells_.headings - 1) / BITS;
        const std::uint64_t ofLast = ~std::uint64_t{0} >> (BITS - 1 - (cells_.headings - 1) % BITS);
        const HeadingSet all{last > 0 ? ~std::uint64_t{0} : ofLast, last > 0 ? ofLast : 0};
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
            if (seen_ >= cells_.maxColumns)
                return verdict_ = Verdict::TooLarge;
            const Place place = std::get<Place>(waiting_.top());
            waiting_.pop();
            ++seen_;
            see(place);
        }
        return verdict_;
    }

    void EnclosureProof::begin(BlockedHeadings blocked, const std::vector<Pose> &starts, const std::vector<Pose> &goals,
                               const Enclosure::Cells &cells)
    {
        blocked_ = std::move(blocked);
        state_ = blocked_ ? State::UnderWay : State::Over;
        if (state_ == State::Over)
            return;
        ends_.resize(2);
        ends_[0].begin(blocked_, starts, goals, cells);
        ends_[1].begin(blocked_, goals, starts, cells);
    }

    bool EnclosureProof::widen(std::size_t columns)
    {
        if (state_ != State::UnderWay)
            return false;
        bool isProven = false, isConnected = false, isOver = true;
        for (Enclosure &end : ends_)
        {
            const Enclosure::Verdict verdict = end.widen(columns);
            isProven = isProven || verdict == Enclosure::Verdict::Closed;
            isConnected = isConnected || verdict == Enclosure::Verdict::Connected;
            isOver = isOver && verdict != Enclosure::Verdict::Unknown;
        }
        if (isProven || isConnected || isOver)
        {
            state_ = State::Over;
            blocked_ = {};
        }
        return isProven;
    }

    std::size_t EnclosureProof::bytes() const
    {
        std::size_t sum = 0;
        if (state_ == State::UnderWay)
            for (const Enclosure &end : ends_)
                sum += end.bytes();
        return sum;
    }
}  // namespace parking::search
