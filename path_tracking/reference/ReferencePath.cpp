#include "path_tracking/reference/ReferencePath.h"

#include "parking_geometry/text/Require.h"
#include "path_tracking/reference/DrivablePath.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace parking
{
    namespace
    {
        /** Nodes are no farther apart than this, so that projecting onto chords errs by less than 0.5 mm. */
        constexpr double NODE_DISTANCE = 0.1;
        /** Radians that the heading may be off behind a ramp. */
        constexpr double BLEND_YAW = 4e-4;
        /** Pieces whose curvature differs by less are one arc. */
        constexpr double SAME_CURVATURE = 1e-6;

        /** Metres; a shorter stretch of another curvature turns the car by less than 0.05 degrees at full lock. */
        constexpr double SHORTEST_RUN = 0.002;
        constexpr double STUB_JUMP = 0.1;  // radians of steering

        /** Neighbouring pieces of equal curvature. */
        struct Run
        {
            std::size_t endNode;
            double begin;
            double end;
            double curvature;
            double angle;

            double length() const
            {
                return end - begin;
            }
        };

        /** Joins what is too short to be worth steering for, and far off the steering angles round it, to its
           neighbour. A finely sampled clothoid has short runs too, but no jumps. */
        void dropStubs(std::vector<Run> &runs)
        {
            std::vector<Run> kept;
            for (std::size_t k = 0; k < runs.size(); ++k)
            {
                const auto jumps = [&](const Run &other)
                {
                    return std::abs(other.angle - runs[k].angle) > STUB_JUMP;
                };
                const bool before = kept.empty() || jumps(kept.back());
                const bool after = k + 1 == runs.size() || jumps(runs[k + 1]);
                if (runs[k].length() >= SHORTEST_RUN || !before || !after || runs.size() == 1)
                {
                    kept.push_back(runs[k]);
                }
                else if (!kept.empty())
                {
                    kept.back().end = runs[k].end;
                    kept.back().endNode = runs[k].endNode;
                }
                else if (k + 1 < runs.size())
                {
                    runs[k + 1].begin = runs[k].begin;
                }
                else
                {
                    kept.push_back(runs[k]);
                }
            }
            runs = std::move(kept);
        }

        /** The pose \e part of the way along the piece that ends at \e node, its closing error spread evenly. */
        Pose alongPiece(const Pose &begin, const PathNode &node, int direction, double part)
        {
            const double driven = direction * node.length;
            const Pose onArc = advance(begin, node.curvature, driven * part);
            const Pose missed = advance(begin, node.curvature, driven);
            return {onArc.x + part * (node.pose.x - missed.x), onArc.y + part * (node.pose.y - missed.y),
                    wrapAngle(onArc.yaw + part * wrapAngle(node.pose.yaw - missed.yaw))};
        }
    }  // namespace

    void ReferenceParameters::validate() const
    {
        const Require require("reference");
        require.positive("bodyTolerance", bodyTolerance, "metres");
        require.positive("minBlendSpeed", minBlendSpeed, "m/s");
        require.positive("maxBlendLength", maxBlendLength, "metres");
        require.positive("maxCornerCut", maxCornerCut, "metres");
        require.positive("maxCornerDeviation", maxCornerDeviation, "metres");
        require.positive("cornerSpeed", cornerSpeed, "m/s");
    }

    ReferencePath::ReferencePath(const SampledPath &path, const Vehicle &vehicle, const ReferenceParameters &parameters)
      : vehicle_(vehicle)
    {
        vehicle.validate();
        parameters.validate();
        CornerParameters corners;
        corners.steeringSlope = vehicle.maxSteeringRate / parameters.cornerSpeed;
        corners.maxCut = parameters.maxCornerCut;
        corners.maxDeviation = parameters.maxCornerDeviation;
        const DrivablePath drivable = makeDrivable(splitPath(path, vehicle), path.back().pose, vehicle, corners);
        corners_ = drivable.corners;
        cornerTurns_ = drivable.turns;
        cornerDeviation_ = drivable.deviation;
        for (const DrivablePiece &piece : drivable.pieces)
        {
            if (!legs_.empty() && legs_.back().direction == piece.direction)
                legs_.back().end = LegEnd::Steering;
            addSection(piece.direction, piece.nodes, parameters);
        }
        legs_.back().end = LegEnd::Goal;
    }

    void ReferencePath::addSection(int direction, const std::vector<PathNode> &nodes,
                                   const ReferenceParameters &parameters)
    {
        // Nodes, close enough to each other.
        double s = lengths_.empty() ? 0.0 : lengths_.back();
        std::size_t legBegin = nodes_.size();
        nodes_.push_back(nodes.front());
        nodes_.back().length = 0.0;
        lengths_.push_back(s);
        std::vector<Run> runs;
        for (std::size_t i = 1; i < nodes.size(); ++i)
        {
            const PathNode &node = nodes[i];
            const int pieces = std::max(1, static_cast<int>(std::ceil(node.length / NODE_DISTANCE - 1e-9)));
            for (int k = 1; k <= pieces; ++k)
            {
                const Pose pose = k == pieces
                                      ? node.pose
                                      : alongPiece(nodes[i - 1].pose, node, direction, static_cast<double>(k) / pieces);
                s += node.length / pieces;
                nodes_.push_back({pose, node.curvature, node.length / pieces});
                lengths_.push_back(s);
            }
            if (!runs.empty() && std::abs(runs.back().curvature - node.curvature) < SAME_CURVATURE)
            {
                runs.back().end = s;
                runs.back().endNode = nodes_.size() - 1;
            }
            else
            {
                runs.push_back(
                    {nodes_.size() - 1, s - node.length, s, node.curvature, vehicle_.steeringAngle(node.curvature)});
            }
        }

        dropStubs(runs);

        // The part of the body that a wrong heading moves most.
        const double reach = std::max(vehicle_.wheelbase + vehicle_.frontOverhang, vehicle_.rearOverhang);
        ReferenceLeg leg;
        leg.direction = direction;
        const auto open = [&](const Run &run)
        {
            leg.beginLength = run.begin;
            leg.firstNode = legBegin;
            leg.steering.assign(1, {run.begin, run.angle});
        };
        const auto close = [&](const Run &run, LegEnd end)
        {
            leg.end = end;
            leg.endLength = run.end;
            leg.lastNode = run.endNode;
            if (run.end > leg.steering.back().s)
                leg.steering.push_back({run.end, run.angle});
            legs_.push_back(leg);
            legBegin = run.endNode;
        };
        open(runs.front());
        for (std::size_t k = 0; k + 1 < runs.size(); ++k)
        {
            const Run &before = runs[k], &after = runs[k + 1];
            const double jump = std::abs(after.angle - before.angle);
            const double curvatureJump = std::abs(after.curvature - before.curvature);
            const double most =
                std::min(0.5 * parameters.maxBlendLength, 4.0 * parameters.bodyTolerance / (reach * curvatureJump));
            double left = std::min(most, 0.5 * before.length());
            double right = std::min(most, 0.5 * after.length());
            // A ramp that lies unevenly round its jump leaves the heading off by |jump| * |left - right| / 2.
            const double uneven = 2.0 * BLEND_YAW / curvatureJump;
            left = std::min(left, right + uneven);
            right = std::min(right, left + uneven);
            if (vehicle_.maxSteeringRate * (left + right) < parameters.minBlendSpeed * jump)
            {
                close(before, LegEnd::Steering);
                open(after);
                continue;
            }
            if (before.end - left > leg.steering.back().s + 1e-9)
                leg.steering.push_back({before.end - left, before.angle});
            leg.steering.push_back({after.begin + right, after.angle});
        }
        close(runs.back(), LegEnd::Cusp);
    }

    Pose ReferencePath::pose(std::size_t leg, double s) const
    {
        const ReferenceLeg &l = legs_[leg];
        const auto begin = lengths_.begin() + static_cast<std::ptrdiff_t>(l.firstNode) + 1;
        const auto end = lengths_.begin() + static_cast<std::ptrdiff_t>(l.lastNode);
        const auto i = static_cast<std::size_t>(std::lower_bound(begin, end, s) - lengths_.begin());
        const double length = nodes_[i].length;
        const double part = std::clamp((s - lengths_[i - 1]) / length, 0.0, 1.0);
        return alongPiece(nodes_[i - 1].pose, nodes_[i], l.direction, part);
    }

    double ReferencePath::steering(std::size_t leg, double s) const
    {
        const std::vector<SteeringKnot> &knots = legs_[leg].steering;
        const auto next = std::upper_bound(knots.begin() + 1, knots.end() - 1, s,
                                           [](double value, const SteeringKnot &knot) { return value < knot.s; });
        const SteeringKnot &a = *(next - 1), &b = *next;
        const double part = std::clamp((s - a.s) / (b.s - a.s), 0.0, 1.0);
        return a.angle + part * (b.angle - a.angle);
    }

    double ReferencePath::steeringSlope(std::size_t leg, double s) const
    {
        const std::vector<SteeringKnot> &knots = legs_[leg].steering;
        const auto next = std::upper_bound(knots.begin() + 1, knots.end() - 1, s,
                                           [](double value, const SteeringKnot &knot) { return value < knot.s; });
        const SteeringKnot &a = *(next - 1), &b = *next;
        return (b.angle - a.angle) / (b.s - a.s);
    }

    PathProjection ReferencePath::project(std::size_t leg, const Pose &pose, double from, double to) const
    {
        const ReferenceLeg &l = legs_[leg];
        from = std::clamp(from, l.beginLength, l.endLength);
        to = std::clamp(to, from, l.endLength);
        const auto begin = lengths_.begin() + static_cast<std::ptrdiff_t>(l.firstNode) + 1;
        const auto end = lengths_.begin() + static_cast<std::ptrdiff_t>(l.lastNode);
        auto i = static_cast<std::size_t>(std::lower_bound(begin, end, from) - lengths_.begin());
        double best = std::numeric_limits<double>::infinity();
        double s = from;
        for (; i <= l.lastNode; ++i)
        {
            const Pose &a = nodes_[i - 1].pose, &b = nodes_[i].pose;
            const double dx = b.x - a.x, dy = b.y - a.y;
            const double squared = dx * dx + dy * dy;
            const double lowest = std::max(0.0, (from - lengths_[i - 1]) / nodes_[i].length);
            const double highest = std::min(1.0, (to - lengths_[i - 1]) / nodes_[i].length);
            const double part = squared > 0.0 ? std::clamp(((pose.x - a.x) * dx + (pose.y - a.y) * dy) / squared,
                                                           lowest, std::max(lowest, highest))
                                              : lowest;
            const double ex = pose.x - (a.x + part * dx), ey = pose.y - (a.y + part * dy);
            const double apart = ex * ex + ey * ey;
            if (apart < best)
            {
                best = apart;
                s = lengths_[i - 1] + part * nodes_[i].length;
            }
            if (lengths_[i] >= to)
                break;
        }
        // From the chord to the arc: one step along it.
        Pose place = this->pose(leg, s);
        s = std::clamp(s + l.direction * relativeTo(place, pose).x, from, to);
        place = this->pose(leg, s);
        const Pose offset = relativeTo(place, pose);
        return {s, offset.y, offset.yaw, l.direction * offset.x, std::hypot(offset.x, offset.y)};
    }
}  // namespace parking
