#include "integrations/nav2/ImprovedAStarPlanner.h"

#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <mutex>
#include <utility>

#include <nav2_costmap_2d/cost_values.hpp>
#include <pluginlib/class_list_macros.hpp>

namespace parking
{
    namespace compatibility = nav2_compatibility;
    using Clock = std::chrono::steady_clock;

    namespace
    {
        constexpr double TOLERANCE = 1e-3;  // metres kept from obstacles along motions

        std::string textOf(const Pose &pose)
        {
            return "(" + formatNumber(pose.x) + ", " + formatNumber(pose.y) + ", " + formatNumber(pose.yaw) + ")";
        }

        Box boundsOf(const OccupancyGrid &grid)
        {
            const Pose &origin = grid.origin();
            return {{origin.x, origin.y},
                    {origin.x + static_cast<double>(grid.width()) * grid.resolution(),
                     origin.y + static_cast<double>(grid.height()) * grid.resolution()}};
        }

        bool isWithin(const Box &box, const Pose &pose)
        {
            return pose.x >= box.min.x() && pose.x <= box.max.x() && pose.y >= box.min.y() && pose.y <= box.max.y();
        }
    }  // namespace

    struct ImprovedAStarPlanner::Query
    {
        const Nav2Settings &settings;
        const FootprintChecker &checker;
        Box bounds;
        Clock::time_point end;
        const std::function<bool()> &cancelled;
    };

    void ImprovedAStarPlanner::configure(const compatibility::Node::WeakPtr &parent, std::string name,
                                         std::shared_ptr<tf2_ros::Buffer> /*tf*/,
                                         std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap)
    {
        const auto node = parent.lock();
        if (!node)
            throw compatibility::PlannerException("the node of the planner is gone");
        node_ = parent;
        name_ = std::move(name);
        costmap_ = std::move(costmap);
        declareSettings(*node, name_);
        readSettings(*node, name_);
    }

    void ImprovedAStarPlanner::cleanup()
    {
        costmap_.reset();
    }

    void ImprovedAStarPlanner::activate()
    {
    }

    void ImprovedAStarPlanner::deactivate()
    {
    }

    nav_msgs::msg::Path ImprovedAStarPlanner::createPlan(const PoseStamped &start, const PoseStamped &goal)
    {
        return createPlan(start, goal, {}, [] { return false; });
    }

    nav_msgs::msg::Path ImprovedAStarPlanner::createPlan(const PoseStamped &start, const PoseStamped &goal,
                                                         std::function<bool()> cancelled)
    {
        return createPlan(start, goal, {}, std::move(cancelled));
    }

    nav_msgs::msg::Path ImprovedAStarPlanner::createPlan(const PoseStamped &start, const PoseStamped &goal,
                                                         const std::vector<PoseStamped> &viaPoints,
                                                         std::function<bool()> cancelled)
    {
        const auto node = node_.lock();
        if (!node || !costmap_)
            throw compatibility::PlannerException("the planner is not configured");
        std::vector<Pose> stops{poseOf(start)};
        for (const PoseStamped &each : viaPoints)
            stops.push_back(poseOf(each));
        stops.push_back(poseOf(goal));

        Path path;
        Nav2Settings settings;
        try
        {
            settings = readSettings(*node, name_);
            if (settings.usesRobotFootprint)
                setFootprint(settings.vehicle);
            const OccupancyGrid grid = copyOfCostmap(settings);
            const Box bounds = boundsOf(grid);
            if (!isWithin(bounds, stops.front()))
                throw compatibility::StartOutsideMapBounds("the start " + textOf(stops.front()) + " is not on the map");
            for (std::size_t i = 1; i < stops.size(); ++i)
                if (!isWithin(bounds, stops[i]))
                    throw compatibility::GoalOutsideMapBounds("the goal " + textOf(stops[i]) + " is not on the map");
            const FootprintChecker checker(ObstacleSet::fromGrid(grid, settings.unknownIsOccupied), settings.vehicle,
                                           settings.margin);
            const auto time = std::chrono::duration<double>(settings.maxPlanningTime);
            const Query query{settings, checker, bounds,
                              Clock::now() + std::chrono::duration_cast<Clock::duration>(time), cancelled};
            path.start = stops.front();
            for (std::size_t i = 1; i < stops.size(); ++i)
                path.extend(planLeg(query, stops[i - 1], stops[i], i + 1 == stops.size()));
        }
        catch (const Error &error)
        {
            throw compatibility::PlannerException(error.what());
        }

        nav_msgs::msg::Path plan;
        plan.header.frame_id = costmap_->getGlobalFrameID();
        plan.header.stamp = node->now();
        for (const PathState &state : path.sample(settings.pathResolution))
        {
            PoseStamped stamped;
            stamped.header = plan.header;
            stamped.pose.position.x = state.pose.x;
            stamped.pose.position.y = state.pose.y;
            stamped.pose.orientation.z = std::sin(0.5 * state.pose.yaw);
            stamped.pose.orientation.w = std::cos(0.5 * state.pose.yaw);
            plan.poses.push_back(stamped);
        }
        return plan;
    }

