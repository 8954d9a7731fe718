#include "ompl_improved_astar/search/proofs/RefinedEnclosure.h"

#include "parking_geometry/PoseCell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr std::size_t CHILDREN = 8;
        constexpr int AXES = 3;
    }  // namespace

    void RefinedEnclosure::begin(const BodyCells &body, const std::vector<Pose> &starts, const std::vector<Pose> &goals,
                                 const Levels &levels, Ahead aheadOfStarts, Ahead aheadOfGoals)
    {
        body_ = &body;
        levels_ = levels;
        verdict_ = Verdict::Unknown;
        made_ = order_ = 0;
        tops_.clear();
        floods_ = {};
        floods_[0].ahead = std::move(aheadOfStarts);
        floods_[1].ahead = std::move(aheadOfGoals);
        for (const Pose &start : starts)
            floods_[0].roots.push_back(body.middle(start));
        for (const Pose &goal : goals)
            floods_[1].roots.push_back(body.middle(goal));
        if (!starts.empty())
            origin_ = {floods_[0].roots.front().x, floods_[0].roots.front().y};
        for (const std::size_t flood : {0, 1})
            plantRoots(flood);
    }

    std::size_t RefinedEnclosure::bytes() const
    {
        constexpr std::size_t GROWING = 3;  // an array that grows is there twice, once of double the size
        std::size_t bytes = chunks_.size() * sizeof(*chunks_.front()) + tops_.bytes();
        for (const Flood &flood : floods_)
            bytes += GROWING * (flood.waiting.size() * sizeof(Waiting) +
                                (flood.detached.size() + flood.loose.size()) * sizeof(CellIndex));
        return bytes;
    }

    RefinedEnclosure::CellIndex RefinedEnclosure::makeCells(std::size_t count)
    {
        const std::size_t first = made_;
        made_ += count;
        while (chunks_.size() * CHUNK < made_)
            chunks_.push_back(std::make_unique<std::array<Cell, CHUNK>>());
        return static_cast<CellIndex>(first);
    }

    /** The first of the cells of level 0 at a place. */
    RefinedEnclosure::CellIndex RefinedEnclosure::top(std::int32_t column, std::int32_t row)
    {
        CellIndex &entry = tops_.at(column, row);
        if (entry != 0)
            return entry - 1;
        const CellIndex first = makeCells(static_cast<std::size_t>(levels_.headings));
        entry = first + 1;
        Cell made;
        made.column = column;
        made.row = row;
        for (; made.heading < levels_.headings; ++made.heading)
            cell(first + static_cast<CellIndex>(made.heading)) = made;
        return first;
    }

    void RefinedEnclosure::makeChildren(CellIndex index)
    {
        const CellIndex first = makeCells(CHILDREN);
        Cell &own = cell(index);
        own.children = first;
        own.content = Content::Cut;
        Cell made;
        made.parent = index;
        made.level = static_cast<std::uint8_t>(own.level + 1);
        for (CellIndex i = 0; i < CHILDREN; ++i)
        {
            made.column = 2 * own.column + static_cast<std::int32_t>(i & 1U);
            made.row = 2 * own.row + static_cast<std::int32_t>(i >> 1 & 1U);
            made.heading = static_cast<std::int16_t>(2 * own.heading + static_cast<int>(i >> 2));
            cell(first + i) = made;
        }
    }

    /** The child in which the cell of the next level lies that has these numbers. */
    RefinedEnclosure::CellIndex RefinedEnclosure::childOf(const Cell &parent, std::int32_t column, std::int32_t row,
                                                          int heading) const
    {
        return parent.children + static_cast<CellIndex>((column & 1) | (row & 1) << 1 | (heading & 1) << 2);
    }

    Eigen::Vector2d RefinedEnclosure::middleOf(const Cell &of) const
    {
        return origin_ + std::ldexp(levels_.side, -of.level) * Eigen::Vector2d(of.column + 0.5, of.row + 0.5);
    }

    RefinedEnclosure::Content RefinedEnclosure::ask(CellIndex index)
    {
        Cell &own = cell(index);
        const Eigen::Vector2d middle = middleOf(own);
        const double halfTurn = std::ldexp(PI / levels_.headings, -own.level);
        switch (body_->contact({{middle.x(), middle.y(), halfTurn * (2 * own.heading + 1) - PI},
                                std::ldexp(levels_.side, -own.level),
                                halfTurn}))
        {
            case BodyCells::Contact::Everywhere:
                own.content = Content::Blocked;
                break;
            case BodyCells::Contact::None:
                own.content = Content::Free;
                break;
            case BodyCells::Contact::Unknown:
                own.content = Content::Doubtful;
                if (own.level < levels_.coarse)
                    makeChildren(index);
        }
        return own.content;
    }

    /** The cell that is not cut in which a pose lies. */
    RefinedEnclosure::CellIndex RefinedEnclosure::leafOf(const Pose &middle)
    {
        double side = levels_.side;
        int headings = levels_.headings;
        // What is out of the grid's reach is a place that it does not contain, whichever.
        const auto index = [&side](double value)
        {
            constexpr double BEYOND = std::numeric_limits<std::int32_t>::max();
            return static_cast<std::int32_t>(std::clamp(std::floor(value / side), -BEYOND, BEYOND));
        };
        const auto turn = [&]
        {
            return std::clamp(static_cast<int>((wrapAngle(middle.yaw) + PI) / (2.0 * PI) * headings), 0, headings - 1);
        };
        const double x = middle.x - origin_.x(), y = middle.y - origin_.y();
        if (!TiledGrid<CellIndex>::contains(index(x), index(y)))
            return NONE;
        CellIndex leaf = top(index(x), index(y)) + static_cast<CellIndex>(turn());
        while (contentOf(leaf) == Content::Cut)
        {
            side *= 0.5;
            headings *= 2;
            leaf = childOf(cell(leaf), index(x), index(y), turn());
        }
        return leaf;
    }

    /** The open leaves of a cell along one of its faces. */
    template <class Visitor>
    void RefinedEnclosure::visitFace(CellIndex index, int axis, std::size_t half, const Visitor &visitor)
    {
        const Content content = contentOf(index);
        if (content == Content::Free || content == Content::Doubtful)
            visitor(index);
        if (content != Content::Cut)
            return;
        for (std::size_t i = 0; i < CHILDREN; ++i)
            if ((i >> axis & 1U) == half)
                visitFace(cell(index).children + static_cast<CellIndex>(i), axis, half, visitor);
    }

    /** The cell of the same level on the other side of a face, or the larger one in which it would lie; none out of the
        grid's reach. */
    RefinedEnclosure::CellIndex RefinedEnclosure::beside(CellIndex index, int axis, int way)
    {
        const Cell &own = cell(index);
        if (own.level > 0)
        {
            const CellIndex first = cell(own.parent).children, place = index - first, bit = CellIndex{1} << axis;
            if (((place & bit) == 0) == (way > 0))
                return first + (place ^ bit);
            const CellIndex larger = beside(own.parent, axis, way);
            return larger != NONE && contentOf(larger) == Content::Cut ? cell(larger).children + (place ^ bit) : larger;
        }
        const std::int32_t column = own.column + (axis == 0 ? way : 0), row = own.row + (axis == 1 ? way : 0);
        const int heading = (own.heading + (axis == 2 ? way : 0) + levels_.headings) % levels_.headings;
        return TiledGrid<CellIndex>::contains(column, row) ? top(column, row) + static_cast<CellIndex>(heading) : NONE;
    }

    /** The open leaves that share a part of a face with the cell. */
    template <class Visitor>
    void RefinedEnclosure::visitNeighbours(CellIndex index, const Visitor &visitor)
    {
        for (int axis = 0; axis < AXES; ++axis)
            for (const int way : {-1, 1})
                if (const CellIndex other = beside(index, axis, way); other != NONE)
                    visitFace(other, axis, way > 0 ? 0 : 1, visitor);
                else
                    verdict_ = Verdict::TooLarge;
    }

    /** Roots are reached from themselves. */
    void RefinedEnclosure::plantRoots(std::size_t flood)
    {
        for (const Pose &root : floods_[flood].roots)
        {
            const CellIndex leaf = leafOf(root);
            if (leaf == NONE)
                verdict_ = Verdict::TooLarge;
            if (leaf == NONE || contentOf(leaf) == Content::Blocked || cell(leaf).isRoot[flood])
                continue;
            cell(leaf).isRoot[flood] = true;
            // A start and a goal in one cell: the other flood has come here before this was known.
            if (cell(leaf).from[1 - flood] != NONE)
                floods_[1 - flood].arrivals.push_back(leaf);
            reach(flood, leaf, leaf);
        }
    }

    void RefinedEnclosure::reach(std::size_t flood, CellIndex index, CellIndex from)
    {
        constexpr unsigned int MOST = std::numeric_limits<std::uint16_t>::max();
        Cell &own = cell(index);
        const unsigned int before = from == index ? 0 : cell(from).doubts[flood];
        own.from[flood] = from;
        own.doubts[flood] =
            static_cast<std::uint16_t>(std::min(MOST, before + (own.content == Content::Doubtful ? 1U : 0U)));
        wait(flood, index);
        if (own.isRoot[1 - flood])
            floods_[flood].arrivals.push_back(index);
    }

    void RefinedEnclosure::wait(std::size_t flood, CellIndex index)
    {
        constexpr double STEP = 0.3;  // metres: what is about as near is seen in the order in which it came
        const Eigen::Vector2d middle = middleOf(cell(index));
        Flood &of = floods_[flood];
        const double ahead = of.ahead ? std::floor(of.ahead(middle.x(), middle.y()) / STEP) : 0.0;
        of.waiting.push({cell(index).doubts[flood], index, ahead, order_++});
    }

    void RefinedEnclosure::detachFollowers(std::size_t flood)
    {
        Flood &of = floods_[flood];
        const CellIndex index = of.detached.back();
        of.detached.pop_back();
        visitNeighbours(index,
                        [&](CellIndex other)
                        {
                            if (cell(other).from[flood] != index)
                                return;
                            cell(other).from[flood] = NONE;
                            of.detached.push_back(other);
                            of.loose.push_back(other);
                        });
    }

    void RefinedEnclosure::attach(std::size_t flood)
    {
        Flood &of = floods_[flood];
        const CellIndex index = of.loose.back();
        of.loose.pop_back();
        const Content content = contentOf(index);
        if (content == Content::Blocked || content == Content::Cut || cell(index).from[flood] != NONE)
            return;
        CellIndex best = NONE;
        beside_.clear();
        visitNeighbours(index,
                        [&](CellIndex other)
                        {
                            if (cell(other).from[flood] == NONE)
                                return;
                            beside_.push_back(other);
                            if (mayEnter(flood, index, other) &&
                                (best == NONE || cell(other).doubts[flood] < cell(best).doubts[flood]))
                                best = other;
                        });
        if (best != NONE)
            return reach(flood, index, best);
        for (const CellIndex other : beside_)
            wait(flood, other);  // to be refined when it spreads
    }

    /** May a flood go on from another cell, without cutting anything first? */
    bool RefinedEnclosure::mayEnter(std::size_t flood, CellIndex index, CellIndex from)
    {
        return cell(index).content == Content::Doubtful || cell(from).content == Content::Free ||
               cell(from).isCrossed[flood];
    }

    RefinedEnclosure::CellIndex RefinedEnclosure::takeArrival(std::size_t flood)
    {
        std::vector<CellIndex> &arrivals = floods_[flood].arrivals;
        while (!arrivals.empty() && cell(arrivals.back()).from[flood] == NONE)
            arrivals.pop_back();
        return arrivals.empty() ? NONE : arrivals.back();
    }

    RefinedEnclosure::CellIndex RefinedEnclosure::takeWaiting(std::size_t flood)
    {
        auto &waiting = floods_[flood].waiting;
        CellIndex index = NONE;
        while (index == NONE && !waiting.empty())
        {
            index = waiting.top().index;
            waiting.pop();
            if (cell(index).from[flood] == NONE)
                index = NONE;  // cut, or detached
        }
        return index;
    }

    void RefinedEnclosure::cut(CellIndex index)
    {
        if (cell(index).content != Content::Doubtful)
            return;
        makeChildren(index);
        const CellIndex first = cell(index).children;
        for (const std::size_t flood : {0, 1})
        {
            Flood &of = floods_[flood];
            if (std::exchange(cell(index).from[flood], NONE) != NONE)
                of.detached.push_back(index);
            for (CellIndex i = 0; i < CHILDREN; ++i)
                of.loose.push_back(first + i);
            if (cell(index).isRoot[flood])
                plantRoots(flood);
        }
    }

    /** Cuts the doubtful cells on the way to a cell, back to the last one that has none before it, and those beside
        them. Returns false when they are all of the finest level. */
    bool RefinedEnclosure::refineWay(std::size_t flood, CellIndex end)
    {
        const auto isCoarse = [this](CellIndex index)
        {
            return cell(index).content == Content::Doubtful && cell(index).level < levels_.fine;
        };
        toCut_.clear();
        for (CellIndex at = end; cell(at).doubts[flood] > 0; at = cell(at).from[flood])
        {
            if (isCoarse(at))
                toCut_.push_back(at);
            if (cell(at).from[flood] == at)
                break;
        }
        const std::size_t onTheWay = toCut_.size();
        for (std::size_t i = 0; i < onTheWay; ++i)
            visitNeighbours(toCut_[i],
                            [&](CellIndex other)
                            {
                                if (isCoarse(other) && cell(other).level <= cell(toCut_[i]).level)
                                    toCut_.push_back(other);
                            });
        for (const CellIndex index : toCut_)
            cut(index);
        return onTheWay > 0;
    }

    void RefinedEnclosure::spread(std::size_t flood, CellIndex index)
    {
        bool crosses = false;
        visitNeighbours(index,
                        [&](CellIndex other)
                        {
                            if (cell(other).from[flood] != NONE)
                                return;
                            if (mayEnter(flood, other, index))
                                reach(flood, other, index);
                            else
                                crosses = true;
                        });
        if (!crosses)
            return;
        if (!refineWay(flood, index))
        {
            cell(index).isCrossed[flood] = true;
            spread(flood, index);
        }
    }

    void RefinedEnclosure::step(std::size_t flood)
    {
        Flood &of = floods_[flood];
        if (!of.detached.empty())
            detachFollowers(flood);
        else if (!of.loose.empty())
            attach(flood);
        else if (const CellIndex arrival = takeArrival(flood); arrival != NONE)
        {
            if (!refineWay(flood, arrival))
                verdict_ = Verdict::Connected;
        }
        else if (const CellIndex next = takeWaiting(flood); next != NONE)
            spread(flood, next);
        else if (verdict_ == Verdict::Unknown)
            verdict_ = Verdict::Closed;
    }

    RefinedEnclosure::Verdict RefinedEnclosure::widen(std::size_t steps)
    {
        for (; steps > 0 && verdict_ == Verdict::Unknown; --steps)
            for (const std::size_t flood : {0, 1})
                if (verdict_ == Verdict::Unknown)
                    step(flood);
        return verdict_;
    }
}  // namespace parking::search
