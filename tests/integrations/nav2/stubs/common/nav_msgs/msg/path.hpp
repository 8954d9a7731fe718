#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2.

#include <vector>

#include <geometry_msgs/msg/pose_stamped.hpp>

namespace nav_msgs::msg
{
    struct Path
    {
        std_msgs::msg::Header header;
        std::vector<geometry_msgs::msg::PoseStamped> poses;
    };
}  // namespace nav_msgs::msg