    void ImprovedAStarPlanner::setFootprint(Vehicle &vehicle) const
    {
        Polygon outline;
        for (const auto &corner : costmap_->getRobotFootprint())
            outline.emplace_back(corner.x, corner.y);
        if (outline.empty())
            throw Error("use_robot_footprint is true, but the costmap has no footprint");
        vehicle.setOutline(outline);
        vehicle.validate();
    }

    OccupancyGrid ImprovedAStarPlanner::copyOfCostmap(const Nav2Settings &settings) const
    {
        nav2_costmap_2d::Costmap2D &costmap = *costmap_->getCostmap();
        // Layers write to it again when the lock is released.
        const std::lock_guard<nav2_costmap_2d::Costmap2D::mutex_t> lock(*costmap.getMutex());
        const std::size_t width = costmap.getSizeInCellsX(), height = costmap.getSizeInCellsY();
        OccupancyGrid grid(width, height, costmap.getResolution(), {costmap.getOriginX(), costmap.getOriginY(), 0.0});
        const unsigned char *costs = costmap.getCharMap();
        for (std::size_t row = 0; row < height; ++row)
            for (std::size_t column = 0; column < width; ++column)
            {
                const unsigned char cost = costs[row * width + column];
                if (cost == nav2_costmap_2d::NO_INFORMATION)
                    grid.set(column, row, Cell::Unknown);
                else if (cost >= settings.lethalCost)
                    grid.set(column, row, Cell::Occupied);
            }
        return grid;
    }

    Path ImprovedAStarPlanner::planLeg(const Query &query, const Pose &from, const Pose &to, bool isLast) const
    {
        if (!query.checker.isFree(from))
            throw compatibility::StartOccupied("the car touches an obstacle at its start " + textOf(from));
        const GoalSettings goal = isLast ? query.settings.goal : GoalSettings{};
        const unsigned int headingBins = query.settings.parameters.headingBins;
        std::vector<std::vector<Pose>> attempts;
        for (const std::vector<Pose> &poses : {goalPoses(to, goal, headingBins), posesNearGoal(to, goal, headingBins)})
        {
            std::vector<Pose> free;
            std::copy_if(poses.begin(), poses.end(), std::back_inserter(free),
                         [&](const Pose &pose) { return isWithin(query.bounds, pose) && query.checker.isFree(pose); });
            if (!free.empty())
                attempts.push_back(std::move(free));
        }
        if (attempts.empty())
            throw compatibility::GoalOccupied("the car would touch an obstacle at the goal " + textOf(to));
        std::string reason{"there is no path"};
        bool timedOut = false;
        for (std::size_t i = 0; i < attempts.size(); ++i)
        {
            const bool isLastAttempt = i + 1 == attempts.size();
            const Clock::time_point now = Clock::now();
            const auto share = (query.end - now) / static_cast<Clock::rep>(attempts.size() - i);
            const bool approximate = query.settings.allowApproximate && isLast && isLastAttempt;
            search::PlanResult result = planAttempt(query, from, attempts[i], approximate, now + share);
            if (result.outcome == search::PlanOutcome::Solved || result.outcome == search::PlanOutcome::Approximate)
                return std::move(result.path);
            timedOut = timedOut || result.outcome == search::PlanOutcome::Timeout;
            if (!result.reason.empty())
                reason = result.reason;
        }
        if (timedOut)
            throw compatibility::PlannerTimedOut("no path was found within " +
                                                 formatNumber(query.settings.maxPlanningTime) + " s");
        throw compatibility::NoValidPathCouldBeFound(reason);
    }

    search::PlanResult ImprovedAStarPlanner::planAttempt(const Query &query, const Pose &from,
                                                         const std::vector<Pose> &goals, bool approximate,
                                                         Clock::time_point end) const
    {
        search::PlanRequest request;
        request.starts = {from};
        request.goals = goals;
        request.parameters = query.settings.parameters;
        request.parameters.approximate = approximate;
        request.car = search::carInSpace(query.settings.vehicle, query.settings.margin, query.bounds);
        // Polled once here, since a search without expansions does not poll.
        bool cancelled = query.cancelled && query.cancelled();
        request.stop = [&]
        {
            cancelled = cancelled || (query.cancelled && query.cancelled());
            return cancelled || Clock::now() >= end;
        };
        search::PlanResult result;
        if (!cancelled)
        {
            FootprintEnvironment environment(query.checker, query.bounds, TOLERANCE);
            result = search::plan(environment, request);
        }
        if (cancelled)
            throw compatibility::PlannerCancelled("planning was cancelled");
        return result;
    }

    Pose ImprovedAStarPlanner::poseOf(const PoseStamped &stamped) const
    {
        const std::string frame = costmap_->getGlobalFrameID();
        if (stamped.header.frame_id != frame)
            throw compatibility::PlannerTFError("a pose is in the frame '" + stamped.header.frame_id +
                                                "', the costmap in '" + frame + "'");
        const auto &turn = stamped.pose.orientation;
        return {stamped.pose.position.x, stamped.pose.position.y,
                std::atan2(2.0 * (turn.w * turn.z + turn.x * turn.y), 1.0 - 2.0 * (turn.y * turn.y + turn.z * turn.z))};
    }
}  // namespace parking

PLUGINLIB_EXPORT_CLASS(parking::ImprovedAStarPlanner, nav2_core::GlobalPlanner)
