#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2.

#include <cstdint>
#include <string>

namespace builtin_interfaces::msg
{
    struct Time
    {
        std::int32_t sec{0};
        std::uint32_t nanosec{0};
    };
}  // namespace builtin_interfaces::msg

namespace std_msgs::msg
{
    struct Header
    {
        builtin_interfaces::msg::Time stamp;
        std::string frame_id;
    };
}  // namespace std_msgs::msg

namespace geometry_msgs::msg
{
    struct Point
    {
        double x{0.0}, y{0.0}, z{0.0};
    };

    struct Quaternion
    {
        double x{0.0}, y{0.0}, z{0.0}, w{1.0};
    };

    struct Pose
    {
        Point position;
        Quaternion orientation;
    };

    struct PoseStamped
    {
        std_msgs::msg::Header header;
        Pose pose;
    };
}  // namespace geometry_msgs::msg
