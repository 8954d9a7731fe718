// What the search does when it is stuck.

#include "ompl_improved_astar/search/Search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace parking::search
{
    namespace
    {
        constexpr double INFINITE = std::numeric_limits<double>::infinity();
    }  // namespace

    void Search::noteProgress(const Frontier &own, NodeIndex index)
    {
        if (own.side() != confined_)
            return;
        const Node &node = own.node(index);
        if (node.h < progressEstimate_ - parameters_.tuning.nearer * parameters_.turningRadius)
        {
            progressEstimate_ = node.h;
            progressAt_ = own.turns();
        }
        for (std::size_t i = 0; i < detoursOf(own); ++i)
        {
            Detour &detour = *detours_[i];
            const double ahead = detour.estimate(node, parameters_.tuning.noWay, queueInTurn_ == i + 1);
            if (ahead >= detour.nearest)
                continue;
            detour.nearest = ahead;
            detour.best = index;
        }
    }

    bool Search::needsDetour() const
    {
        const SearchTuning &tuning = parameters_.tuning;
        if (!parameters_.detours || !traits_.joinsAfar || hasTarget_ || hasSolution() ||
            guides(confined_).targets.empty() || detoursTaken() == std::size(tuning.detours))
            return false;
        if (const std::size_t taken = detoursTaken(); taken > 0)
        {
            // Where nothing is known of the room, all discs take the same way.
            const Pose &root = detours_[taken - 1]->root;
            return statistics_.expanded >= detoursSince_ + taken * tuning.nextDetour &&
                   environment_->roomAt(root.x, root.y) < INFINITE;
        }
        // A side that has run dry comes no nearer, and gets no turns any more.
        const Frontier &stuck = frontier(confined_);
        return statistics_.expanded >= tuning.leastExpansions &&
               (stuck.isExhausted() || stuck.turns() >= progressAt_ + tuning.stalledExpansions);
    }

    double Search::Detour::estimate(const Node &node, double noWay, bool looksOn)
    {
        double length = fromRoot > 0.0 ? fromRoot + node.g : 0.0;  // back to the root, and on from there
        if (looksOn)
        {
            if (fromRoot == INFINITE)
                fromRoot = way.distance(root.x, root.y);  // perhaps the time was up
            length = way.distance(node.pose.x, node.pose.y);
        }
        else if (const std::optional<double> known = way.knownDistance(node.pose.x, node.pose.y))
            length = *known;
        return length < INFINITE ? std::max<double>(node.h, length) : noWay * node.h;
    }

    void Search::takeDetour()
    {
        const SearchTuning &tuning = parameters_.tuning;
        const std::size_t number = detoursTaken();
        if (number == 0)
            detoursSince_ = statistics_.expanded;
        if (detours_.size() <= number)
            detours_.push_back(std::make_unique<Detour>());
        const Guides &guides = this->guides(confined_);
        const DetourDisc &disc = tuning.detours[number];
        const double wide = std::max(parameters_.bodyRadius + disc.wider * parameters_.turningRadius,
                                     disc.lanes * parameters_.turningLane);
        Detour &detour = *detours_[number];
        detour.way.begin({*environment_, parameters_, confined_, guides.roots, guides.targets, stop_},
                         {parameters_.inscribedRadius, wide, disc.dear}, tuning.mostDetourCells);
        detour.best = NO_NODE;
        detour.nearest = INFINITE;
        Frontier &stuck = frontier(confined_);
        const NodeIndex nearest =
            *std::min_element(stuck.roots().begin(), stuck.roots().end(),
                              [&](NodeIndex a, NodeIndex b) { return stuck.node(a).h < stuck.node(b).h; });
        detour.root = stuck.node(nearest).pose;
        detour.fromRoot = detour.way.distance(detour.root.x, detour.root.y);
        stuck.setQueues(stuck.queues() + 1);
        for (std::size_t i = 0; i < frontiers_.size() && number == 0; ++i)
            frontiers_[i].exploration.begin(tuning.exploredPlace * parameters_.turningRadius, tuning.exploredSectors);
        fillsDetour_ = true;
        filled_ = {};
    }

    bool Search::fillDetour()
    {
        if (!fillsDetour_)
            return true;
        const std::size_t last = detoursTaken() - 1;
        const auto fill = [this, last](Frontier &own, NodeIndex index)
        {
            const Node &node = own.node(index);
            if (isOpen(node) && own.side() == confined_)
                pushToDetour(last, node.next, index);
            // The first begins the exploration of both sides.
            if (last == 0 && node.isExpanded())
                own.exploration.noteExpansion(node.pose, index);
            if (last == 0 && isOpen(node))
                own.exploration.push(node.pose, node.next, index);
        };
        fillsDetour_ = !visitNodes(filled_, fill);
        return !fillsDetour_;
    }

    bool Search::isOpen(const Node &node) const
    {
        return node.next < traits_.levels && (parameters_.adaptiveResolution || !node.isExpanded());
    }

    void Search::endDetours()
    {
        for (Frontier &each : frontiers_)
        {
            each.setQueues(1);
            each.exploration.clear();
        }
        fillsDetour_ = false;
        explored_ = Side::Goal;
        enclosureLevel_ = 0;
        enclosures_.clear();
        bodyCells_.reset();
        progressEstimate_ = INFINITE;
        progressAt_ = frontier(confined_).turns();
    }

    void Search::beginEnclosures()
    {
        const SearchTuning &tuning = parameters_.tuning;
        bodyCells_.reset();
        if (parameters_.bodyRadius <= 0.0)
            return;
        const double side = tuning.enclosureCells[enclosureLevel_] * parameters_.bodyRadius;
        const int headings = tuning.enclosureHeadings[enclosureLevel_];
        bodyCells_ = environment_->bodyCells(side, headings);
        if (!bodyCells_)
            return;
        enclosures_ = std::vector<Enclosure>(2);
        for (const Side each : {Side::Start, Side::Goal})
            enclosures_[static_cast<std::size_t>(each)].begin(
                *bodyCells_, frontier(each).rootPoses(), frontier(opposite(each)).rootPoses(), side, headings,
                tuning.mostColumns, [this, each](double x, double y) { return wayAhead(each, x, y); });
    }

    std::size_t Search::bytesOfEnclosures() const
    {
        std::size_t bytes = 0;
        for (const Enclosure &enclosure : enclosures_)
            bytes += enclosure.bytes();
        return bytes;
    }

    double Search::wayAhead(Side side, double x, double y)
    {
        constexpr double FARTHER = 1e6;  // metres: than any way that the disc knows
        Guides &own = guides(side);
        double straight = INFINITE;
        for (const Pose &target : own.targets)
            straight = std::min(straight, std::hypot(target.x - x, target.y - y));
        // Where the disc's search cannot tell it says 0.
        const double way = own.roundObstacles ? std::max(straight, own.obstacles.distance(x, y)) : INFINITE;
        return way < INFINITE ? way : FARTHER + straight;
    }

    void Search::widenEnclosures()
    {
        const SearchTuning &tuning = parameters_.tuning;
        if (detoursTaken() == 0 || improved_ || statistics_.expanded < detoursSince_ + tuning.enclosureAfter ||
            enclosureLevel_ >= std::size(tuning.enclosureCells))
            return;
        if (!bodyCells_)
            beginEnclosures();
        if (!bodyCells_)
        {
            enclosureLevel_ = std::size(tuning.enclosureCells);
            return;
        }
        const std::size_t columns =
            1 + (statistics_.expanded - detoursSince_ - tuning.enclosureAfter) / tuning.expansionsPerColumn;
        bool isConnected = false, isOver = true;
        for (Enclosure &enclosure : enclosures_)
        {
            const Enclosure::Verdict verdict = enclosure.widen(columns);
            if (verdict == Enclosure::Verdict::Closed)
                proof_ = Exhaustion::Enclosed;
            isConnected = isConnected || verdict == Enclosure::Verdict::Connected;
            isOver = isOver && verdict != Enclosure::Verdict::Unknown;
        }
        const bool isTooLarge = static_cast<double>(bytesOfEnclosures()) >
                                tuning.memoryOfEnclosures * static_cast<double>(parameters_.maxMemory);
        if (!isConnected && !isOver && !isTooLarge)
            return;
        bodyCells_.reset();
        enclosures_.clear();
        ++enclosureLevel_;
    }

    void Search::pushToDetour(std::size_t detour, std::size_t level, NodeIndex index)
    {
        Frontier &own = frontier(confined_);
        const Node &node = own.node(index);
        const double ahead = detours_[detour]->estimate(node, parameters_.tuning.noWay, queueInTurn_ == detour + 1);
        const double f = parameters_.tuning.greedyDetours ? ahead : node.g + weightAt(own, node) * ahead;
        own.push(1 + detour, level, f, ahead, index);
    }

    bool Search::mayExplore() const
    {
        return detoursTaken() > 0 && statistics_.expanded % parameters_.tuning.explorationPeriod == 0;
    }

    bool Search::explore()
    {
        // The sides take turns: what is new to one of them may be where the other has come.
        for (const Side side : {opposite(explored_), explored_})
        {
            if (!parameters_.bidirectional && side != confined_)
                continue;
            Frontier &own = frontier(side);
            for (Exploration::Candidate next; (next = own.exploration.pop()).node != NO_NODE;)
            {
                const Node &node = own.node(next.node);
                if (node.next != next.level || !mayImprove(side, node))
                    continue;
                explored_ = side;
                expand(own, next.level, next.node);
                return true;
            }
        }
        return false;
    }
}  // namespace parking::search
