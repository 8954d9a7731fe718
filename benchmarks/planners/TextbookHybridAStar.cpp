#include "benchmarks/planners/TextbookHybridAStar.h"

#include "benchmarks/planners/RangedParameter.h"
#include "parking_geometry/Pose.h"
#include "state_validity/ompl/CurveSpace.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplPose.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Exception.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        constexpr double MOST_CELLS = 5e7;  // cell size of the disc's distances
        constexpr unsigned LOOK_AT_CLOCK = 4096;

        /** Path lengths of a disc with the car's inscribed radius to one position: Dijkstra's algorithm over eight
            neighbours. */
        class DiscWays
        {
        public:
            DiscWays(const FootprintChecker &footprint, const ob::RealVectorBounds &bounds, double resolution,
                     const Pose &goal, const ob::PlannerTerminationCondition &ptc)
              : x_(bounds.low[0]),
                y_(bounds.low[1]),
                resolution_(resolution),
                columns_(std::floor((bounds.high[0] - x_) / resolution) + 1.0),
                rows_(std::floor((bounds.high[1] - y_) / resolution) + 1.0)
            {
                if (columns_ * rows_ > MOST_CELLS)
                    throw ompl::Exception("textbook_hybrid_astar",
                                          "the world has too many cells; set a larger xy_resolution");
                cost_.assign(static_cast<std::size_t>(columns_ * rows_), UNKNOWN);
                const double radius = footprint.vehicle().inscribedRadius();
                std::priority_queue<std::pair<float, std::size_t>, std::vector<std::pair<float, std::size_t>>,
                                    std::greater<>>
                    open;
                const std::size_t first = cellOf(goal);
                cost_[first] = 0.0F;
                open.emplace(0.0F, first);
                for (unsigned popped = 0; !open.empty(); ++popped)
                {
                    if (popped % LOOK_AT_CLOCK == 0 && ptc)
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
                            const float there =
                                cost + static_cast<float>(resolution_ * std::hypot(double(dx), double(dy)));
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

        struct Node
        {
            Pose pose;
            double cost;
            std::uint32_t parent;
            int direction;
            bool closed;
        };
    }  // namespace

    class TextbookHybridAStar::Search
    {
    public:
        Search(const ob::SpaceInformationPtr &si, const Parameters &parameters, const ob::State *start,
               const ob::State *goal, const ob::PlannerTerminationCondition &ptc)
          : si_(si),
            p_(parameters),
            goal_(goal),
            ptc_(ptc),
            curvature_(1.0 / CurveSpace(*si->getStateSpace()).turningRadius()),
            bounds_(si->getStateSpace()->as<ob::SE2StateSpace>()->getBounds()),
            from_(si),
            to_(si)
        {
            const auto *checker = dynamic_cast<const FclFootprintChecker *>(si->getStateValidityChecker().get());
            if (p_.obstacleHeuristic && checker != nullptr)
                ways_.emplace_back(checker->footprint(), bounds_, p_.xyResolution, poseOf(goal), ptc);
            add({poseOf(start), 0.0, NOBODY, 0, false});
        }

        /** The states of a path; empty without one or after the time limit. */
        std::vector<Pose> run()
        {
            for (unsigned expanded = 0; !open_.empty() && !ptc_;)
            {
                const std::uint32_t index = std::get<2>(open_.top());
                open_.pop();
                if (nodes_[index].closed)
                    continue;
                nodes_[index].closed = true;
                setPose(from_.get(), nodes_[index].pose);
                if (expanded++ % p_.expansionInterval == 0 && si_->checkMotion(from_.get(), goal_))
                    return pathTo(index);
                expand(index);
            }
            return {};
        }

    private:
        static constexpr std::uint32_t NOBODY = std::numeric_limits<std::uint32_t>::max();

        std::uint64_t keyOf(const Pose &pose) const
        {
            const auto cell = [](double value, double size)
            {
                return static_cast<std::uint64_t>(std::max(0.0, std::floor(value / size)));
            };
            const double turn = 2.0 * PI;
            const double bin = std::floor(std::fmod(wrapAngle(pose.yaw) + turn, turn) / turn * p_.headingBins + 0.5);
            return (cell(pose.x - bounds_.low[0], p_.xyResolution) << 36) ^
                   (cell(pose.y - bounds_.low[1], p_.xyResolution) << 12) ^
                   (static_cast<std::uint64_t>(bin) % p_.headingBins);
        }

        double heuristic(const Pose &pose)
        {
            setPose(to_.get(), pose);
            double metres = si_->distance(to_.get(), goal_);
            if (!ways_.empty())
                metres = std::max(metres, ways_.front().from(pose));
            return p_.heuristicWeight * metres;
        }

        void add(const Node &node)
        {
            const double ahead = heuristic(node.pose);
            if (!std::isfinite(ahead))
                return;
            const auto [known, isNew] = cells_.emplace(keyOf(node.pose), static_cast<std::uint32_t>(nodes_.size()));
            if (!isNew)
            {
                if (nodes_[known->second].cost <= node.cost)
                    return;
                nodes_[known->second].closed = true;  // replaced
                known->second = static_cast<std::uint32_t>(nodes_.size());
            }
            open_.emplace(node.cost + ahead, ahead, static_cast<std::uint32_t>(nodes_.size()));
            nodes_.push_back(node);
        }

        void expand(std::uint32_t index)
        {
            const Node node = nodes_[index];
            for (unsigned k = 0; k < p_.steeringAngles; ++k)
                for (const int direction : {1, -1})
                {
                    const double lock = -1.0 + 2.0 * k / (p_.steeringAngles - 1.0);
                    const Pose pose = advance(node.pose, lock * curvature_, direction * p_.motionLength);
                    Node next{
                        {pose.x, pose.y, wrapAngle(pose.yaw)}, node.cost + p_.motionLength, index, direction, false};
                    if (direction < 0)
                        next.cost += p_.reversePenalty * p_.motionLength;
                    if (direction * node.direction < 0)
                        next.cost += p_.gearChangePenalty;
                    next.cost += p_.steeringPenalty * std::abs(lock) * p_.motionLength;
                    const auto known = cells_.find(keyOf(next.pose));
                    if (known != cells_.end() && nodes_[known->second].cost <= next.cost)
                        continue;
                    setPose(from_.get(), node.pose);
                    setPose(to_.get(), next.pose);
                    if (si_->satisfiesBounds(to_.get()) && si_->checkMotion(from_.get(), to_.get()))
                        add(next);
                }
        }

        std::vector<Pose> pathTo(std::uint32_t index) const
        {
            std::vector<Pose> poses{poseOf(goal_)};
            for (; index != NOBODY; index = nodes_[index].parent)
                poses.push_back(nodes_[index].pose);
            std::reverse(poses.begin(), poses.end());
            return poses;
        }

        ob::SpaceInformationPtr si_;
        const Parameters &p_;
        const ob::State *goal_;
        const ob::PlannerTerminationCondition &ptc_;
        double curvature_;
        ob::RealVectorBounds bounds_;
        ob::ScopedState<> from_, to_;
        std::vector<DiscWays> ways_;  // one state, or none
        std::vector<Node> nodes_;
        std::unordered_map<std::uint64_t, std::uint32_t> cells_;
        /** Orders by f, then h, then age. */
        std::priority_queue<std::tuple<double, double, std::uint32_t>,
                            std::vector<std::tuple<double, double, std::uint32_t>>, std::greater<>>
            open_;
    };

    TextbookHybridAStar::TextbookHybridAStar(const ob::SpaceInformationPtr &si)
      : ob::Planner(si, "textbook_hybrid_astar")
    {
        specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
        specs_.directed = true;
        declareRanged(*this, "xy_resolution", parameters_.xyResolution, {0.01, 10.0}, "0.05:0.05:1.");
        declareRanged(*this, "heading_bins", parameters_.headingBins, {1.0, 4000.0}, "16:8:360");
        declareRanged(*this, "steering_angles", parameters_.steeringAngles, {2.0, 1000.0}, "3:2:11");
        declareRanged(*this, "motion_length", parameters_.motionLength, {0.01, 100.0}, "0.1:0.1:2.");
        declareRanged(*this, "reverse_penalty", parameters_.reversePenalty, {0.0, 1000.0}, "0.:0.5:5.");
        declareRanged(*this, "gear_change_penalty", parameters_.gearChangePenalty, {0.0, 1000.0}, "0.:0.5:10.");
        declareRanged(*this, "steering_penalty", parameters_.steeringPenalty, {0.0, 1000.0}, "0.:0.1:2.");
        declareRanged(*this, "expansion_interval", parameters_.expansionInterval, {1.0, 1e6}, "1:1:100");
        declareRanged(*this, "heuristic_weight", parameters_.heuristicWeight, {0.0, 1000.0}, "0.:0.1:5.");
        declareRanged(*this, "obstacle_heuristic", parameters_.obstacleHeuristic, {0.0, 1.0}, "0,1");
    }

    ob::PlannerStatus TextbookHybridAStar::solve(const ob::PlannerTerminationCondition &ptc)
    {
        checkValidity();
        if (CurveSpace(*si_->getStateSpace()).kind() != SpaceKind::ReedsShepp)
            throw ompl::Exception(getName(), "plans in a Reeds-Shepp space only");
        pis_.restart();
        const ob::State *start = pis_.nextStart();
        if (start == nullptr)
            return ob::PlannerStatus::INVALID_START;
        const ob::State *goal = pis_.nextGoal(ptc);
        if (goal == nullptr)
            return ob::PlannerStatus::INVALID_GOAL;
        const std::vector<Pose> poses = Search(si_, parameters_, start, goal, ptc).run();
        if (poses.empty())
            return ob::PlannerStatus::TIMEOUT;
        auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
        ob::ScopedState<> state(si_);
        for (const Pose &pose : poses)
        {
            setPose(state.get(), pose);
            path->append(state.get());
        }
        pdef_->addSolutionPath(path, false, 0.0, getName());
        return ob::PlannerStatus::EXACT_SOLUTION;
    }
}  // namespace parking
