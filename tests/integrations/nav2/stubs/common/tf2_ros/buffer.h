#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2.

namespace tf2_ros
{
    class Buffer
    {
    };
}  // namespace tf2_ros
