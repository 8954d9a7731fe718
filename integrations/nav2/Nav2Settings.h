#pragma once

#include "integrations/nav2/GoalPoses.h"
#include "integrations/nav2/Nav2Compatibility.h"
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "parking_geometry/Vehicle.h"

#include <string>

namespace parking
{
    /** \brief Parameters of the plugin: ROS parameters below its name. */
    struct Nav2Settings
    {
        Vehicle vehicle;  ///< from `wheelbase`, `front_overhang`, `rear_overhang`, `width`, `max_steering_angle`
        /** `use_robot_footprint`: whether the polygon of the costmap's footprint is the body, instead of the rectangle.
            The origin of the robot's frame must then be the middle of the rear axle. */
        bool usesRobotFootprint{false};
        PlannerParameters parameters;  ///< by the names of parameterTable(); `turning_radius` is the vehicle's
        GoalSettings goal;             ///< poses that a plan may end at
        double margin{0.05};           ///< `margin`: metres by which the body is enlarged on each side
        int lethalCost{254};           ///< `lethal_cost`: minimum cost of an obstacle's cells
        bool unknownIsOccupied{true};  ///< `unknown_is_occupied`: whether unknown cells are obstacles
        double maxPlanningTime{2.0};   ///< `max_planning_time` in seconds
        double pathResolution{0.05};   ///< `path_resolution`: metres between two poses of the plan
        bool allowApproximate{false};  ///< `allow_approximate`: whether a plan may end near the goal
    };

    /** \brief Declares all parameters of the plugin \e name, with their defaults. */
    void declareSettings(nav2_compatibility::Node &node, const std::string &name);

    /** \brief The current values of the parameters. Throws parking::Error naming one that is out of range. */
    Nav2Settings readSettings(nav2_compatibility::Node &node, const std::string &name);
}  // namespace parking
