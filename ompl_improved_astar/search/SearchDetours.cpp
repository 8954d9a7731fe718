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
        proofStage_ = ProofStage::EqualCells;
        enclosures_.clear();
        refined_.reset();
        bodyCells_.reset();
        progressEstimate_ = INFINITE;
        progressAt_ = frontier(confined_).turns();
    }

    /** Begins the proof of the stage; false when the environment knows no cells. */
    bool Search::beginProof()
    {
        const SearchTuning &tuning = parameters_.tuning;
        if (parameters_.bodyRadius <= 0.0)
            return false;
        const double side = tuning.enclosureCell * parameters_.bodyRadius;
        bodyCells_ = environment_->bodyCells(side, tuning.enclosureHeadings);
        if (!bodyCells_)
            return false;
        const auto ahead = [this](Side of)
        {
            return [this, of](double x, double y)
            {
                return wayAhead(of, x, y);
            };
        };
        if (proofStage_ == ProofStage::EqualCells)
        {
            enclosures_ = std::vector<Enclosure>(2);
            for (const Side each : {Side::Start, Side::Goal})
                enclosures_[static_cast<std::size_t>(each)].begin(
                    *bodyCells_, frontier(each).rootPoses(), frontier(opposite(each)).rootPoses(), side,
                    tuning.enclosureHeadings, tuning.mostColumns, ahead(each));
            return true;
        }
        RefinedEnclosure::Levels levels;
        levels.side = tuning.refinedCell * parameters_.bodyRadius;
        levels.headings = tuning.refinedHeadings;
        levels.coarse = tuning.refinedCoarse;
        levels.fine = tuning.refinedFine;
        refined_ = std::make_unique<RefinedEnclosure>();
        refined_->begin(*bodyCells_, frontier(Side::Start).rootPoses(), frontier(Side::Goal).rootPoses(), levels,
                        ahead(Side::Start), ahead(Side::Goal));
        return true;
    }

    std::size_t Search::bytesOfEnclosures() const
    {
        std::size_t bytes = 0;
        for (const Enclosure &enclosure : enclosures_)
            bytes += enclosure.bytes();
        return bytes + (refined_ ? refined_->bytes() : 0);
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

    /** Goes on with the proof by what so many expansions since it may have begun are worth; false when it is over. */
    bool Search::widenEnclosures(std::uint64_t expansions)
    {
        const std::size_t columns = 1 + expansions / parameters_.tuning.expansionsPerColumn;
        bool isConnected = false, isOver = true;
        for (Enclosure &enclosure : enclosures_)
        {
            const Enclosure::Verdict verdict = enclosure.widen(columns);
            if (verdict == Enclosure::Verdict::Closed)
                proof_ = Exhaustion::Enclosed;
            isConnected = isConnected || verdict == Enclosure::Verdict::Connected;
            isOver = isOver && verdict != Enclosure::Verdict::Unknown;
        }
        return !isConnected && !isOver;
    }

    /** The same with cells that are cut where it matters. */
    bool Search::refineEnclosure(std::uint64_t expansions)
    {
        const SearchTuning &tuning = parameters_.tuning;
        const RefinedEnclosure::Verdict verdict =
            refined_->widen(tuning.stepsPerExpansion + expansions / tuning.expansionsPerStep);
        if (verdict == RefinedEnclosure::Verdict::Closed)
            proof_ = Exhaustion::Enclosed;
        return verdict == RefinedEnclosure::Verdict::Unknown;
    }

    void Search::seekProof()
    {
        const SearchTuning &tuning = parameters_.tuning;
        if (detoursTaken() == 0 || improved_ || statistics_.expanded < detoursSince_ + tuning.enclosureAfter ||
            proofStage_ == ProofStage::Over)
            return;
        if (!bodyCells_ && !beginProof())
        {
            proofStage_ = ProofStage::Over;
            return;
        }
        const std::uint64_t expansions = statistics_.expanded - detoursSince_ - tuning.enclosureAfter;
        const bool goesOn = refined_ ? refineEnclosure(expansions) : widenEnclosures(expansions);
        if (goesOn && static_cast<double>(bytesOfEnclosures()) <=
                          tuning.memoryOfEnclosures * static_cast<double>(parameters_.maxMemory))
            return;
        proofStage_ = refined_ ? ProofStage::Over : ProofStage::RefinedCells;
        enclosures_.clear();
        refined_.reset();
        bodyCells_.reset();
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
