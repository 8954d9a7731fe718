#include "path_tracking/reference/ReferencePath.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace parking
{
    /** Adjacent pieces of continuous curvature. */
    struct ReferencePath::Run
    {
        std::size_t endNode;
        PathPiece first;
        PathPiece last;
        std::vector<SteeringKnot> knots;

        double length() const
        {
            return knots.back().s - knots.front().s;
        }

        /** Cuts off the last \e most metres. */
        void trimEnd(double most)
        {
            const double end = knots.back().s - most;
            while (knots.size() > 1 && knots[knots.size() - 2].s >= end)
                knots.pop_back();
            if (knots.size() > 1)
                knots.back() = between(knots[knots.size() - 2], knots.back(), end);
        }

        void trimBegin(double most)
        {
            const double begin = knots.front().s + most;
            auto kept = knots.begin();
            while (kept + 1 != knots.end() && (kept + 1)->s <= begin)
                ++kept;
            if (kept + 1 != knots.end())
                *kept = between(*kept, *(kept + 1), begin);
            knots.erase(knots.begin(), kept);
        }

        static SteeringKnot between(const SteeringKnot &a, const SteeringKnot &b, double s)
        {
            const double part = b.s > a.s ? (s - a.s) / (b.s - a.s) : 0.0;
            return {s, a.angle + part * (b.angle - a.angle)};
        }
    };

    namespace
    {
        /** Maximum distance of nodes, for an error of less than 0.5 mm when projecting onto chords. */
        constexpr double NODE_DISTANCE = 0.1;
        /** Radians, maximum heading error after a ramp. */
        constexpr double BLEND_YAW = 4e-4;
        /** Minimum difference of curvature that counts as a jump. */
        constexpr double SAME_CURVATURE = 1e-6;
        /** Knots of the steering angle within this distance are merged. */
        constexpr double SAME_PLACE = 1e-9;

        /** Metres; a shorter stretch of another curvature turns the car by less than 0.05 degrees at full lock. */
        constexpr double SHORTEST_RUN = 0.002;
        constexpr double STUB_JUMP = 0.1;  // radians of steering

        /** Merges a run that is too short, and whose steering angle differs from both neighbours, with one of them. */
        template <class Run>
        void dropStubs(std::vector<Run> &runs)
        {
            std::vector<Run> kept;
            for (std::size_t k = 0; k < runs.size(); ++k)
            {
                const bool before =
                    kept.empty() || std::abs(kept.back().knots.back().angle - runs[k].knots.front().angle) > STUB_JUMP;
                const bool after = k + 1 == runs.size() ||
                                   std::abs(runs[k + 1].knots.front().angle - runs[k].knots.back().angle) > STUB_JUMP;
                const bool alone = kept.empty() && k + 1 == runs.size();
                if (runs[k].length() >= SHORTEST_RUN || !before || !after || alone)
                {
                    kept.push_back(std::move(runs[k]));
                }
                else if (!kept.empty())
                {
                    kept.back().knots.push_back({runs[k].knots.back().s, kept.back().knots.back().angle});
                    kept.back().endNode = runs[k].endNode;
                }
                else
                {
                    std::vector<SteeringKnot> &next = runs[k + 1].knots;
                    next.insert(next.begin(), {runs[k].knots.front().s, next.front().angle});
                }
            }
            runs = std::move(kept);
        }
    }  // namespace

    ReferencePath::ReferencePath(const Path &path, const Vehicle &vehicle, const ReferenceParameters &parameters)
      : vehicle_(vehicle)
    {
        vehicle.validate();
        parameters.validate();
        drivable_ = makeDrivable(path, vehicle, parameters);
        for (const Stretch &stretch : drivable_.path.stretches())
        {
            const std::size_t first = nodes_.size();
            const std::vector<Run> runs = addNodes(nodes_.empty() ? path.start : nodes_.back().pose, stretch);
            addLegs(runs, first, stretch.direction, parameters);
        }
        for (Node &node : nodes_)
            node.pose.yaw = wrapAngle(node.pose.yaw);
    }

    /** Creates nodes and the runs of continuous curvature that they form. */
    std::vector<ReferencePath::Run> ReferencePath::addNodes(const Pose &begin, const Stretch &stretch)
    {
        nodes_.push_back({begin, {}, nodes_.empty() ? 0.0 : nodes_.back().s});
        std::vector<Run> runs;
        for (std::size_t i = stretch.first; i < stretch.last; ++i)
        {
            const PathPiece &piece = drivable_.path.pieces[i];
            const auto angleAt = [&](double driven)
            {
                return std::clamp(vehicle_.steeringAngle(piece.curvatureAt(driven)), -vehicle_.maxSteeringAngle,
                                  vehicle_.maxSteeringAngle);
            };
            const Node from = nodes_.back();
            if (runs.empty() || std::abs(runs.back().last.endCurvature() - piece.curvature) >= SAME_CURVATURE)
                runs.push_back({0, piece, piece, {{from.s, angleAt(0.0)}}});
            Run &run = runs.back();
            const int parts = std::max(1, static_cast<int>(std::ceil(piece.driven() / NODE_DISTANCE - 1e-9)));
            for (int k = 1; k <= parts; ++k)
            {
                const double before = piece.driven() * (k - 1) / parts, driven = piece.driven() * k / parts;
                nodes_.push_back({advance(from.pose, piece, driven),
                                  {piece.curvatureAt(before), piece.length / parts, piece.sharpness},
                                  from.s + driven});
                if (piece.sharpness != 0.0 || k == parts)
                    run.knots.push_back({from.s + driven, angleAt(driven)});
            }
            run.last = piece;
            run.endNode = nodes_.size() - 1;
        }
        dropStubs(runs);
        return runs;
    }

    /** Adds ramps of the steering angle at the jumps between \e runs, or ends the leg there. */
    void ReferencePath::addLegs(const std::vector<Run> &runs, std::size_t firstNode, int direction,
                                const ReferenceParameters &parameters)
    {
        // The part of the body that a heading error moves farthest.
        const double reach = std::max(vehicle_.wheelbase + vehicle_.frontOverhang, vehicle_.rearOverhang);
        ReferenceLeg leg;
        leg.direction = direction;
        leg.beginLength = nodes_[firstNode].s;
        const auto addKnots = [&leg](const Run &run)
        {
            for (const SteeringKnot &knot : run.knots)
                if (leg.steering.empty() || knot.s > leg.steering.back().s + SAME_PLACE)
                    leg.steering.push_back(knot);
        };
        const auto close = [&](std::size_t lastNode)
        {
            leg.endLength = leg.steering.back().s;
            legs_.push_back(leg);
            legNodes_.push_back({firstNode, lastNode});
            firstNode = lastNode;
            leg.steering.clear();
            leg.beginLength = leg.endLength;
        };
        Run current = runs.front();
        for (std::size_t k = 0; k + 1 < runs.size(); ++k)
        {
            Run next = runs[k + 1];
            const double jump = std::abs(next.knots.front().angle - current.knots.back().angle);
            const double curvatureJump = std::abs(next.first.curvature - current.last.endCurvature());
            double most =
                std::min(0.5 * parameters.maxBlendLength, 4.0 * parameters.bodyTolerance / (reach * curvatureJump));
            // A ramp of half length l that replaces clothoids changes the heading by the difference of sharpness * l^2
            // / 2.
            if (const double kink = std::abs(next.first.sharpness - current.last.sharpness); kink > 0.0)
                most = std::min(most, std::sqrt(2.0 * BLEND_YAW / kink));
            double left = std::min({most, 0.5 * runs[k].length(), current.last.driven()});
            double right = std::min({most, 0.5 * next.length(), next.first.driven()});
            // A ramp that is not centred on its jump changes the heading by |jump| * |left - right| / 2.
            const double uneven = 2.0 * BLEND_YAW / curvatureJump;
            left = std::min(left, right + uneven);
            right = std::min(right, left + uneven);
            const bool stops = vehicle_.maxSteeringRate * (left + right) < parameters.minBlendSpeed * jump;
            if (!stops)
            {
                current.trimEnd(left);
                next.trimBegin(right);
            }
            addKnots(current);
            if (stops)
                close(current.endNode);
            current = std::move(next);
        }
        addKnots(current);
        close(current.endNode);
    }

    Pose ReferencePath::pose(std::size_t leg, double s) const
    {
        const auto begin = nodes_.begin() + static_cast<std::ptrdiff_t>(legNodes_[leg].first) + 1;
        const auto end = nodes_.begin() + static_cast<std::ptrdiff_t>(legNodes_[leg].last);
        const auto to = std::lower_bound(begin, end, s, [](const Node &each, double value) { return each.s < value; });
        const Node &from = *(to - 1);
        Pose pose = advance(from.pose, to->piece, std::clamp(s - from.s, 0.0, to->piece.driven()));
        pose.yaw = wrapAngle(pose.yaw);
        return pose;
    }
}  // namespace parking
