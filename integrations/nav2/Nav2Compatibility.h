#pragma once

#include <geometry_msgs/msg/pose_stamped.hpp>
#include <nav2_core/global_planner.hpp>
#include <nav2_costmap_2d/costmap_2d_ros.hpp>
#include <nav_msgs/msg/path.hpp>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#if __has_include(<nav2_ros_common/lifecycle_node.hpp>)
#include <nav2_ros_common/lifecycle_node.hpp>
#endif
#if __has_include(<nav2_core/planner_exceptions.hpp>)
#include <nav2_core/planner_exceptions.hpp>
#else
#include <nav2_core/exceptions.hpp>
#endif

/** \brief Differences between the releases of nav2 that affect the planner. */
namespace parking::nav2_compatibility
{
#if __has_include(<nav2_ros_common/lifecycle_node.hpp>)
    using Node = nav2::LifecycleNode;  // after jazzy
#else
    using Node = rclcpp_lifecycle::LifecycleNode;  ///< up to jazzy
#endif

#if __has_include(<nav2_core/planner_exceptions.hpp>)
    using nav2_core::GoalOccupied;
    using nav2_core::GoalOutsideMapBounds;
    using nav2_core::NoValidPathCouldBeFound;
    using nav2_core::PlannerCancelled;
    using nav2_core::PlannerException;
    using nav2_core::PlannerTFError;
    using nav2_core::PlannerTimedOut;
    using nav2_core::StartOccupied;
    using nav2_core::StartOutsideMapBounds;
#else
    // Humble has one exception for all failures; only the text differs.
    using nav2_core::PlannerException;
    using GoalOccupied = PlannerException;             ///< humble's only exception
    using GoalOutsideMapBounds = PlannerException;     ///< Humble's only exception
    using NoValidPathCouldBeFound = PlannerException;  ///< Humble's only exception
    using PlannerCancelled = PlannerException;         ///< Humble's only exception
    using PlannerTFError = PlannerException;           ///< Humble's only exception
    using PlannerTimedOut = PlannerException;          ///< Humble's only exception
    using StartOccupied = PlannerException;            ///< Humble's only exception
    using StartOutsideMapBounds = PlannerException;    ///< Humble's only exception
#endif
}  // namespace parking::nav2_compatibility
