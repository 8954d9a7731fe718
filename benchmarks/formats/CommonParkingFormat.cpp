// Cases of CommonParking (github.com/libai1943/CommonParking, LoadCase.m and CheckCase.m): a MATLAB struct caseData
// with task {x0, y0, theta0, xf, yf, thetaf} and obstacle {num_obs, obs{j}: x, y (closed), num_grids, kind, area}.
// Poses are of the rear axle's middle; the car is TPCAP's, which steers up to 0.7 rad there (BenchmarkConfig.m).

#include "benchmarks/formats/MatFile.h"
#include "benchmarks/formats/ScenarioFormat.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/MakeScenario.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>

namespace parking
{
    namespace
    {
        constexpr double SAME_CORNER = 1e-10;  // metres: first and last of a closed outline

        Vehicle commonParkingCar()
        {
            Vehicle car;
            car.name = "commonparking";
            car.maxSteeringAngle = 0.7;
            return car;
        }

        // Texts by value: of references to temporaries GCC 14 believes that the result may refer to them.
        const MatValue &need(std::string_view file, const MatValue &parent, std::string_view path,
                             std::string_view name)
        {
            const MatValue *value = parent.field(std::string(name));
            if (value == nullptr)
                throw Error(std::string(file) + ": caseData" + std::string(path) + " has no field " +
                            std::string(name));
            return *value;
        }

        std::vector<double> numbers(const std::string &file, const MatValue &parent, const std::string &path,
                                    const std::string &name)
        {
            const MatValue &value = need(file, parent, path, name);
            if (value.kind != MatValue::Kind::Numbers || value.numbers.empty() ||
                std::min(value.rows, value.columns) != 1)
                throw Error(file + ": caseData" + path + "." + name + " must be a vector of numbers");
            for (const double each : value.numbers)
                if (!std::isfinite(each))
                    throw Error(file + ": caseData" + path + "." + name + " holds " + formatNumber(each));
            return value.numbers;
        }

        double number(const std::string &file, const MatValue &parent, const std::string &path, const std::string &name)
        {
            const std::vector<double> values = numbers(file, parent, path, name);
            if (values.size() != 1)
                throw Error(file + ": caseData" + path + "." + name + " must be one number, not " +
                            std::to_string(values.size()));
            return values.front();
        }

        double area(const Polygon &polygon)
        {
            double twice = 0.0;
            for (std::size_t i = 0; i < polygon.size(); ++i)
            {
                const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                twice += a.x() * b.y() - b.x() * a.y();
            }
            return 0.5 * twice;
        }

        Scenario parse(const std::string &file, const std::string &content, const FormatOptions &options)
        {
            const MatValue data = parseMat(file, content, "caseData");
            const MatValue &task = need(file, data, "", "task"), &obstacle = need(file, data, "", "obstacle");
            Scenario scenario;
            scenario.files = {file};
            scenario.name = std::filesystem::path(file).stem().string();
            scenario.vehicle =
                options.vehicle.empty() ? commonParkingCar() : readVehicle(options.vehicle, &scenario.files);
            const auto of = [&](const char *name)
            {
                return number(file, task, ".task", name);
            };
            scenario.start = options.start.value_or(Pose{of("x0"), of("y0"), of("theta0")});
            scenario.goals = {options.goal.value_or(Pose{of("xf"), of("yf"), of("thetaf")})};
            const MatValue &all = need(file, obstacle, ".obstacle", "obs");
            const double announced = number(file, obstacle, ".obstacle", "num_obs");
            if (all.kind != MatValue::Kind::Cell || static_cast<double>(all.cells.size()) != announced)
                throw Error(file + ": caseData.obstacle.obs must be a cell array of num_obs = " +
                            formatNumber(announced) + " obstacles");
            for (std::size_t j = 0; j < all.cells.size(); ++j)
            {
                const std::string path = ".obstacle.obs{" + std::to_string(j + 1) + "}";
                const std::vector<double> x = numbers(file, all.cells[j], path, "x"),
                                          y = numbers(file, all.cells[j], path, "y");
                if (x.size() != y.size())
                    throw Error(file + ": caseData" + path + " has " + std::to_string(x.size()) + " x and " +
                                std::to_string(y.size()) + " y");
                Polygon polygon;
                for (std::size_t i = 0; i < x.size(); ++i)
                    polygon.emplace_back(x[i], y[i]);
                if (polygon.size() > 1 && (polygon.front() - polygon.back()).norm() < SAME_CORNER)
                    polygon.pop_back();
                scenario.polygons.push_back(std::move(polygon));
            }
            return makeScenario(std::move(scenario), file);
        }

        /** The digits at the end of a name: 7 of Case07; 1 without any. */
        double idOf(const std::string &file)
        {
            const std::string stem = std::filesystem::path(file).stem().string();
            std::size_t begin = stem.size();
            while (begin > 0 && std::isdigit(static_cast<unsigned char>(stem[begin - 1])) != 0)
                --begin;
            double id = 0.0;
            return parseNumber(stem.substr(begin), id) ? id : 1.0;
        }

        void write(const Scenario &scenario, const std::string &file)
        {
            const Pose start = scenario.toWorld(scenario.start), goal = scenario.toWorld(scenario.goals.front());
            std::vector<MatValue> obstacles;
            for (Polygon &polygon : obstaclePolygons(scenario))
            {
                if (area(polygon) < 0.0)
                    std::reverse(polygon.begin(), polygon.end());
                std::vector<double> x, y;
                for (std::size_t i = 0; i <= polygon.size(); ++i)
                {
                    x.push_back(polygon[i % polygon.size()].x());
                    y.push_back(polygon[i % polygon.size()].y());
                }
                obstacles.push_back(
                    MatValue::structure({{"x", MatValue::row(std::move(x))},
                                         {"y", MatValue::row(std::move(y))},
                                         {"num_grids", MatValue::number(static_cast<double>(polygon.size()))},
                                         {"kind", MatValue::of("obstacle")},
                                         {"area", MatValue::number(area(polygon))}}));
            }
            const auto count = static_cast<double>(obstacles.size());
            writeMat(file, "caseData",
                     MatValue::structure(
                         {{"id", MatValue::number(idOf(file))},
                          {"task", MatValue::structure({{"x0", MatValue::number(start.x)},
                                                        {"y0", MatValue::number(start.y)},
                                                        {"theta0", MatValue::number(start.yaw)},
                                                        {"xf", MatValue::number(goal.x)},
                                                        {"yf", MatValue::number(goal.y)},
                                                        {"thetaf", MatValue::number(goal.yaw)}})},
                          {"obstacle", MatValue::structure({{"num_obs", MatValue::number(count)},
                                                            {"obs", MatValue::cell(std::move(obstacles))}})}}));
        }
    }  // namespace

    ScenarioFormat commonParkingFormat()
    {
        return {"commonparking",
                ".mat",
                "cases of CommonParking, MATLAB 5; the car steers up to 0.7 rad",
                [](std::string_view begin) { return begin.substr(0, 7) == "MATLAB "; },
                MAT_FILE_LIMIT,
                parse,
                write};
    }
}  // namespace parking
