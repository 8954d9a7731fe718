#include "ompl_improved_astar/search/planning/PathShortener.h"

#include "ompl_improved_astar/search/models/CurveCheck.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr std::size_t PARTS_OF_A_SPAN = 8;
        constexpr double LEAST_GAIN = 1e-4;  // metres of cost: smaller gains are not worth a new path
        constexpr double INFINITE = std::numeric_limits<double>::infinity();
    }  // namespace

    bool PathShortener::priceCloseness(const std::vector<Piece> &before, const StopFunction &stop)
    {
        // Most of the path is what it was before a part of it was replaced.
        constexpr double ROUNDING = 1e-9;
        const auto isSame = [](const Piece &a, const Piece &b)
        {
            return a.segment.curvature == b.segment.curvature &&
                   std::abs(a.segment.length - b.segment.length) < ROUNDING &&
                   positionDistance(a.from, b.from) < ROUNDING &&
                   std::abs(wrapAngle(a.from.yaw - b.from.yaw)) < ROUNDING;
        };
        const std::size_t common = std::min(before.size(), pieces_.size());
        for (std::size_t k = 0; k < common && isSame(pieces_[k], before[k]); ++k)
            pieces_[k].closeness = before[k].closeness;
        for (std::size_t k = 1; k <= common; ++k)
        {
            Piece &piece = pieces_[pieces_.size() - k];
            const Piece &known = before[before.size() - k];
            if (!isSame(piece, known))
                break;
            piece.closeness = known.closeness;
        }
        Patience patience(stop, LOOKS_BETWEEN_STOPS);
        for (Piece &piece : pieces_)
            if (piece.closeness < 0.0)
                piece.closeness = cost_.closeness(piece.from, piece.segment, environment_, -1.0, INFINITE, &patience);
        return !patience.wasOver() && !environment_.wasInterrupted();
    }

    bool PathShortener::cut(const Path &path, double spacing, double offset, const StopFunction &stop)
    {
        std::swap(pieces_, cutBefore_);
        pieces_.clear();
        Pose pose = path.start;
        std::size_t arc = 0;
        bool isPlain = false;
        const auto add = [&](const Arc &segment)
        {
            pieces_.push_back({segment, pose, arc, isPlain, -1.0});
            pose = advance(pose, segment.curvature, segment.length);
        };
        for (const PathPiece &segment : path.pieces)
        {
            const double length = std::abs(segment.length), sign = segment.length < 0.0 ? -1.0 : 1.0;
            const double lock = std::abs(segment.curvature) * curves_.turningRadius();
            isPlain = lock == 0.0 || (lock > 1.0 - 1e-9 && std::abs(segment.curvature) * length <= 0.5 * PI);
            double done = 0.0;
            double next = std::min(length, offset > 0.0 ? offset : spacing);
            while (done < length)
            {
                // No slivers at the end of a piece.
                if (length - next < 0.2 * spacing)
                    next = length;
                add({segment.curvature, sign * (next - done)});
                done = next;
                next = std::min(length, next + spacing);
            }
            ++arc;
        }
        if (!cutBefore_.empty())
            cutBefore_.pop_back();  // the end of the path
        if (cost_.pricesCloseness() && !priceCloseness(cutBefore_, stop))
            return false;
        costBefore_.assign(pieces_.size() + 1, 0.0);
        closenessBefore_.assign(pieces_.size() + 1, 0.0);
        for (std::size_t k = 0; k < pieces_.size(); ++k)
        {
            const double closeness = cost_.pricesCloseness() ? pieces_[k].closeness : 0.0;
            closenessBefore_[k + 1] = closenessBefore_[k] + closeness;
            costBefore_[k + 1] = costBefore_[k] + cost_.drive(pieces_[k].segment) + closeness +
                                 (k > 0 ? cost_.join(pieces_[k - 1].segment, pieces_[k].segment) : 0.0);
        }
        pieces_.push_back({{0.0, 0.0}, pose, arc, false, 0.0});
        return true;
    }

    bool PathShortener::isShortest(std::size_t i, std::size_t j) const
    {
        // Two such arcs one after the other, driven the same way, are the shortest curve between their ends.
        const Piece &first = pieces_[i], &last = pieces_[j - 1];
        return closenessBefore_[j] <= closenessBefore_[i] && last.arc - first.arc < 2 && first.isPlain &&
               last.isPlain && first.segment.length * last.segment.length > 0.0;
    }

    bool PathShortener::replace(std::size_t i, std::size_t j, CurveChoice choice, Path &path)
    {
        const std::size_t count = pieces_.size() - 1;
        const PathPiece before = i > 0 ? pieces_[i - 1].segment : Arc();
        const PathPiece after = j < count ? pieces_[j].segment : Arc();
        // Cost of the pieces i ... j - 1 with the joins at both of their ends.
        double now = costBefore_[j] - costBefore_[i];
        if (j < count)
            now += cost_.join(pieces_[j - 1].segment, after);
        ++connectionCount_;
        curves_.candidates(pieces_[i].from, pieces_[j].from, candidates_, now - LEAST_GAIN);
        order_.clear();
        for (const ReedsSheppCurve &curve : candidates_)
        {
            if (curve.count == 0)
                continue;
            const double sum = curveCost(cost_, curve, i > 0 ? &before : nullptr, j < count ? &after : nullptr);
            if (sum < now - LEAST_GAIN)
                order_.emplace_back(sum, &curve);
        }
        // Away from obstacles the cheapest is not the shortest.
        if (choice == CurveChoice::Cheapest && order_.size() > 1 && closenessBefore_[j] <= closenessBefore_[i])
            order_.assign(1, *std::min_element(order_.begin(), order_.end()));
        return offerFreeCurves(environment_, cost_, pieces_[i].from, pieces_[j].from, order_, CurveEnd::Start,
                               now - LEAST_GAIN,
                               [&](const ReedsSheppCurve &curve, double)
                               {
                                   Path shorter{path.start, {}};
                                   for (std::size_t k = 0; k < i; ++k)
                                       shorter.append(pieces_[k].segment);
                                   for (std::size_t m = 0; m < curve.count; ++m)
                                       shorter.append(curve.pieces[m]);
                                   for (std::size_t k = j; k < count; ++k)
                                       shorter.append(pieces_[k].segment);
                                   if (!environment_.acceptPath(shorter))
                                       return false;
                                   replaced_ = std::exchange(path, std::move(shorter));
                                   return true;
                               });
    }

    bool PathShortener::pass(Path &path, double spacing, double offset, double widest, CurveChoice choice,
                             const StopFunction &stop)
    {
        bool improved = false;
        pieces_.clear();
        if (!cut(path, spacing, offset, stop))
            return false;
        // Wide parts are tried at every so many knots only: there are many of them on a long path, most of them cannot
        // be replaced, and what is missed by a knot is found by a narrower part.
        const auto stride = [](std::size_t span)
        {
            return std::max<std::size_t>(1, span / PARTS_OF_A_SPAN);
        };
        for (std::size_t span = pieces_.size() - 1; span >= 2; span -= stride(span))
            for (std::size_t i = 0; i + span < pieces_.size(); i += stride(span))
            {
                if (stop && (connectionCount_ & 15u) == 0 && stop())
                    return improved;
                if (isShortest(i, i + span))
                    continue;
                // A straight line bounds what any curve can gain.
                const Pose &a = pieces_[i].from, &b = pieces_[i + span].from;
                if (costBefore_[i + span] - costBefore_[i] > widest ||
                    positionDistance(a, b) >= costBefore_[i + span] - costBefore_[i] - LEAST_GAIN)
                    continue;
                const double before = costBefore_.back();
                if (replace(i, i + span, choice, path))
                {
                    const bool isPriced = cut(path, spacing, offset, stop);
                    // Closeness is sampled, and a curve cut into pieces in other places than the part that it replaces:
                    // together they may cost more than was reckoned. Without this, two curves replace each other for
                    // ever.
                    if (!isPriced || costBefore_.back() > before - 0.5 * LEAST_GAIN)
                    {
                        path = std::move(replaced_);
                        if (!isPriced || !cut(path, spacing, offset, stop))
                            return improved;
                        continue;
                    }
                    improved = true;
                    span = std::min(span, pieces_.size() - 1);
                    if (span < 2)
                        return improved;
                }
            }
        return improved;
    }
}  // namespace parking::search
