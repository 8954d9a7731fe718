#include "benchmarks/formats/ResultFormat.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

namespace parking
{
    namespace
    {
        using nlohmann::json;

        constexpr int FORMAT = 1;           // of what parking_plan --json writes
        constexpr double NO_LENGTH = 1e-9;  // metres
        constexpr double LONGEST = 1e6;     // metres: the referee looks at none that is longer
        // Between a state and where the arc to it ends. Who rounds to millimetres is not refused; a state that was left
        // out or put elsewhere is.
        constexpr double JUMP = 0.01, YAW_JUMP = 0.01;  // metres, radians
        constexpr double LEAP = 0.05;  // metres that the car may have gone besides what its speeds explain

        std::string kindOf(const json &value)
        {
            if (value.is_array())
                return value.empty() ? "an empty list" : "a list";
            if (value.is_object())
                return "an object";
            return value.is_string() ? inQuotes(value.get<std::string>()) : value.dump();
        }

        /** A value in the file and where it stands, for messages: path[3].x. */
        class Field
        {
        public:
            Field(const json &value, std::string name) : value_(value), name_(std::move(name))
            {
            }

            [[noreturn]] void fail(const std::string &right) const
            {
                throw Error(name_ + " is " + kindOf(value_) + "; it must be " + right);
            }

            bool has(const char *member) const
            {
                return value_.is_object() && value_.contains(member);
            }

            Field at(const char *member) const
            {
                if (!value_.is_object())
                    fail("an object with " + std::string(member));
                const std::string name = name_.empty() ? member : name_ + "." + member;
                const auto found = value_.find(member);
                if (found == value_.end())
                    throw Error(name + " is missing");
                return {*found, name};
            }

            /** The entries of a list. */
            std::vector<Field> entries() const
            {
                if (!value_.is_array())
                    fail("a list");
                std::vector<Field> all;
                all.reserve(value_.size());
                for (const json &each : value_)
                    all.emplace_back(each, name_ + "[" + std::to_string(all.size()) + "]");
                return all;
            }

            double number() const
            {
                if (!value_.is_number() || !std::isfinite(value_.get<double>()))
                    fail("a finite number");
                return value_.get<double>();
            }

            double number(const char *member) const
            {
                return at(member).number();
            }

            std::string text() const
            {
                if (!value_.is_string() || value_.get_ref<const std::string &>().empty())
                    fail("a word");
                return value_.get<std::string>();
            }

            const std::string &name() const
            {
                return name_;
            }

        private:
            const json &value_;
            std::string name_;
        };

        Pose poseFrom(const Field &state)
        {
            return {state.number("x"), state.number("y"), state.number("yaw")};
        }

        int directionFrom(const Field &state)
        {
            const double direction = state.number("direction");
            if (std::abs(direction) != 1.0)
                state.at("direction").fail("1 or -1");
            return direction < 0.0 ? -1 : 1;
        }

        /** Between two states lies an arc of the curvature with which the second is reached. */
        PathPiece pieceBetween(const Pose &before, const Pose &pose, const Field &state)
        {
            const double curvature = state.number("curvature"), chord = positionDistance(before, pose);
            const double bend = 0.5 * std::abs(curvature) * chord;
            const double length = bend > 1e-9 ? chord * std::asin(std::min(1.0, bend)) / bend : chord;
            const PathPiece piece = Arc{curvature, directionFrom(state) * length};
            const Pose end = advance(before, piece);
            const double off = positionDistance(end, pose), turned = std::abs(wrapAngle(end.yaw - pose.yaw));
            if (length <= NO_LENGTH && turned > 1e-6)
                throw Error(state.name() + " turns on the spot, which no car can");
            if (!(off <= JUMP && turned <= YAW_JUMP))
                throw Error(state.name() + " does not follow from the state before: an arc of its curvature, " +
                            formatNumber(curvature) + " 1/m, ends " + formatNumber(off, 3) + " m and " +
                            formatNumber(turned, 3) + " rad away");
            return piece;
        }

        Path pathFrom(const std::vector<Field> &states)
        {
            Path path;
            Pose before = path.start = poseFrom(states.front());
            for (std::size_t i = 1; i < states.size(); ++i)
            {
                const Pose pose = poseFrom(states[i]);
                const PathPiece piece = pieceBetween(before, pose, states[i]);
                if (piece.driven() > NO_LENGTH)
                    path.append(piece);
                before = pose;
            }
            return path;
        }

