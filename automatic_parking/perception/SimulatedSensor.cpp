#include "automatic_parking/perception/SimulatedSensor.h"

#include "automatic_parking/perception/TouchedCells.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/ObstacleSet.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double SLACK = 1e-6;  // of a cell, and of a period

        bool isSameLayout(const OccupancyGrid &a, const OccupancyGrid &b)
        {
            return a.width() == b.width() && a.height() == b.height() && a.resolution() == b.resolution() &&
                   a.origin().x == b.origin().x && a.origin().y == b.origin().y && a.origin().yaw == b.origin().yaw;
        }
    }  // namespace

    void SensorParameters::validate() const
    {
        const Require require("sensor");
        require.positive("range", range, "metres");
        require.that(fieldOfView > 0.0 && fieldOfView <= 2.0 * PI, "fieldOfView", fieldOfView,
                     "above 0 and up to 2 pi radians");
        require.finite("mount.x", mount.x, "metres");
        require.finite("mount.y", mount.y, "metres");
        require.finite("mount.yaw", mount.yaw, "radians");
        require.positive("rate", rate, "frames per second");
        require.notNegative("rangeNoise", rangeNoise, "metres");
    }

    /** The true obstacles in the cells of a map, and the cells that a frame has seen. Lengths are in cells. */
    class SimulatedSensor::Raster
    {
    public:
        explicit Raster(const OccupancyGrid &map)
          : truth_(map.width(), map.height(), map.resolution(), map.origin()),
            seen_(map.cells().size(), Cell::Unknown)
        {
        }

        bool hasLayoutOf(const OccupancyGrid &map) const
        {
            return isSameLayout(truth_, map);
        }

        /** Replaces the obstacles by solid polygons in the coordinates of the map's origin. */
        void setObstacles(const std::vector<const std::vector<Polygon> *> &groups)
        {
            truth_ = OccupancyGrid(truth_.width(), truth_.height(), truth_.resolution(), truth_.origin());
            std::vector<std::pair<std::size_t, Edge>> crossed;
            for (const std::vector<Polygon> *group : groups)
                for (const Polygon &solid : *group)
                {
                    const Polygon local = inCells(truth_, solid);
                    visitTouchedCells(
                        truth_, local,
                        [&](std::size_t cell, std::size_t edge)
                        {
                            truth_.set(cell % truth_.width(), cell / truth_.width(), Cell::Occupied);
                            if (edge != INNER_CELL)
                                crossed.push_back({cell, {local[edge], local[(edge + 1) % local.size()]}});
                        });
                }
            // Sorted by cells: the edges of cell k begin at edges_[first_[k]].
            std::stable_sort(crossed.begin(), crossed.end(),
                             [](const auto &a, const auto &b) { return a.first < b.first; });
            edges_.clear();
            first_.assign(seen_.size() + 1, 0);
            for (const auto &[cell, edge] : crossed)
            {
                ++first_[cell + 1];
                edges_.push_back(edge);
            }
            for (std::size_t cell = 1; cell < first_.size(); ++cell)
                first_[cell] += first_[cell - 1];
        }

        /** Follows a ray up to the first obstacle or the range, and sees the cells that it crosses.

            \param noise error of the measured distance of the obstacle */
        void look(const Eigen::Vector2d &from, const Eigen::Vector2d &ray, double range, double noise)
        {
            const double hit = follow(from, ray, range);
            const double measured = hit + noise;
            for (const auto &[cell, distance] : passed_)
                if (distance <= measured + SLACK)
                    see(cell, truth_.cells()[cell]);
            const Eigen::Vector2d end = from + measured * ray;
            if (hit <= range && noise != 0.0 && measured > 0.0 && measured <= range && isInside(end))
                see(cellOf(end), Cell::Occupied);
        }

        /** Whether a point lies in the map. */
        bool isInside(const Eigen::Vector2d &point) const
        {
            return point.x() >= 0.0 && point.y() >= 0.0 && point.x() < static_cast<double>(truth_.width()) &&
                   point.y() < static_cast<double>(truth_.height());
        }

        /** The seen cells that differ from \e map. Begins the next frame. */
        GridUpdate takeChanges(const OccupancyGrid &map)
        {
            GridUpdate changes;
            for (const std::size_t cell : visited_)
            {
                if (map.cells()[cell] != seen_[cell])
                    changes.push_back({static_cast<std::uint32_t>(cell % map.width()),
                                       static_cast<std::uint32_t>(cell / map.width()), seen_[cell]});
                seen_[cell] = Cell::Unknown;
            }
            visited_.clear();
            return changes;
        }

    private:
        std::size_t cellOf(const Eigen::Vector2d &point) const
        {
            return static_cast<std::size_t>(point.y()) * truth_.width() + static_cast<std::size_t>(point.x());
        }

        void see(std::size_t cell, Cell occupancy)
        {
            if (seen_[cell] == Cell::Unknown)
                visited_.push_back(cell);
            if (seen_[cell] != Cell::Occupied)
                seen_[cell] = occupancy;
        }

        /** Distance of the first obstacle along a ray; infinite beyond the range. Stores the cells up to there in
            passed_ (J. Amanatides and A. Woo, "A fast voxel traversal algorithm for ray tracing", 1987). */
        double follow(const Eigen::Vector2d &from, const Eigen::Vector2d &ray, double range)
        {
            passed_.clear();
            // Signed arithmetic, as a ray may leave the map on either side.
            std::ptrdiff_t place[2] = {static_cast<std::ptrdiff_t>(from.x()), static_cast<std::ptrdiff_t>(from.y())};
            const auto width = static_cast<std::ptrdiff_t>(truth_.width()),
                       height = static_cast<std::ptrdiff_t>(truth_.height());
            double next[2], stride[2];  // distance to the next border of cells, and between borders
            for (int axis = 0; axis < 2; ++axis)
            {
                const double border = static_cast<double>(place[axis] + (ray[axis] > 0.0 ? 1 : 0));
                stride[axis] = ray[axis] == 0.0 ? HUGE_VAL : 1.0 / std::abs(ray[axis]);
                next[axis] = ray[axis] == 0.0 ? HUGE_VAL : std::abs(border - from[axis]) * stride[axis];
            }
            for (double entry = 0.0; entry <= range;)
            {
                const auto cell = static_cast<std::size_t>(place[1] * width + place[0]);
                passed_.emplace_back(cell, entry);
                const double exit = std::min(next[0], next[1]);
                const double hit = hitIn(cell, from, ray);
                if (hit <= exit + SLACK)
                    return hit <= range ? hit : HUGE_VAL;
                const int axis = next[0] < next[1] ? 0 : 1;
                place[axis] += ray[axis] > 0.0 ? 1 : -1;
                next[axis] += stride[axis];
                entry = exit;
                if (place[0] < 0 || place[1] < 0 || place[0] >= width || place[1] >= height)
                    break;
            }
            return HUGE_VAL;
        }

        /** Distance to the first edge of a cell along a ray; infinite if it crosses none of them. */
        double hitIn(std::size_t cell, const Eigen::Vector2d &from, const Eigen::Vector2d &ray) const
        {
            double first = HUGE_VAL;
            for (std::size_t k = first_[cell]; k < first_[cell + 1]; ++k)
            {
                const Eigen::Vector2d along = edges_[k].to - edges_[k].from, start = edges_[k].from - from;
                const double cross = ray.x() * along.y() - ray.y() * along.x();
                if (cross == 0.0)
                    continue;
                const double distance = (start.x() * along.y() - start.y() * along.x()) / cross;
                const double share = (start.x() * ray.y() - start.y() * ray.x()) / cross;
                const double slack = SLACK / along.norm();
                if (distance >= 0.0 && distance < first && share >= -slack && share <= 1.0 + slack)
                    first = distance;
            }
            return first;
        }

        OccupancyGrid truth_;  // occupied cells are touched by an obstacle
        std::vector<std::size_t> first_;
        std::vector<Edge> edges_;
        std::vector<std::pair<std::size_t, double>> passed_;  // cells of a ray and where it enters them
        std::vector<Cell> seen_;                              // unknown if not seen in this frame
        std::vector<std::size_t> visited_;                    // cells seen in this frame
    };

    SimulatedSensor::SimulatedSensor(const Scenario &truth, const SensorParameters &parameters,
                                     const std::vector<TimedObstacle> &timed)
      : parameters_((parameters.validate(), parameters)),
        solids_(ObstacleSet::fromScenario(truth).solids()),
        random_(parameters.seed)
    {
        for (std::size_t i = 0; i < timed.size(); ++i)
        {
            const TimedObstacle &each = timed[i];
            if (!(each.appears < each.disappears))
                throw Error("timed obstacle " + std::to_string(i + 1) + " appears at " + formatNumber(each.appears) +
                            " s and disappears at " + formatNumber(each.disappears) + " s; the latter must be later");
            timed_.push_back({each, ObstacleSet::fromPolygons({each.outline}, truth.bounds).solids(), false});
        }
    }

    SimulatedSensor::~SimulatedSensor() = default;

    void SimulatedSensor::prepare(double time, const OccupancyGrid &map)
    {
        bool isStale = raster_ == nullptr;
        if (isStale)
            raster_ = std::make_unique<Raster>(map);
        else if (!raster_->hasLayoutOf(map))
            throw Error("sensor: the map has another size, resolution or origin than at the first call");
        std::vector<const std::vector<Polygon> *> groups{&solids_};
        for (Timed &each : timed_)
        {
            const bool exists = time >= each.obstacle.appears && time < each.obstacle.disappears;
            isStale = isStale || exists != each.exists;
            each.exists = exists;
            if (exists)
                groups.push_back(&each.solids);
        }
        if (isStale)
            raster_->setObstacles(groups);
    }

    double SimulatedSensor::noise()
    {
        if (parameters_.rangeNoise == 0.0)
            return 0.0;
        // Box and Muller's transform: std::normal_distribution differs between standard libraries.
        const double u = (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53;
        const double w = static_cast<double>(random_() >> 11) * 0x1p-53;
        return parameters_.rangeNoise * std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * PI * w);
    }

    GridUpdate SimulatedSensor::observe(double time, const Pose &car, const OccupancyGrid &map)
    {
        if (!firstTime_)
            firstTime_ = time;
        const double period = std::floor((time - *firstTime_) * parameters_.rate + SLACK);
        if (period <= period_)
            return {};
        prepare(time, map);
        period_ = period;
        const Pose eye = relativeTo(map.origin(), compose(car, parameters_.mount));
        const double side = map.resolution();
        const Eigen::Vector2d from(eye.x / side, eye.y / side);
        if (!raster_->isInside(from))
            return {};
        // No cell of the map is farther away than its diagonal.
        const double range = std::min(parameters_.range / side, std::hypot(map.width(), map.height()));
        const double gaps = std::ceil(parameters_.fieldOfView * range);
        for (double k = 0.0; k <= gaps; ++k)
        {
            const double angle = eye.yaw + parameters_.fieldOfView * (k / gaps - 0.5);
            raster_->look(from, {std::cos(angle), std::sin(angle)}, range, noise() / side);
        }
        return raster_->takeChanges(map);
    }
}  // namespace parking
