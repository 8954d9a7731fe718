// Costmap in, plan or exception out, through nav2's own interface; compiled once for each release of it.

#include "integrations/nav2/ImprovedAStarPlanner.h"

#include <gtest/gtest.h>

#include <cmath>

#include <nav2_costmap_2d/cost_values.hpp>

std::unique_ptr<nav2_core::GlobalPlanner> makePlugin();

namespace
{
    using namespace parking;
    namespace compatibility = nav2_compatibility;
    using geometry_msgs::msg::PoseStamped;

    constexpr double RESOLUTION = 0.1;  // metres

    PoseStamped stamped(double x, double y, double yaw, const std::string &frame = "map")
    {
        PoseStamped pose;
        pose.header.frame_id = frame;
        pose.pose.position.x = x;
        pose.pose.position.y = y;
        pose.pose.orientation.z = std::sin(0.5 * yaw);
        pose.pose.orientation.w = std::cos(0.5 * yaw);
        return pose;
    }

    double yawOf(const PoseStamped &pose)
    {
        return 2.0 * std::atan2(pose.pose.orientation.z, pose.pose.orientation.w);
    }

    double distance(const PoseStamped &a, const PoseStamped &b)
    {
        return std::hypot(a.pose.position.x - b.pose.position.x, a.pose.position.y - b.pose.position.y);
    }

    /** A hall of 30 m by 20 m whose origin is not that of the world. */
    class Nav2Planner : public testing::Test
    {
    protected:
        Nav2Planner()
        {
            planner->configure(node, "Parking", std::make_shared<tf2_ros::Buffer>(), ros);
            planner->activate();
        }

        void fill(double fromX, double fromY, double toX, double toY, unsigned char cost)
        {
            for (double x = fromX + 0.5 * RESOLUTION; x < toX; x += RESOLUTION)
                for (double y = fromY + 0.5 * RESOLUTION; y < toY; y += RESOLUTION)
                    costmap.setCost(static_cast<unsigned int>((x + 10.0) / RESOLUTION),
                                    static_cast<unsigned int>((y + 5.0) / RESOLUTION), cost);
        }

        void set(const std::string &name, const rclcpp::ParameterVariant &value)
        {
            ASSERT_TRUE(node->has_parameter("Parking." + name)) << name;
            node->parameters["Parking." + name] = value;
        }

        nav_msgs::msg::Path plan(const PoseStamped &from, const PoseStamped &to)
        {
#if defined NAV2_humble
            return planner->createPlan(from, to);
#elif defined NAV2_jazzy
            return planner->createPlan(from, to, cancelled);
#else
            return planner->createPlan(from, to, via, cancelled);
#endif
        }

        template <class Exception>
        void expectRefusal(const PoseStamped &from, const PoseStamped &to, const std::string &word)
        {
            try
            {
                plan(from, to);
                FAIL() << "there is a plan, but no '" << word << "'";
            }
            catch (const Exception &error)
            {
                EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
            }
            catch (const std::exception &error)
            {
                FAIL() << "another exception: " << error.what();
            }
        }

        nav2_costmap_2d::Costmap2D costmap{300, 200, RESOLUTION, -10.0, -5.0};
        std::shared_ptr<nav2_costmap_2d::Costmap2DROS> ros{std::make_shared<nav2_costmap_2d::Costmap2DROS>(costmap)};
        std::shared_ptr<compatibility::Node> node{std::make_shared<compatibility::Node>()};
        std::unique_ptr<nav2_core::GlobalPlanner> planner{makePlugin()};
        std::function<bool()> cancelled{[]
                                        {
                                            return false;
                                        }};
        std::vector<PoseStamped> via;
        const PoseStamped start{stamped(-5.0, 0.0, 0.0)}, goal{stamped(12.0, 8.0, 1.5)};
    };

