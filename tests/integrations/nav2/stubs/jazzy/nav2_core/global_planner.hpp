#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tf2_ros/buffer.h>
#include <geometry_msgs/msg/pose_stamped.hpp>
#include <nav2_costmap_2d/costmap_2d_ros.hpp>
#include <nav_msgs/msg/path.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>

namespace nav2_core
{
    class GlobalPlanner
    {
    public:
        virtual ~GlobalPlanner() = default;
        virtual void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr &parent, std::string name,
                               std::shared_ptr<tf2_ros::Buffer> tf,
                               std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap) = 0;
        virtual void cleanup() = 0;
        virtual void activate() = 0;
        virtual void deactivate() = 0;
        virtual nav_msgs::msg::Path createPlan(const geometry_msgs::msg::PoseStamped &start,
                                               const geometry_msgs::msg::PoseStamped &goal,
                                               std::function<bool()> cancelled) = 0;
    };
}  // namespace nav2_core
