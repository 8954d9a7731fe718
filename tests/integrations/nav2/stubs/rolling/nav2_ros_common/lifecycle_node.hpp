#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2.

#include <memory>

#include <rclcpp_lifecycle/lifecycle_node.hpp>

namespace nav2
{
    class LifecycleNode : public rclcpp_lifecycle::LifecycleNode
    {
    public:
        using SharedPtr = std::shared_ptr<LifecycleNode>;
        using WeakPtr = std::weak_ptr<LifecycleNode>;
    };
}  // namespace nav2