    TEST_F(Nav2Planner, APlanBeginsAndEndsAsAskedAndHasNoGaps)
    {
        fill(2.0, -5.0, 3.0, 6.0, nav2_costmap_2d::LETHAL_OBSTACLE);
        const nav_msgs::msg::Path path = plan(start, goal);
        ASSERT_GT(path.poses.size(), 300U) << "5 cm from pose to pose";
        EXPECT_EQ(path.header.frame_id, "map");
        EXPECT_EQ(path.header.stamp.sec, 42);
        EXPECT_LT(distance(path.poses.front(), start), 1e-9);
        EXPECT_LT(distance(path.poses.back(), goal), 1e-6);
        EXPECT_NEAR(yawOf(path.poses.back()), 1.5, 1e-6);
        for (std::size_t i = 1; i < path.poses.size(); ++i)
            ASSERT_LT(distance(path.poses[i - 1], path.poses[i]), 0.0501);
        for (const PoseStamped &pose : path.poses)
            ASSERT_FALSE(pose.pose.position.x > 2.0 && pose.pose.position.x < 3.0 && pose.pose.position.y < 6.9)
                << "half of the car's width from the wall at least";
    }

    TEST_F(Nav2Planner, InflationIsNoObstacleAndUnknownCellsAreUnlessToldOtherwise)
    {
        fill(2.0, -5.0, 3.0, 15.0, nav2_costmap_2d::INSCRIBED_INFLATED_OBSTACLE);
        EXPECT_FALSE(plan(start, goal).poses.empty());
        fill(2.0, -5.0, 3.0, 15.0, nav2_costmap_2d::NO_INFORMATION);
        expectRefusal<compatibility::NoValidPathCouldBeFound>(start, goal, "");
        set("unknown_is_occupied", false);
        EXPECT_FALSE(plan(start, goal).poses.empty());
        fill(2.0, -5.0, 3.0, 15.0, nav2_costmap_2d::INSCRIBED_INFLATED_OBSTACLE);
        set("lethal_cost", std::int64_t(253));
        expectRefusal<compatibility::NoValidPathCouldBeFound>(start, goal, "");
    }

    TEST_F(Nav2Planner, WhatIsWrongIsSaidByNav2sOwnExceptions)
    {
        fill(2.0, -5.0, 3.0, 15.0, nav2_costmap_2d::LETHAL_OBSTACLE);
        expectRefusal<compatibility::StartOccupied>(stamped(2.0, 0.0, 0.0), goal, "at its start (2, 0, 0)");
        expectRefusal<compatibility::GoalOccupied>(start, stamped(1.0, 0.0, 0.0), "at the goal (1, 0, 0)");
        expectRefusal<compatibility::StartOutsideMapBounds>(stamped(-10.1, 0.0, 0.0), goal, "not on the map");
        expectRefusal<compatibility::GoalOutsideMapBounds>(start, stamped(0.0, 15.1, 0.0), "not on the map");
        expectRefusal<compatibility::PlannerTFError>(stamped(-5.0, 0.0, 0.0, "odom"), goal, "'odom'");
        expectRefusal<compatibility::NoValidPathCouldBeFound>(start, goal, "");
    }

    TEST_F(Nav2Planner, ParametersOfTheCarAndTheSearchCount)
    {
        const std::size_t poses = plan(start, goal).poses.size();
        set("path_resolution", 0.5);
        EXPECT_LT(plan(start, goal).poses.size(), poses / 5);
        set("path_resolution", 0.05);
        // A gap of 2 m, too narrow for this car with its margin and wide enough for a slim one.
        fill(2.0, -5.0, 3.0, 4.0, nav2_costmap_2d::LETHAL_OBSTACLE);
        fill(2.0, 6.0, 3.0, 15.0, nav2_costmap_2d::LETHAL_OBSTACLE);
        expectRefusal<compatibility::PlannerException>(start, goal, "");
        set("width", 1.6);
        EXPECT_FALSE(plan(start, goal).poses.empty());
        set("heuristic_weight_far", 11.0);
        expectRefusal<compatibility::PlannerException>(start, goal, "heuristic_weight_far");
        set("heuristic_weight_far", 2.5);
        set("heading_bins", std::int64_t(-3));
        expectRefusal<compatibility::PlannerException>(start, goal, "heading_bins");
        set("heading_bins", std::int64_t(72));
        set("margin", -1.0);
        expectRefusal<compatibility::PlannerException>(start, goal, "margin must be between 0 and 10");
    }

