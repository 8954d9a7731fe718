#include "path_tracking/reference/CornerRounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Core>

namespace parking
{
    namespace
    {
        constexpr double STEP = 0.05;           ///< metres between states of the simulated car
        constexpr double BACK_ON_PATH = 0.005;  ///< metres beside the section that count as being on it
        constexpr double BACK_IN_YAW = 0.005;   ///< radians likewise
        constexpr double SEARCH_AHEAD = 2.0;    ///< metres of the section searched for the nearest place

        /** The section as a polyline of places with distances from its begin. */
        class Guide
        {
        public:
            explicit Guide(const PathSection &section)
            {
                // Arcs are resampled so that the polyline is the section.
                append({section.nodes.front().pose.x, section.nodes.front().pose.y});
                for (std::size_t i = 1; i < section.nodes.size(); ++i)
                {
                    const PathNode &node = section.nodes[i];
                    const int pieces =
                        node.curvature == 0.0 ? 1 : std::max(1, static_cast<int>(std::ceil(node.length / STEP)));
                    for (int k = pieces - 1; k >= 0; --k)
                    {
                        const Pose place = advance(node.pose, node.curvature,
                                                   -section.direction * node.length * k / static_cast<double>(pieces));
                        append({place.x, place.y});
                    }
                    if (i == section.lastCornerNode)
                        lastCorner_ = distances_.back();
                }
            }

            double length() const
            {
                return distances_.back();
            }

            /** Distance of the last corner from the begin. */
            double lastCorner() const
            {
                return lastCorner_;
            }

            Eigen::Vector2d endDirection() const
            {
                const std::size_t n = points_.size();
                return (points_[n - 1] - points_[n - 2]).normalized();
            }

            const Eigen::Vector2d &end() const
            {
                return points_.back();
            }

            /** The place at \e distance; beyond the end straight on. */
            Eigen::Vector2d at(double distance) const
            {
                if (distance >= length())
                    return points_.back() + endDirection() * (distance - length());
                const auto next = std::upper_bound(distances_.begin() + 1, distances_.end() - 1, distance);
                const auto i = static_cast<std::size_t>(next - distances_.begin());
                const double share = (distance - distances_[i - 1]) / (distances_[i] - distances_[i - 1]);
                return points_[i - 1] + share * (points_[i] - points_[i - 1]);
            }

            /** Distance from the begin to the place nearest to \e point, at most SEARCH_AHEAD beyond \e from. */
            double nearest(const Eigen::Vector2d &point, double from, double &deviation) const
            {
                auto next = std::upper_bound(distances_.begin() + 1, distances_.end() - 1, from);
                double best = std::numeric_limits<double>::infinity();
                double result = from;
                for (auto i = static_cast<std::size_t>(next - distances_.begin()); i < points_.size(); ++i)
                {
                    const Eigen::Vector2d edge = points_[i] - points_[i - 1];
                    const double span = distances_[i] - distances_[i - 1];
                    const double lowest = std::max(0.0, (from - distances_[i - 1]) / span);
                    const double share =
                        std::clamp((point - points_[i - 1]).dot(edge) / edge.squaredNorm(), lowest, 1.0);
                    const double apart = (points_[i - 1] + share * edge - point).norm();
                    if (apart < best)
                    {
                        best = apart;
                        result = distances_[i - 1] + share * span;
                    }
                    if (distances_[i] > from + SEARCH_AHEAD)
                        break;
                }
                deviation = best;
                return result;
            }

        private:
            void append(const Eigen::Vector2d &point)
            {
                if (points_.empty())
                    distances_.push_back(0.0);
                else if ((point - points_.back()).norm() < 1e-9)
                    return;
                else
                    distances_.push_back(distances_.back() + (point - points_.back()).norm());
                points_.push_back(point);
            }

            std::vector<Eigen::Vector2d> points_;
            std::vector<double> distances_;
            double lastCorner_{0.0};
        };

        /** Where on the section the simulated car may go over to it: the node, if it stands at one exactly enough. */
        std::optional<std::size_t> joinNode(const PathSection &section, const Pose &car, double turnedCurvature)
        {
            for (std::size_t i = section.lastCornerNode + 1; i + 1 < section.nodes.size(); ++i)
            {
                const Pose &place = section.nodes[i].pose;
                if (std::abs(place.x - car.x) > STEP || std::abs(place.y - car.y) > STEP)
                    continue;
                const Pose offset = relativeTo(place, car);
                if (std::abs(offset.x) <= 0.5 * STEP + 1e-9 && std::abs(offset.y) <= BACK_ON_PATH &&
                    std::abs(offset.yaw) <= BACK_IN_YAW &&
                    std::abs(section.nodes[i + 1].curvature - turnedCurvature) < 0.02)
                    return i;
            }
            return std::nullopt;
        }

