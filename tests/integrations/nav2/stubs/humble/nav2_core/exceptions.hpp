#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2.

#include <stdexcept>

namespace nav2_core
{
    class PlannerException : public std::runtime_error
    {
    public:
        using std::runtime_error::runtime_error;
    };
}  // namespace nav2_core
