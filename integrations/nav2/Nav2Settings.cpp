#include "integrations/nav2/Nav2Settings.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <cstdint>
#include <type_traits>
#include <variant>

namespace parking
{
    namespace
    {
        using nav2_compatibility::Node;

        /** A value in a type of ROS parameters; whole numbers have 64 bits there. */
        template <class Value>
        using RosValue = std::conditional_t<std::is_integral_v<Value> && !std::is_same_v<Value, bool>, std::int64_t,
                                            std::conditional_t<std::is_floating_point_v<Value>, double, Value>>;

        /** Calls \e visit with the name and the member of every setting. */
        template <class Visitor>
        void forEachSetting(Nav2Settings &settings, const Visitor &visit)
        {
            visit("wheelbase", settings.vehicle.wheelbase);
            visit("front_overhang", settings.vehicle.frontOverhang);
            visit("rear_overhang", settings.vehicle.rearOverhang);
            visit("width", settings.vehicle.width);
            visit("max_steering_angle", settings.vehicle.maxSteeringAngle);
            visit("use_robot_footprint", settings.usesRobotFootprint);
            visit("margin", settings.margin);
            visit("lethal_cost", settings.lethalCost);
            visit("unknown_is_occupied", settings.unknownIsOccupied);
            visit("max_planning_time", settings.maxPlanningTime);
            visit("path_resolution", settings.pathResolution);
            visit("goal_heading_mode", settings.goal.headingMode);
            visit("coarse_search_resolution", settings.goal.coarseSearchResolution);
            visit("tolerance", settings.goal.tolerance);
            visit("heading_tolerance", settings.goal.headingTolerance);
            visit("allow_approximate", settings.allowApproximate);
            for (const Parameter &row : parameterTable())
                if (row.name != "turning_radius" &&
                    row.name != "parameter_set")  // unused: the vehicle's radius applies
                    std::visit([&](auto member) { visit(row.name, settings.parameters.*member); }, row.member);
        }

        void checkRange(const char *name, double value, double min, double max)
        {
            if (!(value >= min && value <= max))
                throw Error(std::string(name) + " must be between " + formatNumber(min) + " and " + formatNumber(max) +
                            ", not " + formatNumber(value));
        }
    }  // namespace

    void declareSettings(Node &node, const std::string &name)
    {
        const std::string prefix = name + ".";
        for (const auto &[given, value] : node.get_node_parameters_interface()->get_parameter_overrides())
            if (given.rfind(prefix, 0) == 0)
                checkNotRemoved(given.substr(prefix.size()));
        Nav2Settings defaults;
        forEachSetting(defaults,
                       [&](const std::string &setting, auto &value)
                       {
                           using Value = std::decay_t<decltype(value)>;
                           if (!node.has_parameter(name + "." + setting))
                               node.declare_parameter(name + "." + setting,
                                                      rclcpp::ParameterValue(RosValue<Value>(value)));
                       });
    }

    Nav2Settings readSettings(Node &node, const std::string &name)
    {
        Nav2Settings settings;
        forEachSetting(settings,
                       [&](const std::string &setting, auto &value)
                       {
                           using Value = std::decay_t<decltype(value)>;
                           const rclcpp::Parameter parameter = node.get_parameter(name + "." + setting);
                           const auto found = parameter.get_value<RosValue<Value>>();
                           if constexpr (std::is_unsigned_v<Value> && !std::is_same_v<Value, bool>)
                               if (found < 0)
                                   throw Error(setting + " must not be negative");
                           value = static_cast<Value>(found);
                       });
        settings.vehicle.validate();
        checkParameters(settings.parameters);
        checkGoalSettings(settings.goal, settings.parameters.headingBins);
        checkRange("margin", settings.margin, 0.0, 10.0);
        checkRange("lethal_cost", settings.lethalCost, 1.0, 254.0);
        checkRange("max_planning_time", settings.maxPlanningTime, 1e-3, 3600.0);
        checkRange("path_resolution", settings.pathResolution, 1e-3, 10.0);
        return settings;
    }
}  // namespace parking
