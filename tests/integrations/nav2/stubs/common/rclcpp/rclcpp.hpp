#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2.

#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>

namespace rclcpp
{
    using ParameterVariant = std::variant<bool, std::int64_t, double, std::string>;

    class ParameterValue
    {
    public:
        template <class Value>
        explicit ParameterValue(const Value &value) : value_(value)
        {
        }

        const ParameterVariant &variant() const
        {
            return value_;
        }

    private:
        ParameterVariant value_;
    };

    class Parameter
    {
    public:
        explicit Parameter(ParameterVariant value) : value_(std::move(value))
        {
        }

        template <class Value>
        Value get_value() const
        {
            return std::get<Value>(value_);
        }

    private:
        ParameterVariant value_;
    };

    namespace node_interfaces
    {
        class NodeParametersInterface
        {
        public:
            using SharedPtr = std::shared_ptr<NodeParametersInterface>;

            const std::map<std::string, ParameterValue> &get_parameter_overrides() const
            {
                return overrides;
            }

            std::map<std::string, ParameterValue> overrides;
        };
    }  // namespace node_interfaces
}  // namespace rclcpp
