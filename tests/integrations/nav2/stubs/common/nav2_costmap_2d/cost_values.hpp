#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2.

namespace nav2_costmap_2d
{
    static constexpr unsigned char NO_INFORMATION = 255;
    static constexpr unsigned char LETHAL_OBSTACLE = 254;
    static constexpr unsigned char INSCRIBED_INFLATED_OBSTACLE = 253;
    static constexpr unsigned char FREE_SPACE = 0;
}  // namespace nav2_costmap_2d
