#include "path_tracking/reference/DrivablePath.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "parking_geometry/text/Text.h"
#include "path_tracking/reference/CornerRounding.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Metres between the states of a shunt. */
        constexpr double SHUNT_STEP = 0.1;

        double distance(const Pose &a, const Pose &b)
        {
            return std::hypot(a.x - b.x, a.y - b.y);
        }

        bool apart(const Pose &a, const Pose &b, double most, double mostYaw)
        {
            return distance(a, b) > most || std::abs(wrapAngle(a.yaw - b.yaw)) > mostYaw;
        }

        class Builder
        {
        public:
            Builder(const Vehicle &vehicle, const CornerParameters &parameters, const Pose &start)
              : vehicle_(vehicle),
                parameters_(parameters),
                curves_(vehicle.minTurningRadius()),
                car_(start)
            {
            }

            void add(const PathSection &section)
            {
                result_.corners += section.cornerCount;
                const bool inside = section.lastCornerNode > 0;
                if (inside)
                {
                    follow(section);
                    return;
                }
                if (apart(car_, sectionBegin(section), 0.01, CORNER_ANGLE))
                    shuntTo(sectionBegin(section));
                std::vector<PathNode> nodes = section.nodes;
                nodes.front().pose = sectionBegin(section);
                append(section.direction, nodes);
            }

            DrivablePath finish(const Pose &goal)
            {
                if (result_.corners > 0 && apart(car_, goal, parameters_.endTolerance, parameters_.endYawTolerance))
                {
                    ++result_.corners;
                    shuntTo(goal);
                }
                if (!(result_.deviation <= parameters_.maxDeviation))
                    throw Error("path: the car would leave it by " +
                                formatNumber(std::round(100.0 * result_.deviation) / 100.0) +
                                " m at its corners; at most " + formatNumber(parameters_.maxDeviation) +
                                " m are allowed");
                return std::move(result_);
            }

        private:
            /** Where a section begins, with the heading that its first piece leaves with. */
            static Pose sectionBegin(const PathSection &section)
            {
                const Pose &pose = section.nodes.front().pose;
                return {pose.x, pose.y, section.startYaw};
            }

            void append(int direction, const std::vector<PathNode> &nodes)
            {
                if (nodes.size() < 2)
                    return;
                result_.pieces.push_back({direction, nodes});
                car_ = nodes.back().pose;
            }

            /** Cuts the corners of \e section, or turns at the worst and tries both sides of it again. */
            void follow(const PathSection &section)
            {
                RoundedSection rounded = roundCorners(section, car_, vehicle_, parameters_.steeringSlope);
                if (rounded.deviation <= parameters_.maxCut)
                {
                    result_.deviation = std::max(result_.deviation, rounded.deviation);
                    append(section.direction, rounded.nodes);
                    return;
                }
                const std::size_t corner = worstCorner(section, rounded.worstPlace);
                if (corner > 0)
                    follow(part(section, 0, corner));
                const PathSection rest = part(section, corner, section.nodes.size() - 1);
                shuntTo(sectionBegin(rest));
                if (rest.lastCornerNode > 0)
                    follow(rest);
                else
                    append(rest.direction, rest.nodes);
            }

            /** The corner nearest to \e place metres from the begin, the begin among them when the car is not there. */
            std::size_t worstCorner(const PathSection &section, double place) const
            {
                std::size_t best = section.lastCornerNode;
                double least = std::numeric_limits<double>::infinity();
                double along = 0.0;
                for (std::size_t i = 0; i < section.nodes.size(); ++i)
                {
                    along += section.nodes[i].length;
                    const bool candidate =
                        i == 0 ? apart(car_, sectionBegin(section), 0.01, CORNER_ANGLE) : section.corner[i];
                    if (candidate && std::abs(along - place) < least)
                    {
                        least = std::abs(along - place);
                        best = i;
                    }
                }
                return best;
            }

            /** Nodes \e first to \e last of \e section as a section of their own. */
            static PathSection part(const PathSection &section, std::size_t first, std::size_t last)
            {
                PathSection result;
                result.direction = section.direction;
                const auto nodes = section.nodes.begin();
                result.nodes.assign(nodes + static_cast<std::ptrdiff_t>(first),
                                    nodes + static_cast<std::ptrdiff_t>(last) + 1);
                const PathNode &leaving = result.nodes[1];
                result.startYaw = leaving.pose.yaw - section.direction * leaving.curvature * leaving.length;
                result.nodes.front().pose.yaw = result.startYaw;
                result.nodes.front().length = 0.0;
                result.corner.assign(result.nodes.size(), false);
                for (std::size_t i = first + 1; i < last; ++i)
                {
                    if (!section.corner[i])
                        continue;
                    result.corner[i - first] = true;
                    result.lastCornerNode = i - first;
                    ++result.cornerCount;
                }
                return result;
            }

            /** Drives to \e pose by the shortest Reeds-Shepp curve. */
            void shuntTo(const Pose &pose)
            {
                const ReedsSheppCurve curve = curves_.shortest(car_, pose);
                Path arcs{car_, {}};
                for (std::size_t i = 0; i < curve.count; ++i)
                    if (std::abs(curve.pieces[i].length) > 1e-6)
                        arcs.append(curve.pieces[i]);
                const SampledPath path = arcs.sample(SHUNT_STEP);
                ++result_.turns;
                for (std::size_t i = 1; i < path.size();)
                {
                    DrivablePiece piece;
                    piece.direction = path[i].direction;
                    piece.nodes.push_back({path[i - 1].pose, path[i].curvature, 0.0});
                    for (; i < path.size() && path[i].direction == piece.direction; ++i)
                    {
                        piece.nodes.push_back(
                            {path[i].pose, path[i].curvature, path[i].arcLength - path[i - 1].arcLength});
                        result_.deviation = std::max(
                            result_.deviation, std::min(distance(path[i].pose, car_), distance(path[i].pose, pose)));
                    }
                    result_.pieces.push_back(std::move(piece));
                }
                car_ = pose;
            }

            const Vehicle &vehicle_;
            const CornerParameters &parameters_;
            ReedsShepp curves_;
            Pose car_;
            DrivablePath result_;
        };
    }  // namespace

    DrivablePath makeDrivable(const std::vector<PathSection> &sections, const Pose &goal, const Vehicle &vehicle,
                              const CornerParameters &parameters)
    {
        Builder builder(vehicle, parameters, sections.front().nodes.front().pose);
        for (const PathSection &section : sections)
            builder.add(section);
        return builder.finish(goal);
    }
}  // namespace parking
