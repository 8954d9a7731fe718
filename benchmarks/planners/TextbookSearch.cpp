#include "benchmarks/planners/TextbookSearch.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/FootprintChecker.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double MOST_CELLS = 5e7;  // cell size of the disc's distances
        constexpr unsigned LOOK_AT_CLOCK = 4096;
    }  // namespace

    /** Path lengths of a disc with the car's inscribed radius to one position: Dijkstra's algorithm over eight
        neighbours. */
    class TextbookSearch::DiscWays
    {
    public:
        DiscWays(const TextbookProblem &problem, double resolution)
          : x_(problem.bounds.min.x()),
            y_(problem.bounds.min.y()),
            resolution_(resolution),
            columns_(std::floor((problem.bounds.max.x() - x_) / resolution) + 1.0),
            rows_(std::floor((problem.bounds.max.y() - y_) / resolution) + 1.0)
        {
            if (columns_ * rows_ > MOST_CELLS)
                throw Error("the world has too many cells; set a larger xy_resolution");
            cost_.assign(static_cast<std::size_t>(columns_ * rows_), UNKNOWN);
            const FootprintChecker &footprint = *problem.footprint;
            const double radius = footprint.vehicle().inscribedRadius();
            std::priority_queue<std::pair<float, std::size_t>, std::vector<std::pair<float, std::size_t>>,
                                std::greater<>>
                open;
            const std::size_t first = cellOf(problem.goal);
            cost_[first] = 0.0F;
            open.emplace(0.0F, first);
            for (unsigned popped = 0; !open.empty(); ++popped)
            {
                if (popped % LOOK_AT_CLOCK == 0 && problem.stop())
                    return;
                const auto [cost, cell] = open.top();
                open.pop();
                if (cost > cost_[cell])
                    continue;
                const auto width = static_cast<long>(columns_), height = static_cast<long>(rows_);
                const long column = static_cast<long>(cell) % width, row = static_cast<long>(cell) / width;
                for (long dy = -1; dy <= 1; ++dy)
                    for (long dx = -1; dx <= 1; ++dx)
                    {
                        const long i = column + dx, j = row + dy;
                        if (i < 0 || j < 0 || i >= width || j >= height)
                            continue;
                        const auto next = static_cast<std::size_t>(j * width + i);
                        const float there = cost + static_cast<float>(resolution_ * std::hypot(double(dx), double(dy)));
                        if (there >= cost_[next])
                            continue;
                        const Pose local = footprint.obstacles().toLocal(
                            {x_ + (i + 0.5) * resolution_, y_ + (j + 0.5) * resolution_, 0.0});
                        if (footprint.field().upperBound(local.x, local.y) < radius)
                            continue;
                        cost_[next] = there;
                        open.emplace(there, next);
                    }
            }
        }

        /** The distance in metres, slightly reduced, since paths do not pass through the middle of cells. */
        double from(const Pose &pose) const
        {
            const float cost = cost_[cellOf(pose)];
            return cost == UNKNOWN ? std::numeric_limits<double>::infinity()
                                   : std::max(0.0, static_cast<double>(cost) - 2.0 * resolution_) / OCTILE;
        }

    private:
        static constexpr float UNKNOWN = std::numeric_limits<float>::max();
        static constexpr double OCTILE = 1.0824;  // paths over eight neighbours are longer by up to this factor

        std::size_t cellOf(const Pose &pose) const
        {
            const double column = std::clamp(std::floor((pose.x - x_) / resolution_), 0.0, columns_ - 1.0);
            const double row = std::clamp(std::floor((pose.y - y_) / resolution_), 0.0, rows_ - 1.0);
            return static_cast<std::size_t>(row * columns_ + column);
        }

        double x_, y_, resolution_, columns_, rows_;
        std::vector<float> cost_;
    };

    TextbookSearch::TextbookSearch(TextbookProblem problem, const TextbookParameters &parameters)
      : problem_(std::move(problem)),
        parameters_(parameters)
    {
        if (parameters_.obstacleHeuristic && problem_.footprint != nullptr)
            ways_ = std::make_unique<const DiscWays>(problem_, parameters_.xyResolution);
        add({problem_.start, 0.0, 0.0, NOBODY, 0.0, 0, false});
    }

    TextbookSearch::~TextbookSearch() = default;

    std::vector<Pose> TextbookSearch::run()
    {
        while (!open_.empty() && !problem_.stop())
        {
            const std::uint32_t index = std::get<2>(open_.top());
            open_.pop();
            if (nodes_[index].closed)
                continue;
            nodes_[index].closed = true;
            const bool joins = growth_.size() % parameters_.expansionInterval == 0;
            growth_.push_back(nodes_.size());
            if (joins && problem_.isMotionFree(nodes_[index].pose, problem_.goal))
                return pathTo(index);
            expand(index);
        }
        return {};
    }

    std::uint64_t TextbookSearch::keyOf(const Pose &pose) const
    {
        const auto cell = [](double value, double size)
        {
            return static_cast<std::uint64_t>(std::max(0.0, std::floor(value / size)));
        };
        const double turn = 2.0 * PI;
        const double bin =
            std::floor(std::fmod(wrapAngle(pose.yaw) + turn, turn) / turn * parameters_.headingBins + 0.5);
        return (cell(pose.x - problem_.bounds.min.x(), parameters_.xyResolution) << 36) ^
               (cell(pose.y - problem_.bounds.min.y(), parameters_.xyResolution) << 12) ^
               (static_cast<std::uint64_t>(bin) % parameters_.headingBins);
    }

    double TextbookSearch::heuristic(const Pose &pose) const
    {
        double metres = problem_.curveToGoal(pose);
        if (ways_)
            metres = std::max(metres, ways_->from(pose));
        return parameters_.heuristicWeight * metres;
    }

    void TextbookSearch::add(Node node)
    {
        node.ahead = heuristic(node.pose);
        if (!std::isfinite(node.ahead))
            return;
        const auto [known, isNew] = cells_.emplace(keyOf(node.pose), static_cast<std::uint32_t>(nodes_.size()));
        if (!isNew)
        {
            if (nodes_[known->second].cost <= node.cost)
                return;
            nodes_[known->second].closed = true;  // replaced
            known->second = static_cast<std::uint32_t>(nodes_.size());
        }
        open_.emplace(node.cost + node.ahead, node.ahead, static_cast<std::uint32_t>(nodes_.size()));
        nodes_.push_back(node);
    }

    void TextbookSearch::expand(std::uint32_t index)
    {
        const TextbookParameters &p = parameters_;
        const Node node = nodes_[index];
        for (unsigned k = 0; k < p.steeringAngles; ++k)
            for (const int direction : {1, -1})
            {
                const double lock = -1.0 + 2.0 * k / (p.steeringAngles - 1.0);
                const double curvature = lock / problem_.turningRadius;
                const Pose pose = advance(node.pose, PathPiece(curvature, direction * p.motionLength));
                Node next{{pose.x, pose.y, wrapAngle(pose.yaw)},
                          node.cost + p.motionLength,
                          0.0,
                          index,
                          curvature,
                          direction,
                          false};
                if (direction < 0)
                    next.cost += p.reversePenalty * p.motionLength;
                if (direction * node.direction < 0)
                    next.cost += p.gearChangePenalty;
                next.cost += p.steeringPenalty * std::abs(lock) * p.motionLength;
                const auto known = cells_.find(keyOf(next.pose));
                if (known != cells_.end() && nodes_[known->second].cost <= next.cost)
                    continue;
                if (problem_.isMotionFree(node.pose, next.pose))
                    add(next);
            }
    }

    std::vector<Pose> TextbookSearch::pathTo(std::uint32_t index) const
    {
        std::vector<Pose> poses{problem_.goal};
        for (; index != NOBODY; index = nodes_[index].parent)
            poses.push_back(nodes_[index].pose);
        std::reverse(poses.begin(), poses.end());
        return poses;
    }
}  // namespace parking