    TEST_F(Nav2Planner, TheFootprintOfTheCostmapCanBeTheBody)
    {
        // The gap of the test above: too narrow for the car, wide enough for a slim polygon.
        fill(2.0, -5.0, 3.0, 4.0, nav2_costmap_2d::LETHAL_OBSTACLE);
        fill(2.0, 6.0, 3.0, 15.0, nav2_costmap_2d::LETHAL_OBSTACLE);
        set("use_robot_footprint", true);
        expectRefusal<compatibility::PlannerException>(start, goal, "the costmap has no footprint");
        for (const auto &[x, y] : {std::pair(-0.9, 0.0), {0.0, -0.8}, {3.5, -0.6}, {3.7, 0.0}, {3.5, 0.6}, {0.0, 0.8}})
        {
            geometry_msgs::msg::Point corner;
            corner.x = x;
            corner.y = y;
            ros->footprint.push_back(corner);
        }
        EXPECT_FALSE(plan(start, goal).poses.empty());
        ros->footprint.pop_back();
        ros->footprint.back() = ros->footprint.front();
        expectRefusal<compatibility::PlannerException>(start, goal, "outline");
    }

    TEST_F(Nav2Planner, AWrongParameterIsRefusedAtOnce)
    {
        node->parameters["Other.motion_model"] = std::string("boat");
        const auto other = makePlugin();
        EXPECT_THROW(other->configure(node, "Other", std::make_shared<tf2_ros::Buffer>(),
                                      std::make_shared<nav2_costmap_2d::Costmap2DROS>(costmap)),
                     std::exception);
    }

    TEST_F(Nav2Planner, ARemovedParameterIsRefusedAtOnce)
    {
        auto &overrides = node->get_node_parameters_interface()->overrides;
        const auto configure = [&]
        {
            makePlugin()->configure(node, "Other", std::make_shared<tf2_ros::Buffer>(),
                                    std::make_shared<nav2_costmap_2d::Costmap2DROS>(costmap));
        };
        overrides.emplace("Another.look_ahead", true);
        EXPECT_NO_THROW(configure());
        overrides.emplace("Other.look_ahead", true);
        EXPECT_THROW(configure(), std::exception);
    }

    TEST_F(Nav2Planner, NothingIsPlannedAfterTheEnd)
    {
        planner->deactivate();
        planner->cleanup();
        expectRefusal<compatibility::PlannerException>(start, goal, "not configured");
    }

    TEST_F(Nav2Planner, TheHeadingModeDeterminesTheHeadingsOfTheGoal)
    {
        // A dead end, 2.6 m wide: driving in forwards is the shortest route, and the goal's heading requires reversing.
        fill(6.0, 3.7, 14.0, 5.0, nav2_costmap_2d::LETHAL_OBSTACLE);
        fill(6.0, 7.6, 14.0, 9.0, nav2_costmap_2d::LETHAL_OBSTACLE);
        fill(13.5, 5.0, 14.0, 7.6, nav2_costmap_2d::LETHAL_OBSTACLE);
        const PoseStamped from = stamped(-5.0, 6.3, 0.0), inReverse = stamped(9.5, 6.3, M_PI);
        EXPECT_NEAR(std::abs(yawOf(plan(from, inReverse).poses.back())), M_PI, 1e-6);
        for (const char *mode : {"BIDIRECTIONAL", "ALL_DIRECTION"})
        {
            set("goal_heading_mode", std::string(mode));
            const PoseStamped end = plan(from, inReverse).poses.back();
            EXPECT_LT(distance(end, inReverse), 1e-6) << mode;
            EXPECT_NEAR(std::remainder(yawOf(end), 2.0 * M_PI), 0.0, 1e-6) << mode;
        }
        set("coarse_search_resolution", std::int64_t(7));
        expectRefusal<compatibility::PlannerException>(from, inReverse, "coarse_search_resolution must divide");
        set("coarse_search_resolution", std::int64_t(1));
        set("goal_heading_mode", std::string("ANY"));
        expectRefusal<compatibility::PlannerException>(from, inReverse, "'ANY'");
    }

