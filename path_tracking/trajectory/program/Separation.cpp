#include "path_tracking/trajectory/program/Separation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace parking
{
    namespace
    {
        /** Share of the largest gap above which the line of the previous checkpoint is kept. */
        constexpr double KEEP = 0.8;
        constexpr double INF = std::numeric_limits<double>::infinity();
        /** Metres by which the region of candidates exceeds that of a checkpoint, for its neighbours. */
        constexpr double PART = 3.0;
        constexpr int MAX_REFINEMENTS = 5;
        /** Metres within which pieces known to cause collisions are considered. */
        constexpr double KNOWN_RANGE = 15.0;
        /** Maximum overlap in metres required by a change of lines; above it poses are inserted. */
        constexpr double WORST_SWITCH = 0.01;
        /** Share of the largest gap above which an already used side of the body separates another piece. */
        constexpr double SERVES = 0.8;
        /** Tangent of the maximum angle between guess and solution. */
        constexpr double STEEPEST = 1.0;
        /** Metres: corners of the body that are farther from a line than the nearest one by more than this are
            ignored. */
        constexpr double IRRELEVANT = 1.5;

        bool isBehind(const ConvexPiece &piece, const Eigen::Vector2d &normal, double offset)
        {
            return std::all_of(piece.corners.begin(), piece.corners.end(),
                               [&](const Eigen::Vector2d &corner) { return normal.dot(corner) <= offset + 1e-9; });
        }

        /** The bounding box of the parts of a body in the frame of the car. */
        Box boundsOf(const std::vector<ConvexPiece> &body)
        {
            Box box = body.front().box;
            for (const ConvexPiece &part : body)
                box = {box.min.cwiseMin(part.box.min), box.max.cwiseMax(part.box.max)};
            return box;
        }

        /** Calls \e visit with the choices at two neighbouring places for each pair whose line changes between. */
        template <class Choices, class Visit>
        void visitChanges(const Choices &atA, const Choices &atB, const Visit &visit)
        {
            auto left = atA.begin();
            for (const auto &choice : atB)
            {
                while (left != atA.end() && left->isBefore(choice))
                    ++left;
                if (left != atA.end() && left->isOfPairOf(choice) && !(left->line == choice.line))
                    visit(*left, choice);
            }
        }
    }  // namespace

    SeparationPlan::SeparationPlan(const std::vector<ConvexPiece> &pieces, const std::vector<ConvexPiece> &body,
                                   SeparationOptions options, std::vector<GuessedCheckpoint> checkpoints,
                                   const std::function<Pose(std::size_t, double)> &poseAt,
                                   const std::function<bool()> &interrupted)
      : pieces_(pieces),
        body_(body),
        options_(std::move(options)),
        isKnown_(pieces.size(), 0)
    {
        const Box ofBody = boundsOf(body_);
        middle_ = 0.5 * (ofBody.min + ofBody.max);
        reach_ = 0.5 * ofBody.size().norm();
        for (const std::size_t i : options_.known)
            isKnown_[i] = 1;
        Box region{{INF, INF}, {-INF, -INF}};
        for (const GuessedCheckpoint &point : checkpoints)
        {
            region.min = region.min.cwiseMin(Eigen::Vector2d(point.pose.x, point.pose.y));
            region.max = region.max.cwiseMax(Eigen::Vector2d(point.pose.x, point.pose.y));
        }
        const double reach = options_.range + reach_ + middle_.norm();
        for (std::size_t i = 0; i < pieces_.size(); ++i)
        {
            const Box &box = pieces_[i].box;
            const bool near = (box.min.array() <= region.max.array() + reach).all() &&
                              (box.max.array() >= region.min.array() - reach).all();
            if (near || isKnown_[i] != 0)
                candidates_.push_back(i);
        }
        for (const GuessedCheckpoint &point : checkpoints)
        {
            if (!goesOn(interrupted))
                return;
            places_.push_back(makePlace(point, places_.empty() ? nullptr : &places_.back()));
        }
        margins_.assign(pieces_.size(), options_.margin);
        for (const Place &place : places_)
            for (const Choice &choice : place.choices)
                if (place.point.fixed)
                    margins_[choice.piece] = std::min(margins_[choice.piece], std::max(0.0, 0.5 * choice.gap));
        for (int i = 0; i < MAX_REFINEMENTS && refine(poseAt, interrupted); ++i)
        {
        }
        joinNeighbours();
    }

    bool SeparationPlan::goesOn(const std::function<bool()> &interrupted)
    {
        isComplete_ = isComplete_ && !(interrupted && interrupted());
        return isComplete_;
    }

    double SeparationPlan::gap(const Place &place, const Separator &line, std::size_t part, std::size_t piece) const
    {
        const Pose &pose = place.point.pose;
        const double c = place.cosine, s = place.sine;
        double least = INF;
        if (!line.ofBody)
        {
            const Eigen::Vector2d &n = pieces_[line.piece].normals[line.side];
            const double along = c * n.x() + s * n.y(), across = c * n.y() - s * n.x();
            for (const Eigen::Vector2d &corner : body_[part].corners)
                least = std::min(least, along * corner.x() + across * corner.y());
            return n.x() * pose.x + n.y() * pose.y + least - pieces_[line.piece].offsets[line.side];
        }
        const Eigen::Vector2d &m = body_[part].normals[line.side];
        const double nx = c * m.x() - s * m.y(), ny = s * m.x() + c * m.y();
        for (const Eigen::Vector2d &corner : pieces_[piece].corners)
            least = std::min(least, nx * (corner.x() - pose.x) + ny * (corner.y() - pose.y));
        return least - body_[part].offsets[line.side];
    }

    SeparationPlan::Choice SeparationPlan::best(const Place &place, std::size_t part, std::size_t piece) const
    {
        Choice choice{part, piece, {}, -INF};
        const auto consider = [&](const Separator &line)
        {
            const double value = gap(place, line, part, piece);
            if (value > choice.gap)
                choice = {part, piece, line, value};
        };
        for (std::size_t side = 0; side < pieces_[piece].normals.size(); ++side)
            consider({false, piece, side});
        for (std::size_t side = 0; side < body_[part].normals.size(); ++side)
            consider({true, 0, side});
        return choice;
    }

    const std::vector<std::size_t> &SeparationPlan::candidatesWithin(const Box &region) const
    {
        if ((region.min.array() >= part_.min.array()).all() && (region.max.array() <= part_.max.array()).all())
            return partCandidates_;
        part_ = {region.min - Eigen::Vector2d(PART, PART), region.max + Eigen::Vector2d(PART, PART)};
        partCandidates_.clear();
        for (const std::size_t i : candidates_)
        {
            const Box &box = pieces_[i].box;
            const bool near =
                (box.min.array() <= part_.max.array()).all() && (box.max.array() >= part_.min.array()).all();
            if (near || isKnown_[i] != 0)
                partCandidates_.push_back(i);
        }
        return partCandidates_;
    }

    SeparationPlan::Place SeparationPlan::makePlace(const GuessedCheckpoint &point, const Place *before) const
    {
        Place place{point, std::cos(point.pose.yaw), std::sin(point.pose.yaw), {}, {}};
        const Eigen::Vector2d middle(point.pose.x + middle_.x() * place.cosine - middle_.y() * place.sine,
                                     point.pose.y + middle_.x() * place.sine + middle_.y() * place.cosine);
        const double farthest = options_.range + reach_;
        const Eigen::Vector2d far(farthest, farthest);
        std::vector<std::size_t> near;
        for (const std::size_t i : candidatesWithin({middle - far, middle + far}))
        {
            const Box &box = pieces_[i].box;
            const Eigen::Vector2d off = (box.min - middle).cwiseMax(middle - box.max).cwiseMax(0.0);
            const double range = isKnown_[i] != 0 ? KNOWN_RANGE : options_.range;
            if (off.squaredNorm() <= (range + reach_) * (range + reach_))
                near.push_back(i);
        }
        for (std::size_t part = 0; part < body_.size(); ++part)
        {
            addChoices(place, part, near, before);
            share(place, part);
        }
        return place;
    }

    /** Adds the lines between a part of the body and the candidates. A line of the previous place is kept if it is
        nearly as good. */
    void SeparationPlan::addChoices(Place &place, std::size_t part, const std::vector<std::size_t> &candidates,
                                    const Place *before) const
    {
        auto old = before != nullptr ? before->choices.begin() : std::vector<Choice>::const_iterator();
        for (const std::size_t i : candidates)
        {
            Choice choice = best(place, part, i);
            if (before != nullptr)
            {
                while (old != before->choices.end() && old->isBefore(choice))
                    ++old;
                if (old != before->choices.end() && old->isOfPairOf(choice) && !(old->line == choice.line))
                {
                    const double kept = gap(place, old->line, part, i);
                    if (kept >= KEEP * choice.gap && kept > 0.0)
                        choice = {part, i, old->line, kept};
                }
            }
            if (choice.gap < (isKnown_[i] != 0 ? KNOWN_RANGE : options_.range))
                place.choices.push_back(choice);
        }
    }

    /** Lets the choices of a part share lines. */
    void SeparationPlan::share(Place &place, std::size_t part) const
    {
        // Nearest first: these lines also separate the pieces behind them.
        const auto first = std::find_if(place.choices.begin(), place.choices.end(),
                                        [part](const Choice &choice) { return choice.part == part; });
        std::vector<std::size_t> order(static_cast<std::size_t>(place.choices.end() - first));
        std::iota(order.begin(), order.end(), static_cast<std::size_t>(first - place.choices.begin()));
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return place.choices[a].gap < place.choices[b].gap; });
        std::vector<Separator> lines;
        std::vector<std::uint8_t> bodySides(body_[part].normals.size(), 0);
        for (const std::size_t i : order)
        {
            Choice &choice = place.choices[i];
            const ConvexPiece &piece = pieces_[choice.piece];
            const auto serving = std::find_if(lines.begin(), lines.end(),
                                              [&](const Separator &line) {
                                                  return isBehind(piece, pieces_[line.piece].normals[line.side],
                                                                  pieces_[line.piece].offsets[line.side]);
                                              });
            if (serving != lines.end())
            {
                choice.line = *serving;
                continue;
            }
            // An already used side of the body suffices if it is nearly as good.
            for (std::size_t side = 0; side < bodySides.size() && !choice.line.ofBody; ++side)
                if (bodySides[side] != 0 &&
                    gap(place, {true, 0, side}, part, choice.piece) >= SERVES * std::abs(choice.gap))
                    choice.line = {true, 0, side};
            if (choice.line.ofBody)
                bodySides[choice.line.side] = 1;
            else
                lines.push_back(choice.line);
        }
    }

    bool SeparationPlan::refine(const std::function<Pose(std::size_t, double)> &poseAt,
                                const std::function<bool()> &interrupted)
    {
        std::vector<Place> refined;
        for (std::size_t i = 0; i < places_.size(); ++i)
        {
            if (!goesOn(interrupted))
                return false;
            const Place &b = places_[i];
            bool between = false;
            if (i > 0)
            {
                const Place &a = places_[i - 1];
                visitChanges(a.choices, b.choices,
                             [&](const Choice &atA, const Choice &atB)
                             {
                                 const double there = a.point.fixed ? -INF : gap(a, atB.line, atB.part, atB.piece);
                                 const double here = b.point.fixed ? -INF : gap(b, atA.line, atA.part, atA.piece);
                                 between = between || std::max(there, here) < -WORST_SWITCH;
                             });
            }
            const double from =
                i > 0 && places_[i - 1].point.interval == b.point.interval ? places_[i - 1].point.fraction : 0.0;
            if (between && b.point.fraction - from > 0.03)
            {
                const double middle = 0.5 * (from + b.point.fraction);
                refined.push_back(
                    makePlace({b.point.interval, middle, poseAt(b.point.interval, middle), false}, &places_[i - 1]));
            }
            refined.push_back(b);
        }
        const bool more = refined.size() > places_.size();
        places_.swap(refined);
        return more;
    }

    void SeparationPlan::joinNeighbours()
    {
        for (std::size_t i = 1; i < places_.size(); ++i)
        {
            Place &a = places_[i - 1], &b = places_[i];
            visitChanges(a.choices, b.choices,
                         [&](const Choice &atA, const Choice &atB)
                         {
                             const std::size_t part = atA.part, piece = atA.piece;
                             const double there = gap(a, atB.line, part, piece);
                             const double here = gap(b, atA.line, part, piece);
                             const double margin = margins_[piece];
                             if ((a.point.fixed && there >= margin) || (b.point.fixed && here >= margin))
                                 return;
                             if (b.point.fixed || (!a.point.fixed && there >= here))
                                 a.extra.push_back({part, piece, atB.line, there});
                             else
                                 b.extra.push_back({part, piece, atA.line, here});
                         });
        }
    }

    void SeparationPlan::addBodySide(const Place &place, std::size_t part, std::size_t side,
                                     const std::vector<std::size_t> &pieces, std::vector<BodyRow> &rows) const
    {
        const Pose &pose = place.point.pose;
        const Eigen::Vector2d &m = body_[part].normals[side];
        const Eigen::Vector2d out(place.cosine * m.x() - place.sine * m.y(), place.sine * m.x() + place.cosine * m.y());
        const double distance = body_[part].offsets[side];
        /** A corner with its positions along and beyond the side. */
        struct Corner
        {
            double along, beyond;
            Eigen::Vector2d point;
            double margin;
        };
        std::vector<Corner> corners;
        for (const std::size_t piece : pieces)
            for (const Eigen::Vector2d &corner : pieces_[piece].corners)
            {
                const Eigen::Vector2d off = corner - Eigen::Vector2d(pose.x, pose.y);
                corners.push_back(
                    {out.x() * off.y() - out.y() * off.x(), out.dot(off) - margins_[piece], corner, margins_[piece]});
            }
        std::sort(corners.begin(), corners.end(),
                  [](const Corner &a, const Corner &b)
                  { return a.along != b.along ? a.along < b.along : a.beyond < b.beyond; });
        // A line with the nearest hull on one side has all of them there.
        std::vector<Corner> hull;
        for (const Corner &corner : corners)
        {
            while (!hull.empty() && hull.back().along == corner.along && hull.back().beyond >= corner.beyond)
                hull.pop_back();
            if (!hull.empty() && hull.back().along == corner.along)
                continue;
            while (hull.size() > 1)
            {
                const Corner &a = hull[hull.size() - 2], &b = hull.back();
                if ((b.along - a.along) * (corner.beyond - a.beyond) -
                        (b.beyond - a.beyond) * (corner.along - a.along) >
                    1e-9)
                    break;
                hull.pop_back();
            }
            hull.push_back(corner);
        }
        for (std::size_t i = 0; i < hull.size(); ++i)
        {
            // The sides of the hull define the turn of the body at which a corner is reached first.
            const auto slope = [&](std::size_t a, std::size_t b)
            {
                return (hull[b].beyond - hull[a].beyond) / (hull[b].along - hull[a].along);
            };
            if ((i > 0 && slope(i - 1, i) > STEEPEST) || (i + 1 < hull.size() && slope(i, i + 1) < -STEEPEST))
                continue;
            BodyRow row;
            row.ofBody = true;
            row.normal = m;
            row.point = hull[i].point;
            row.offset = distance + hull[i].margin;
            rows.push_back(row);
        }
    }

    void SeparationPlan::addRows(const Place &place, std::size_t part, std::vector<BodyRow> &rows) const
    {
        std::vector<Separator> lines;
        std::vector<std::vector<std::size_t>> bodySides(body_[part].normals.size());
        const auto collect = [&](const Choice &choice)
        {
            if (choice.part != part)
                return;
            if (choice.line.ofBody)
            {
                auto &side = bodySides[choice.line.side];
                if (std::find(side.begin(), side.end(), choice.piece) == side.end())
                    side.push_back(choice.piece);
            }
            else if (std::find(lines.begin(), lines.end(), choice.line) == lines.end())
                lines.push_back(choice.line);
        };
        std::for_each(place.choices.begin(), place.choices.end(), collect);
        std::for_each(place.extra.begin(), place.extra.end(), collect);
        const Pose &pose = place.point.pose;
        std::vector<BodyRow> candidates;
        for (const Separator &line : lines)
        {
            candidates.clear();
            double least = INF;
            for (const Eigen::Vector2d &corner : body_[part].corners)
            {
                BodyRow row;
                row.normal = pieces_[line.piece].normals[line.side];
                row.offset = pieces_[line.piece].offsets[line.side] + margins_[line.piece];
                row.point = corner;
                least = std::min(least, row.value(pose.x, pose.y, place.cosine, place.sine));
                candidates.push_back(row);
            }
            for (const BodyRow &row : candidates)
                if (row.value(pose.x, pose.y, place.cosine, place.sine) <= least + IRRELEVANT)
                    rows.push_back(row);
        }
        for (std::size_t side = 0; side < bodySides.size(); ++side)
            if (!bodySides[side].empty())
                addBodySide(place, part, side, bodySides[side], rows);
    }

    void SeparationPlan::write(MotionProblem &problem) const
    {
        problem.checkpoints.clear();
        problem.rows.clear();
        const auto way = [this](std::size_t i, std::size_t k)
        {
            return positionDistance(places_[i].point.pose, places_[k].point.pose);
        };
        for (std::size_t i = 0; i < places_.size(); ++i)
        {
            const Place &place = places_[i];
            if (place.point.fixed)
                continue;
            const std::size_t first = problem.rows.size();
            for (std::size_t part = 0; part < body_.size(); ++part)
                addRows(place, part, problem.rows);
            if (problem.rows.size() > first)
                problem.checkpoints.push_back(
                    {place.point.interval, place.point.fraction, first, problem.rows.size(),
                     0.5 * ((i > 0 ? way(i - 1, i) : 0.0) + (i + 1 < places_.size() ? way(i, i + 1) : 0.0))});
        }
    }

    std::vector<std::size_t> SeparationPlan::nearFirst() const
    {
        std::vector<std::size_t> near;
        for (const Choice &choice : places_.front().choices)
            near.push_back(choice.piece);
        return near;
    }

    std::vector<std::size_t> piecesNear(const std::vector<ConvexPiece> &pieces, const std::vector<ConvexPiece> &body,
                                        const Pose &pose, double range)
    {
        SeparationOptions options;
        options.range = range;
        return SeparationPlan(pieces, body, options, {{0, 0.0, pose, true}}, {}).nearFirst();
    }
}  // namespace parking