        /** One simulated drive, aiming \e ahead metres in front. Directions of travel are headings here: a car in
            reverse is a car driving forwards with its heading turned by half a turn and its curvature negated. */
        RoundedSection pursue(const PathSection &section, const Guide &guide, const Pose &start, const Vehicle &vehicle,
                              double steeringSlope, double ahead)
        {
            const double sign = section.direction;
            const double turned = section.direction > 0 ? 0.0 : PI;
            Pose car{start.x, start.y, start.yaw + turned};
            RoundedSection result;
            result.nodes.push_back({start, 0.0, 0.0});
            double along = 0.0, steering = 0.0;
            bool first = true;
            const auto most = static_cast<std::size_t>((2.0 * guide.length() + 10.0) / STEP);
            for (std::size_t count = 0; count < most; ++count)
            {
                double deviation = 0.0;
                along = guide.nearest({car.x, car.y}, along, deviation);
                if (deviation > result.deviation)
                {
                    result.deviation = deviation;
                    result.worstPlace = along;
                }
                if (along > guide.lastCorner())
                {
                    const Pose real{car.x, car.y, car.yaw - turned};
                    const double curvature = sign * vehicle.curvature(steering);
                    if (const auto join = joinNode(section, real, curvature))
                    {
                        // The few millimetres between the car and the section are left to the controller.
                        result.nodes.back().pose = section.nodes[*join].pose;
                        result.nodes.insert(result.nodes.end(), section.nodes.begin() + *join + 1, section.nodes.end());
                        return result;
                    }
                }
                const Eigen::Vector2d target = guide.at(along + ahead);
                const Pose aim = relativeTo(car, {target.x(), target.y(), 0.0});
                const double squared = aim.x * aim.x + aim.y * aim.y;
                // A target behind the car asks for full lock, not for a gentle curve round it.
                double wanted = aim.x <= 0.0 ? std::copysign(vehicle.maxSteeringAngle, aim.y)
                                             : vehicle.steeringAngle(2.0 * aim.y / squared);
                wanted = std::clamp(wanted, -vehicle.maxSteeringAngle, vehicle.maxSteeringAngle);
                // The car stands at the begin of a section and may turn its wheels there.
                const double change = first ? 2.0 * PI : steeringSlope * STEP;
                steering = std::clamp(wanted, steering - change, steering + change);
                first = false;
                const double curvature = vehicle.curvature(steering);
                Pose next = advance(car, curvature, STEP);
                double driven = STEP;
                const double left = (guide.end() - Eigen::Vector2d(car.x, car.y)).dot(guide.endDirection());
                const double gain = left - (guide.end() - Eigen::Vector2d(next.x, next.y)).dot(guide.endDirection());
                const bool ends = along >= guide.length() - 2.0 * STEP && gain > 1e-6 && left <= gain;
                if (ends)
                {
                    driven = STEP * std::max(0.0, left) / gain;
                    next = advance(car, curvature, driven);
                }
                car = next;
                if (driven > 1e-6)
                    result.nodes.push_back({{car.x, car.y, car.yaw - turned}, sign * curvature, driven});
                if (ends)
                {
                    guide.nearest({car.x, car.y}, along, deviation);
                    result.deviation = std::max(result.deviation, deviation);
                    if (result.nodes.size() < 2)
                        break;
                    result.nodes.front().curvature = result.nodes[1].curvature;
                    return result;
                }
            }
            result.deviation = std::numeric_limits<double>::infinity();
            return result;
        }
    }  // namespace

    RoundedSection roundCorners(const PathSection &section, const Pose &start, const Vehicle &vehicle,
                                double steeringSlope)
    {
        const Guide guide(section);
        constexpr std::array<double, 6> DISTANCES{0.25, 0.375, 0.5, 0.75, 1.0, 2.0};
        RoundedSection best;
        best.deviation = std::numeric_limits<double>::infinity();
        for (const double share : DISTANCES)
        {
            RoundedSection candidate =
                pursue(section, guide, start, vehicle, steeringSlope, share * vehicle.minTurningRadius());
            if (candidate.deviation < best.deviation)
                best = std::move(candidate);
        }
        return best;
    }
}  // namespace parking