    TEST_F(Nav2Planner, AGoalOutOfReachIsReplacedByAPoseWithinTheTolerances)
    {
        // From rear axle to nose the car measures 3.76 m, with the margin 3.81 m; the wall begins 3.65 m ahead.
        fill(12.0, -5.0, 13.0, 15.0, nav2_costmap_2d::LETHAL_OBSTACLE);
        const PoseStamped blocked = stamped(8.35, 3.0, 0.0);
        expectRefusal<compatibility::GoalOccupied>(start, blocked, "at the goal");
        set("tolerance", 0.1);
        expectRefusal<compatibility::GoalOccupied>(start, blocked, "at the goal");
        set("tolerance", 0.4);
        const PoseStamped end = plan(start, blocked).poses.back();
        EXPECT_GT(distance(end, blocked), 0.1);
        EXPECT_LE(distance(end, blocked), 0.4 + 1e-6);
        EXPECT_NEAR(yawOf(end), 0.0, 1e-6);
        const PoseStamped free = stamped(6.0, 3.0, 0.0);
        EXPECT_LT(distance(plan(start, free).poses.back(), free), 1e-6) << "the goal itself has precedence";
        set("heading_tolerance", -0.1);
        expectRefusal<compatibility::PlannerException>(start, blocked, "heading_tolerance must be between");
    }

    TEST_F(Nav2Planner, AGoalBesideAWallIsReachedAtAnotherHeadingWithinTheTolerance)
    {
        fill(-10.0, 7.0, 20.0, 8.0, nav2_costmap_2d::LETHAL_OBSTACLE);
        const PoseStamped turned = stamped(6.0, 5.9, 0.1);
        expectRefusal<compatibility::GoalOccupied>(start, turned, "at the goal");
        set("heading_tolerance", 0.2);
        const PoseStamped end = plan(start, turned).poses.back();
        EXPECT_LT(distance(end, turned), 1e-6);
        EXPECT_NEAR(yawOf(end), 0.1, 0.2 + 1e-6);
        EXPECT_LT(yawOf(end), 0.05);
    }

#ifndef NAV2_humble
    TEST_F(Nav2Planner, CancellingEndsPlanning)
    {
        cancelled = []
        {
            return true;
        };
        expectRefusal<nav2_core::PlannerCancelled>(start, goal, "cancelled");
        cancelled = nullptr;
        EXPECT_FALSE(plan(start, goal).poses.empty());
    }
#endif

#ifdef NAV2_rolling
    TEST_F(Nav2Planner, ViaPointsAreReachedInTheirOrder)
    {
        via = {stamped(3.0, 10.0, 0.5), stamped(8.0, -2.0, -0.5)};
        const nav_msgs::msg::Path path = plan(start, goal);
        std::size_t next = 0;
        for (const PoseStamped &pose : path.poses)
            if (next < via.size() && distance(pose, via[next]) < 0.05 &&
                std::abs(yawOf(pose) - yawOf(via[next])) < 0.05)
                ++next;
        EXPECT_EQ(next, via.size());
        EXPECT_LT(distance(path.poses.back(), goal), 1e-6);
        via.push_back(stamped(40.0, 0.0, 0.0));
        expectRefusal<nav2_core::GoalOutsideMapBounds>(start, goal, "(40, 0, 0)");
    }
#endif
}  // namespace
