#include "ompl_improved_astar/search/planning/PathTurner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double INFINITE = std::numeric_limits<double>::infinity();
        constexpr std::size_t KNOTS_BACK = 2;  // along the path, that turning round may take
    }                                          // namespace

    bool PathTurner::cut(const Path &path, const StopFunction &stop)
    {
        Patience patience(stop, LOOKS_BETWEEN_STOPS);
        knots_.clear();
        places_.clear();
        const double whole = path.length();
        const double spacing =
            std::max(tuning_.turnKnotSpacing * curves_.turningRadius(), whole / static_cast<double>(tuning_.turnKnots));
        const std::size_t parts = std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(whole / spacing)));
        const auto next = [&]
        {
            return whole * static_cast<double>(knots_.size()) / static_cast<double>(parts);
        };
        const auto add = [&](const Pose &pose, const Knot &knot)
        {
            knots_.push_back(knot);
            places_.push_back({pose, true, INFINITE});
        };
        const std::size_t last = path.pieces.size() - 1;
        Pose pose = path.start;
        double driven = 0.0, cost = 0.0;
        // The rest of a piece is driven part by part: what is near to an obstacle costs more than the rest of it.
        const auto drive = [&](PathPiece &rest, double length)
        {
            const PathPiece part(rest.curvature, std::copysign(length, rest.length), rest.sharpness);
            cost += cost_.drive(part);
            if (cost_.pricesCloseness())
                cost += cost_.closeness(pose, part, environment_, -1.0, INFINITE, &patience);
            driven += length;
            pose = advance(pose, part);
            rest = {part.endCurvature(), rest.length - part.length, rest.sharpness};
        };
        for (std::size_t i = 0; i <= last; ++i)
        {
            const PathPiece &piece = path.pieces[i];
            PathPiece rest = piece;
            const double end = driven + piece.driven();
            cost += i > 0 ? cost_.join(path.pieces[i - 1], piece) : 0.0;
            for (double at = next(); knots_.size() < parts && at <= end; at = next())
            {
                drive(rest, at - driven);
                add(pose, {at, cost, piece, at < end ? piece : path.pieces[std::min(i + 1, last)]});
            }
            drive(rest, rest.driven());
        }
        add(pose, {driven, cost, path.pieces[last], path.pieces[last]});
        for (std::size_t k = 0; k < knots_.size(); ++k)
            places_.push_back({environment_.turnedRound(places_[k].pose), std::nullopt, INFINITE});
        for (std::size_t k = 0; k < knots_.size(); ++k)
            places_.push_back({places_[k].pose, true, INFINITE});
        return !patience.wasOver() && !environment_.wasInterrupted();
    }

    void PathTurner::link()
    {
        links_.clear();
        firstLink_.clear();
        const std::size_t count = knots_.size();
        const double radius = curves_.turningRadius(), reach = tuning_.turnReach * radius;
        const auto addCurve = [&](std::size_t from, std::size_t to)
        {
            links_.push_back({from, to, leastCurveLength(places_[from].pose, places_[to].pose, radius)});
        };
        for (std::size_t from = 0; from < places_.size(); ++from)
        {
            firstLink_.push_back(links_.size());
            const std::size_t knot = from % count;
            if (isTurned(from))
                for (std::size_t to = knot + 1; to < count && to <= knot + tuning_.turnSpan; ++to)
                    addCurve(from, count + to);
            else if (knot + 1 < count)
                // How the car comes to the knot says what it costs to go on from there.
                links_.push_back(
                    {from, from + 1,
                     knots_[knot + 1].cost - knots_[knot].cost - cost_.join(knots_[knot].before, knots_[knot].after)});
            for (std::size_t other = knot > KNOTS_BACK ? knot - KNOTS_BACK : 1; other < count; ++other)
                if (const std::size_t to = isTurned(from) ? 2 * count + other : count + other;
                    positionDistance(places_[from].pose, places_[to].pose) < reach)
                    addCurve(from, to);
        }
        firstLink_.push_back(links_.size());
    }

    void PathTurner::boundFromEnd()
    {
        // Most links lead onwards, so that two or three rounds from the end suffice.
        const std::size_t count = knots_.size();
        places_.back().least = 0.0;
        for (bool changed = true; changed;)
        {
            changed = false;
            for (std::size_t knot = count; knot-- > 0;)
                for (const std::size_t place : {2 * count + knot, count + knot, knot})
                    for (std::size_t k = firstLink_[place]; k < firstLink_[place + 1]; ++k)
                        if (const double least = links_[k].least + places_[links_[k].to].least;
                            least < places_[place].least)
                        {
                            places_[place].least = least;
                            changed = true;
                        }
        }
    }

    bool PathTurner::isFree(Place &place)
    {
        if (!place.isFree)
            place.isFree = environment_.isPassable(place.pose);
        return *place.isFree;
    }

    void PathTurner::offer(const Offer &offer)
    {
        if (!(offer.least < mostCost_))
            return;
        offers_.push_back(offer);
        std::push_heap(offers_.begin(), offers_.end(), isDearer);
    }

    void PathTurner::close(const Offer &taken)
    {
        Place &place = places_[taken.to];
        place.isClosed = true;
        place.cost = taken.cost;
        place.from = taken.from;
        place.curve = taken.curve;
        const Knot &knot = knots_[taken.to % knots_.size()];
        place.last = taken.curve == NO_CURVE ? knot.before : free_[taken.curve].pieces[free_[taken.curve].count - 1];
        for (std::size_t k = firstLink_[taken.to]; k < firstLink_[taken.to + 1]; ++k)
        {
            const Link &link = links_[k];
            const bool staysOnPath = !isTurned(link.from) && !isTurned(link.to);
            double cost = place.cost + link.least;
            if (staysOnPath)
                cost += cost_.join(place.last, knot.after);
            if (!places_[link.to].isClosed)
                offer({cost + places_[link.to].least, cost, link.from, link.to,
                       staysOnPath ? Knowledge::Whole : Knowledge::Bound, NO_CURVE});
        }
    }

    void PathTurner::look(const Offer &offered, bool isLast)
    {
        Place &to = places_[offered.to];
        const Place &from = places_[offered.from];
        if (!isFree(to))
            return;
        const double most = mostCost_ - from.cost - to.least;
        connectionCount_ += isLast ? 1 : 0;
        curves_.candidates(from.pose, to.pose, candidates_, most);
        order_.clear();
        const PathPiece *const before = offered.from != 0 ? &from.last : nullptr;
        for (const ReedsSheppCurve &curve : candidates_)
            if (const double cost = curveCost(cost_, curve, before); curve.count > 0 && cost < most)
                order_.emplace_back(cost, &curve);
        const auto offerAgain = [&](double costOfCurve, Knowledge knowledge, std::size_t curve)
        {
            const double cost = from.cost + costOfCurve;
            offer({cost + to.least, cost, offered.from, offered.to, knowledge, curve});
        };
        if (order_.empty())
            return;
        if (!isLast)
        {
            offerAgain(std::min_element(order_.begin(), order_.end())->first, Knowledge::Cheapest, NO_CURVE);
            return;
        }
        offerFreeCurves(environment_, cost_, from.pose, to.pose, order_, CurveEnd::Start, most,
                        [&](const ReedsSheppCurve &curve, double whole)
                        {
                            free_.push_back(curve);
                            offerAgain(whole, Knowledge::Whole, free_.size() - 1);
                            return true;
                        });
    }

    bool PathTurner::findCheapest(const StopFunction &stop)
    {
        offers_.clear();
        free_.clear();
        std::size_t checked = 0;
        offer({places_[0].least, 0.0, 0, 0, Knowledge::Whole, NO_CURVE});
        while (!offers_.empty() && !places_.back().isClosed)
        {
            std::pop_heap(offers_.begin(), offers_.end(), isDearer);
            const Offer next = offers_.back();
            offers_.pop_back();
            if (places_[next.to].isClosed)
                continue;
            if (next.knowledge == Knowledge::Whole)
            {
                close(next);
                continue;
            }
            const bool isLast = next.knowledge == Knowledge::Cheapest;
            if (stop && stop())
                return false;
            // Then only what is known to be free is followed to its end.
            if (checked == tuning_.mostTurnCurves)
                continue;
            checked += isLast ? 1 : 0;
            look(next, isLast);
        }
        return places_.back().isClosed;
    }

    Path PathTurner::assemble(const Path &path) const
    {
        const std::size_t count = knots_.size();
        std::vector<std::size_t> way;
        for (std::size_t place = places_.size() - 1; place != 0; place = places_[place].from)
            way.push_back(place);
        Path turned{path.start, {}};
        for (auto place = way.rbegin(); place != way.rend(); ++place)
        {
            const Place &end = places_[*place];
            if (end.curve == NO_CURVE)
                turned.extend(path.first(knots_[*place % count].driven).rest(knots_[end.from % count].driven));
            else
                for (std::size_t k = 0; k < free_[end.curve].count; ++k)
                    turned.append(free_[end.curve].pieces[k]);
        }
        return turned;
    }

    bool PathTurner::pass(Path &path, double mostCost, const StopFunction &stop)
    {
        mostCost_ = mostCost;
        if (!cut(path, stop))
            return false;
        link();
        boundFromEnd();
        if (!findCheapest(stop))
            return false;
        Path turned = assemble(path);
        if (!environment_.acceptPath(turned))
            return false;
        path = std::move(turned);
        return true;
    }
}  // namespace parking::search
