#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2. NAV2_<release>, which the
// test's target sets, chooses the signatures of that release.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tf2_ros/buffer.h>
#include <geometry_msgs/msg/pose_stamped.hpp>
#include <nav2_costmap_2d/costmap_2d_ros.hpp>
#include <nav_msgs/msg/path.hpp>
#ifdef NAV2_rolling
#include <nav2_ros_common/lifecycle_node.hpp>
#else
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#endif

namespace nav2_core
{
    class GlobalPlanner
    {
    public:
#ifdef NAV2_rolling
        using WeakNode = nav2::LifecycleNode::WeakPtr;
#else
        using WeakNode = rclcpp_lifecycle::LifecycleNode::WeakPtr;
#endif
        using PoseStamped = geometry_msgs::msg::PoseStamped;

        virtual ~GlobalPlanner() = default;
        virtual void configure(const WeakNode &parent, std::string name, std::shared_ptr<tf2_ros::Buffer> tf,
                               std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap) = 0;
        virtual void cleanup() = 0;
        virtual void activate() = 0;
        virtual void deactivate() = 0;
#if defined(NAV2_humble)
        virtual nav_msgs::msg::Path createPlan(const PoseStamped &start, const PoseStamped &goal) = 0;
#elif defined(NAV2_jazzy)
        virtual nav_msgs::msg::Path createPlan(const PoseStamped &start, const PoseStamped &goal,
                                               std::function<bool()> cancelled) = 0;
#elif defined(NAV2_rolling)
        virtual nav_msgs::msg::Path createPlan(const PoseStamped &start, const PoseStamped &goal,
                                               const std::vector<PoseStamped> &viaPoints,
                                               std::function<bool()> cancelled) = 0;
#else
#error "Define NAV2_humble, NAV2_jazzy or NAV2_rolling"
#endif
    };
}  // namespace nav2_core
