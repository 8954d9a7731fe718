#include "benchmarks/formats/ResultFormat.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <nlohmann/json.hpp>

#include <cctype>
#include <cmath>
#include <fstream>

namespace parking
{
    namespace
    {
        constexpr std::size_t LARGEST = std::size_t(256) << 20;  // bytes
        constexpr double NO_LENGTH = 1e-9;                       // metres

        double finite(const nlohmann::json &object, const char *member)
        {
            const double value = object.at(member).get<double>();
            if (!std::isfinite(value))
                throw Error(std::string(member) + " is not finite");
            return value;
        }

        Pose poseFrom(const nlohmann::json &state)
        {
            return {finite(state, "x"), finite(state, "y"), finite(state, "yaw")};
        }

        /** Between two states lies an arc of the curvature with which the second is reached. */
        Path pathFrom(const nlohmann::json &states)
        {
            if (states.size() < 2)
                throw Error("it has no path");
            Path path;
            Pose before = path.start = poseFrom(states.at(0));
            for (std::size_t i = 1; i < states.size(); ++i)
            {
                const nlohmann::json &state = states.at(i);
                const Pose pose = poseFrom(state);
                const double curvature = finite(state, "curvature"), chord = positionDistance(before, pose);
                const double bend = 0.5 * std::abs(curvature) * chord;
                const double length = bend > 1e-9 ? chord * std::asin(std::min(1.0, bend)) / bend : chord;
                if (length > NO_LENGTH)
                    path.append(Arc{curvature, state.at("direction").get<int>() < 0 ? -length : length});
                else if (std::abs(wrapAngle(pose.yaw - before.yaw)) > 1e-6)
                    throw Error("its path turns on the spot, which no car can");
                before = pose;
            }
            return path;
        }

        Trajectory trajectoryFrom(const nlohmann::json &samples)
        {
            Trajectory trajectory;
            for (const nlohmann::json &sample : samples)
            {
                const Pose pose = poseFrom(sample);
                trajectory.push_back({finite(sample, "t"), pose.x, pose.y, pose.yaw, finite(sample, "v"),
                                      finite(sample, "acceleration"), finite(sample, "steering"),
                                      sample.contains("steering_rate") ? finite(sample, "steering_rate") : 0.0});
            }
            return trajectory;
        }

        Vehicle vehicleFrom(const nlohmann::json &json)
        {
            Vehicle car;
            car.wheelbase = finite(json, "wheelbase");
            car.frontOverhang = finite(json, "front_overhang");
            car.rearOverhang = finite(json, "rear_overhang");
            car.width = finite(json, "width");
            car.maxSteeringAngle = finite(json, "max_steering_angle");
            return car;
        }

        /** 7 of a scenario called Case07. */
        int idOf(const std::string &scenario)
        {
            std::size_t begin = scenario.size();
            while (begin > 0 && std::isdigit(static_cast<unsigned char>(scenario[begin - 1])) != 0)
                --begin;
            std::size_t id = 0;
            return parseCount(scenario.substr(begin), id) && id > 0 && id < 1000 ? static_cast<int>(id) : 1;
        }
    }  // namespace

    bool looksLikeResult(const std::string &file)
    {
        std::ifstream stream(file);
        char first = ' ';
        stream >> first;
        return first == '{';
    }

    StoredResult readResult(const std::string &file)
    {
        const std::string text = readFile(file, LARGEST);
        try
        {
            const nlohmann::json json = nlohmann::json::parse(text);
            StoredResult result;
            result.planner = json.at("planner").get<std::string>();
            result.status = json.at("status").get<std::string>();
            result.planningTime = 1e-3 * json.at("planning_time_ms").at(0).get<double>();
            result.caseId = idOf(json.value("scenario", ""));
            result.vehicle = vehicleFrom(json.at("vehicle"));
            result.path = pathFrom(json.at("path"));
            for (const char *member : {"trajectory", "planned_trajectory"})
                if (json.contains(member) && !json.at(member).empty())
                    result.trajectory = trajectoryFrom(json.at(member));
            return result;
        }
        catch (const std::exception &error)
        {
            throw Error(file + ": no result of parking_plan --json: " + oneLine(error.what()));
        }
    }

    const std::vector<ResultFormat> &resultFormats()
    {
        static const std::vector<ResultFormat> formats{commonParkingPath(), commonParkingTrajectory(),
                                                       tpcapTrajectory()};
        return formats;
    }

    const ResultFormat &resultFormat(const std::string &name)
    {
        std::vector<std::string> names;
        for (const ResultFormat &format : resultFormats())
        {
            if (format.name == name)
                return format;
            names.emplace_back(format.name);
        }
        throw Error(unknownName("format of results", name, names));
    }
}  // namespace parking
