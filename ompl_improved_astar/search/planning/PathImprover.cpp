#include "ompl_improved_astar/search/planning/PathImprover.h"

#include "ompl_improved_astar/search/Tuning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr std::size_t DENSE_KNOTS = 6;   // before a knot: a curve may begin at any of them
        constexpr std::size_t TURNED_KNOTS = 3;  // that one curve passes while the car is turned

        /** A move of a pose in steps: forwards, to the left, turned to the left. */
        struct Move
        {
            double forwards, left, turn;
        };

        constexpr std::array<Move, 11> MOVES{{{0.0, 0.0, 0.0},
                                              {1.0, 0.0, 0.0},
                                              {-1.0, 0.0, 0.0},
                                              {0.0, 1.0, 0.0},
                                              {0.0, -1.0, 0.0},
                                              {0.0, 0.0, 1.0},
                                              {0.0, 0.0, -1.0},
                                              {0.0, 1.0, 1.0},
                                              {0.0, -1.0, -1.0},
                                              {0.0, -1.0, 1.0},
                                              {0.0, 1.0, -1.0}}};
    }  // namespace

    /** Cuts the path into knots with its costs. Says no if these are not known for want of time. */
    bool PathImprover::cut(const PricedPath &path, const Pass &pass, const StopFunction &stop)
    {
        knots_.assign(1, {0.0, 0.0, {}, 0.0, false});
        states_.clear();
        Pose pose = path.path.start;
        const auto addState = [&]
        {
            states_.emplace_back();
            states_.back().pose = pose;
        };
        addState();
        for (std::size_t i = 0; i < path.path.pieces.size(); ++i)
        {
            const PathPiece &piece = path.path.pieces[i];
            const double length = piece.driven(), sign = piece.length < 0.0 ? -1.0 : 1.0;
            double next = pass.offset > 0.0 ? pass.offset : pass.spacing;
            for (double done = 0.0; done < length; next += pass.spacing)
            {
                if (stop && stop())
                    return false;
                // No slivers at the end of a piece.
                const bool isLast = length - next < 0.2 * pass.spacing;
                const double end = isLast ? length : next;
                const Arc part{piece.curvature, sign * (end - done)};
                const bool isWhole = done == 0.0 && isLast;
                const double proximity = path.proximity[i] <= 0.0 ? 0.0
                                         : isWhole                ? path.proximity[i]
                                                                  : cost_.proximity(pose, part, environment_);
                const double drive = cost_.drive(part) + proximity;
                const double join = done == 0.0 && i > 0 ? cost_.join(path.path.pieces[i - 1], piece) : 0.0;
                pose = advance(pose, part.curvature, part.length);
                knots_.push_back({knots_.back().driven + end - done, knots_.back().cost + join + drive, part, drive,
                                  isLast && i + 1 < path.path.pieces.size()});
                addState();
                done = end;
            }
        }
        return !environment_.wasInterrupted();
    }

    void PathImprover::addStates(const Pass &pass)
    {
        lanes_ = pass.turnsCar ? 2 : pass.step > 0.0 ? MOVES.size() : 1;
        if (lanes_ == 1)
            return;
        const std::vector<State> path = std::move(states_);
        states_.assign(knots_.size() * lanes_, {});
        for (std::size_t knot = 0; knot < knots_.size(); ++knot)
        {
            const Pose &pose = path[knot].pose;
            const double cosine = std::cos(pose.yaw), sine = std::sin(pose.yaw);
            state(knot, 0).pose = pose;
            for (std::size_t lane = 1; lane < lanes_; ++lane)
            {
                State &own = state(knot, lane);
                own.isBlocked = pass.turnsCar ? knot + 1 == knots_.size() : !knots_[knot].isJoint;
                if (pass.turnsCar)
                {
                    const Pose front = advance(pose, 0.0, 2.0 * centreOffset_);
                    own.pose = {front.x, front.y, wrapAngle(front.yaw + PI)};
                    continue;
                }
                const double forwards = MOVES[lane].forwards * pass.step, left = MOVES[lane].left * pass.step;
                own.pose = {pose.x + forwards * cosine - left * sine, pose.y + forwards * sine + left * cosine,
                            pose.yaw + MOVES[lane].turn * pass.step / curves_.turningRadius()};
            }
        }
    }

    void PathImprover::followPath(std::size_t knot)
    {
        State &own = state(knot, 0);
        const State &before = state(knot - 1, 0);
        own.cost = before.cost + knots_[knot].drive + (knot > 1 ? cost_.join(before.last, knots_[knot].piece) : 0.0);
        own.from = (knot - 1) * lanes_;
        own.curve = NONE;
        own.last = knots_[knot].piece;
    }

    /** A state beside the path is of use only if it is reached for less than this: what a later knot of the path costs,
        less the way there. */
    double PathImprover::usefulCost(std::size_t knot, const Pose &pose, const Pass &pass) const
    {
        const double saved = knots_[knot].cost - state(knot, 0).cost, radius = curves_.turningRadius();
        if (pass.turnsCar)
            return state(knot, 0).cost + tuning::TURN_REACH * radius;
        double most = 0.0;
        for (std::size_t later = knot + 1;
             later < knots_.size() && knots_[later].driven - knots_[knot].driven <= pass.reach; ++later)
            most = std::max(most, knots_[later].cost - minCurveLength(pose, state(later, 0).pose, radius));
        return most - saved;
    }

    void PathImprover::collectOffers(std::size_t knot, std::size_t lane, const Pass &pass, double max)
    {
        offers_.clear();
        const Pose &pose = state(knot, lane).pose;
        const double radius = curves_.turningRadius();
        const auto add = [&](std::size_t earlier, std::size_t from)
        {
            const State &source = state(earlier, from);
            const double bound = source.cost + minCurveLength(source.pose, pose, radius);
            if (bound < max)
                offers_.push_back({bound, earlier * lanes_ + from});
        };
        const auto isNear = [&](std::size_t earlier, std::size_t from)
        {
            return positionDistance(state(earlier, from).pose, pose) < tuning::TURN_REACH * radius;
        };
        if (pass.turnsCar && lane == 1 && isNear(knot, 0))
            add(knot, 0);
        for (std::size_t earlier = knot; earlier-- > 0 && knots_[knot].driven - knots_[earlier].driven <= pass.reach;)
        {
            // Long parts are tried from every few knots only: most of them cannot be replaced, and what is missed by a
            // knot is found by a shorter part.
            if (earlier % std::max<std::size_t>(1, (knot - earlier) / DENSE_KNOTS) != 0)
                continue;
            if (!pass.turnsCar)
            {
                add(earlier, 0);
                for (std::size_t from = 1; from < lanes_; ++from)
                    if (lane == 0 || lane == from)
                        add(earlier, from);
                continue;
            }
            if (lane == 1 && earlier + TURNED_KNOTS >= knot)
                add(earlier, 1);
            if (isNear(earlier, 1 - lane))
                add(earlier, 1 - lane);
        }
        std::sort(offers_.begin(), offers_.end());
    }

    void PathImprover::connect(std::size_t from, std::size_t to, const Pass &pass, double max, const PathPiece *after)
    {
        const State &source = states_[from];
        const FreeCurves::Gap gap{source.pose,   states_[to].pose,  from == 0 ? nullptr : &source.last,
                                  after,         max - source.cost, FreeCurves::SweepEnd::Start,
                                  pass.maxCurves};
        ++connections_;
        freeCurves_.connect(gap,
                            [&](const ReedsSheppCurve &curve, double cost)
                            {
                                if (curve.count == 0)
                                    return false;
                                State &own = states_[to];
                                own.last = curve.pieces[curve.count - 1];
                                own.cost = source.cost + cost - (after != nullptr ? cost_.join(own.last, *after) : 0.0);
                                own.from = from;
                                own.curve = taken_.size();
                                taken_.push_back(curve);
                                return true;
                            });
    }

    /** Finds the cheapest curve to a state. Says no when it is time to stop. */
    bool PathImprover::reach(std::size_t knot, std::size_t lane, const Pass &pass, const StopFunction &stop)
    {
        State &own = state(knot, lane);
        if (own.isBlocked)
            return true;
        const double gain = tuning::MIN_GAIN * curves_.turningRadius();
        const PathPiece next = lane == 0 && knot + 1 < knots_.size() ? PathPiece(knots_[knot + 1].piece) : PathPiece();
        const PathPiece *const after = next.length != 0.0 ? &next : nullptr;
        const double useful = lane == 0 ? HUGE_VAL : usefulCost(knot, own.pose, pass);
        const auto max = [&]
        {
            return std::min(useful, own.cost + (after != nullptr ? cost_.join(own.last, *after) : 0.0)) - gain;
        };
        collectOffers(knot, lane, pass, max());
        if (lane != 0 && !offers_.empty() && !environment_.isFree(own.pose))
            return true;
        for (const Offer &offer : offers_)
        {
            if (!(offer.bound < max()))
                break;
            connect(offer.from, knot * lanes_ + lane, pass, max(), after);
            if (stop && stop())
                return false;
        }
        return true;
    }

    Path PathImprover::assemble(const Pose &start) const
    {
        std::vector<std::size_t> route;
        for (std::size_t at = (knots_.size() - 1) * lanes_; at != 0; at = states_[at].from)
            route.push_back(at);
        Path path{start, {}};
        for (auto at = route.rbegin(); at != route.rend(); ++at)
        {
            const State &own = states_[*at];
            if (own.curve == NONE)
                path.append(knots_[*at / lanes_].piece);
            else
                for (std::size_t k = 0; k < taken_[own.curve].count; ++k)
                    path.append(taken_[own.curve].pieces[k]);
        }
        return path;
    }

    bool PathImprover::improve(PricedPath &path, const Pass &pass, std::size_t maxCusps, const StopFunction &stop)
    {
        if (path.path.pieces.empty() || (stop && stop()) || !cut(path, pass, stop))
            return false;
        addStates(pass);
        taken_.clear();
        state(0, 0).cost = 0.0;
        for (std::size_t knot = 1; knot < knots_.size(); ++knot)
        {
            followPath(knot);
            for (std::size_t lane = 0; lane < lanes_; ++lane)
                if (!reach(knot, lane, pass, stop))
                    return false;
        }
        const double gain = tuning::MIN_GAIN * curves_.turningRadius();
        if (!(states_[(knots_.size() - 1) * lanes_].cost < path.cost - gain))
            return false;
        Path cheaper = assemble(path.path.start);
        if (cheaper.cusps() > maxCusps || !environment_.acceptPath(cheaper))
            return false;
        // Proximity is sampled: the cost of the whole is not quite the sum of its parts'.
        std::optional<PricedPath> priced = price(cost_, std::move(cheaper), environment_, stop);
        if (!priced || !(priced->cost < path.cost - 0.5 * gain))
            return false;
        path = std::move(*priced);
        return true;
    }
}  // namespace parking::search
