#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2.

#include <memory>

/** Makes sure, like the real one, that the class can be made and is what it is said to be. */
#define PLUGINLIB_EXPORT_CLASS(Class, Base) \
    std::unique_ptr<Base> makePlugin();     \
    std::unique_ptr<Base> makePlugin()      \
    {                                       \
        return std::make_unique<Class>();   \
    }
