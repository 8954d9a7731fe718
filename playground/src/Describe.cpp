#include "playground/src/Describe.h"

#include "ompl_improved_astar/search/planning/Parameters.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/text/Text.h"

#include <type_traits>
#include <variant>
#include <vector>

namespace parking::playground
{
    namespace
    {
        std::string quoted(const std::string &text)
        {
            std::string result = "\"";
            for (const char c : oneLine(text))
                result += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
            return result + "\"";
        }

        std::string row(const Parameter &parameter)
        {
            const PlannerParameters defaults;
            std::string text = "{\"name\":" + quoted(parameter.name);
            std::visit(
                [&](auto member)
                {
                    using Value = std::decay_t<decltype(defaults.*member)>;
                    const auto &value = defaults.*member;
                    if constexpr (std::is_same_v<Value, bool>)
                        text += std::string(",\"type\":\"flag\",\"value\":") + (value ? "true" : "false");
                    else if constexpr (std::is_same_v<Value, std::string>)
                    {
                        text += ",\"type\":\"name\",\"value\":" + quoted(value) + ",\"names\":[";
                        const std::vector<std::string> names = parameter.values.names();
                        for (std::size_t i = 0; i < names.size(); ++i)
                            text += (i > 0 ? "," : "") + quoted(names[i]);
                        text += "]";
                    }
                    else
                        text += std::string(",\"type\":\"") + (std::is_same_v<Value, double> ? "number" : "count") +
                                "\",\"value\":" + formatNumber(value) +
                                ",\"least\":" + formatNumber(parameter.values.min) +
                                ",\"most\":" + formatNumber(parameter.values.max) +
                                ",\"step\":" + formatNumber(parameter.values.step) +
                                ",\"zero\":" + (parameter.values.allowsZero ? "true" : "false");
                },
                parameter.member);
            return text + ",\"unit\":" + quoted(parameter.unit) + ",\"meaning\":" + quoted(parameter.meaning) + "}";
        }
    }  // namespace

    std::string parametersJson()
    {
        std::string text;
        for (const Parameter &parameter : parameterTable())
            text += (text.empty() ? "[" : ",") + row(parameter);
        return text + "]";
    }

    std::string vehiclesJson()
    {
        std::string text;
        for (const std::string &name : vehicleNames())
        {
            const Vehicle car = vehicleByName(name);
            text += (text.empty() ? "[" : ",") + ("{\"name\":" + quoted(name)) +
                    ",\"wheelbase\":" + formatNumber(car.wheelbase) +
                    ",\"front_overhang\":" + formatNumber(car.frontOverhang) +
                    ",\"rear_overhang\":" + formatNumber(car.rearOverhang) + ",\"width\":" + formatNumber(car.width) +
                    ",\"max_steering_angle\":" + formatNumber(car.maxSteeringAngle) +
                    ",\"max_speed\":" + formatNumber(car.maxSpeed) +
                    ",\"max_acceleration\":" + formatNumber(car.maxAcceleration) +
                    ",\"max_steering_rate\":" + formatNumber(car.maxSteeringRate) + "}";
        }
        return text + "]";
    }
}  // namespace parking::playground
