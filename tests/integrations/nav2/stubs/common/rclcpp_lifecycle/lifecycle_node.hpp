#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2.

#include <memory>
#include <utility>

#include <geometry_msgs/msg/pose_stamped.hpp>
#include <rclcpp/rclcpp.hpp>

namespace rclcpp_lifecycle
{
    class LifecycleNode
    {
    public:
        using SharedPtr = std::shared_ptr<LifecycleNode>;
        using WeakPtr = std::weak_ptr<LifecycleNode>;

        bool has_parameter(const std::string &name) const
        {
            return parameters.count(name) > 0;
        }

        void declare_parameter(const std::string &name, const rclcpp::ParameterValue &value)
        {
            if (!parameters.emplace(name, value.variant()).second)
                throw std::runtime_error(name + " is declared twice");
        }

        rclcpp::Parameter get_parameter(const std::string &name) const
        {
            return rclcpp::Parameter(parameters.at(name));
        }

        rclcpp::node_interfaces::NodeParametersInterface::SharedPtr get_node_parameters_interface() const
        {
            return parametersInterface;
        }

        builtin_interfaces::msg::Time now() const
        {
            return {42, 7U};
        }

        std::map<std::string, rclcpp::ParameterVariant> parameters;
        rclcpp::node_interfaces::NodeParametersInterface::SharedPtr parametersInterface{
            std::make_shared<rclcpp::node_interfaces::NodeParametersInterface>()};
    };
}  // namespace rclcpp_lifecycle