        Trajectory trajectoryFrom(const std::vector<Field> &samples)
        {
            Trajectory trajectory;
            for (const Field &sample : samples)
            {
                const Pose pose = poseFrom(sample);
                const TrajectoryPoint point{sample.number("t"),
                                            pose.x,
                                            pose.y,
                                            pose.yaw,
                                            sample.number("v"),
                                            sample.number("acceleration"),
                                            sample.number("steering"),
                                            sample.has("steering_rate") ? sample.number("steering_rate") : 0.0};
                if (!trajectory.empty())
                {
                    const TrajectoryPoint &last = trajectory.back();
                    if (!(point.t > last.t))
                        sample.at("t").fail("more than the " + formatNumber(last.t) + " before");
                    const double way = std::hypot(point.x - last.x, point.y - last.y), time = point.t - last.t;
                    if (!(way <= LEAP + 1.1 * time * std::max(std::abs(point.v), std::abs(last.v))))
                        throw Error(sample.name() + " lies " + formatNumber(way, 3) + " m from the one before, in " +
                                    formatNumber(time, 3) + " s at " + formatNumber(point.v, 3) +
                                    " m/s; it must be where the car can have got to");
                }
                trajectory.push_back(point);
            }
            return trajectory;
        }

        Vehicle vehicleFrom(const Field &field)
        {
            Vehicle car;
            if (field.has("name"))
                car.name = field.at("name").text();
            car.wheelbase = field.number("wheelbase");
            car.frontOverhang = field.number("front_overhang");
            car.rearOverhang = field.number("rear_overhang");
            car.width = field.number("width");
            car.maxSteeringAngle = field.number("max_steering_angle");
            car.validate();
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

        /** Status and path; who has a path says one of three. */
        void takePath(StoredResult &result, const Field &file)
        {
            const Field status = file.at("status");
            result.status = status.text();
            const std::vector<Field> states = file.at("path").entries();
            if (states.size() < 2)
                throw Error("it has no path, since its status is " + inQuotes(result.status));
            if (result.status != "exact" && result.status != "approximate" && result.status != "invalid_path")
                status.fail("exact, approximate or invalid_path, as there is a path");
            result.path = pathFrom(states);
            if (result.path.pieces.empty())
                throw Error("its path goes nowhere");
            if (!(result.path.length() <= LONGEST))
                throw Error("its path is " + formatNumber(result.path.length()) + " m long; at most " +
                            formatNumber(LONGEST) + " m are taken");
        }

        StoredResult resultFrom(const Field &file)
        {
            StoredResult result;
            result.planner = file.at("planner").text();
            const Field time = file.at("planning_time_ms");
            const std::vector<Field> times = time.entries();
            if (times.empty())
                time.fail("a list of milliseconds, one for each run");
            for (const Field &each : times)
                if (each.number() < 0.0)
                    each.fail("a number of milliseconds that is not negative");
            result.planningTime = 1e-3 * times.front().number();
            if (file.has("scenario"))
                result.caseId = idOf(file.at("scenario").text());
            result.vehicle = vehicleFrom(file.at("vehicle"));
            takePath(result, file);
            for (const char *member : {"trajectory", "planned_trajectory"})
                if (file.has(member))
                    if (const std::vector<Field> samples = file.at(member).entries(); !samples.empty())
                        result.trajectory = trajectoryFrom(samples);
            return result;
        }

        /** The parser's words without the number of the error. */
        std::string reasonOf(const json::exception &error)
        {
            const std::string text = error.what();
            const std::size_t end = text.find("] ");
            return oneLine(end == std::string::npos ? text : text.substr(end + 2));
        }
    }  // namespace

    bool looksLikeResult(const std::string &content)
    {
        const std::string_view text = trimmed(content);
        return !text.empty() && text.front() == '{';
    }

    StoredResult parseResult(const std::string &file, const std::string &content)
    {
        json parsed;
        try
        {
            parsed = json::parse(content);
        }
        catch (const json::exception &error)
        {
            throw Error(file + ": no result of parking_plan --json: " + reasonOf(error));
        }
        const Field all(parsed, "");
        if (!all.has("format") || parsed["format"] != FORMAT)
            throw Error(file + ": no result of parking_plan --json: format is " +
                        (all.has("format") ? kindOf(parsed["format"]) : "missing") + "; it must be " +
                        std::to_string(FORMAT));
        try
        {
            return resultFrom(all);
        }
        catch (const Error &error)
        {
            throw Error(file + ": " + error.what());
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

    const ResultFormat &resultFormatForName(const std::string &file)
    {
        const std::string extension = std::filesystem::path(file).extension().string();
        std::string names;
        for (const ResultFormat &format : resultFormats())
        {
            if (format.extension == extension)
                return format;
            names += (names.empty() ? "" : ", ") + std::string(format.name) + " (" + format.extension + ")";
        }
        throw Error(inQuotes(file) + ": the name says no format of results; name one with --to: " + names);
    }
}  // namespace parking
