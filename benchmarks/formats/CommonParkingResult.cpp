// Results as CommonParking takes them (docs/RESULT_FORMAT.md and evaluation/+cpe/ValidateResult.m of its repository): a
// MATLAB struct result with either a path, equally spaced within each run of a gear and no more than 5 cm apart, or a
// trajectory.

#include "benchmarks/formats/MatFile.h"
#include "benchmarks/formats/ResultFormat.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double SPACING = 0.05;        // metres, at most
        constexpr double LONGEST = 1000.0;      // metres of a path
        constexpr double LONGEST_TIME = 600.0;  // seconds of a trajectory
        constexpr std::size_t MOST = 2000000;   // samples
        constexpr double AT_REST = 1e-6;        // m/s

        MatValue resultOf(const StoredResult &result, const std::string &kind, MatValue solution)
        {
            const bool isPath = kind == "path";
            const std::string code = result.isSolved() ? "solved" : "not_solved";
            return MatValue::structure(
                {{"schema_version", MatValue::of("CommonParking-result-1")},
                 {"planner", MatValue::of(result.planner)},
                 {"case_id", MatValue::number(result.caseId)},
                 {"kind", MatValue::of(kind)},
                 {"reference_point", MatValue::of("rear_axle_midpoint")},
                 {"units",
                  MatValue::structure(
                      {{"length", MatValue::of("m")}, {"angle", MatValue::of("rad")}, {"time", MatValue::of("s")}})},
                 {"status", MatValue::structure({{"success", MatValue::logical(result.isSolved())},
                                                 {"code", MatValue::of(code)},
                                                 {"message", MatValue::of(result.status)}})},
                 {"computation_time_s", MatValue::number(result.planningTime)},
                 {"path", isPath ? solution : MatValue::empty()},
                 {"trajectory", isPath ? MatValue::empty() : solution}});
        }

        void writePath(const StoredResult &result, const std::string &file)
        {
            const Path &path = result.path;
            std::vector<double> s{0.0}, x{path.start.x}, y{path.start.y}, theta{path.start.yaw}, curvatures, gear,
                cusps{1.0}, lengths, bends;
            Pose pose = path.start;  // where the piece begins, yaw not wrapped
            double before = 0.0;     // metres driven until then
            for (const Stretch &stretch : path.stretches())
            {
                const double begin = before, length = path.part(stretch.first, stretch.last).length();
                const double parts = std::max(1.0, std::ceil(length / SPACING - 1e-9));
                double part = 1.0;
                for (std::size_t i = stretch.first; i < stretch.last; ++i)
                {
                    const PathPiece &piece = path.pieces[i];
                    const bool last = i + 1 == stretch.last;
                    lengths.push_back(piece.length);
                    bends.push_back(piece.curvature);
                    // A sample has the curvature behind it; the very first one of the piece is among its own.
                    if (curvatures.size() < s.size())
                        curvatures.push_back(piece.curvature);
                    for (; part <= parts; part += 1.0)
                    {
                        const double place = begin + length * part / parts;
                        if (!last && place > before + piece.driven())
                            break;
                        const Pose at = advance(pose, piece, std::min(piece.driven(), place - before));
                        s.push_back(place);
                        x.push_back(at.x);
                        y.push_back(at.y);
                        theta.push_back(at.yaw);
                        gear.push_back(stretch.direction);
                        if (part < parts)
                            curvatures.push_back(piece.curvature);
                    }
                    before += piece.driven();
                    pose = advance(pose, piece);
                }
                before = s.back();
                cusps.push_back(static_cast<double>(s.size()));
            }
            curvatures.push_back(path.pieces.back().curvature);
            std::vector<double> phi;
            for (const double curvature : curvatures)
                phi.push_back(result.vehicle.steeringAngle(curvature));
            MatValue primitives = MatValue::column(lengths);
            primitives.columns = 2;
            primitives.numbers.insert(primitives.numbers.end(), bends.begin(), bends.end());
            const MatValue geometry =
                MatValue::structure({{"type", MatValue::of("piecewise_circular")},
                                     {"start", MatValue::row({path.start.x, path.start.y, path.start.yaw})},
                                     {"primitives", std::move(primitives)}});
            writeMat(file, "result",
                     resultOf(result, "path",
                              MatValue::structure({{"s", MatValue::column(s)},
                                                   {"x", MatValue::column(x)},
                                                   {"y", MatValue::column(y)},
                                                   {"theta", MatValue::column(theta)},
                                                   {"phi", MatValue::column(phi)},
                                                   {"gear", MatValue::column(gear)},
                                                   {"cusp_indices", MatValue::column(cusps)},
                                                   {"geometry", geometry}})));
        }

        void writeTrajectory(const StoredResult &result, const std::string &file)
        {
            std::vector<std::vector<double>> columns(8);
            double yaw = result.trajectory.front().yaw;
            for (const TrajectoryPoint &point : result.trajectory)
            {
                yaw += wrapAngle(point.yaw - yaw);
                const double values[]{point.t - result.trajectory.front().t,
                                      point.x,
                                      point.y,
                                      yaw,
                                      point.v,
                                      point.steering,
                                      point.acceleration,
                                      point.steeringRate};
                for (std::size_t i = 0; i < columns.size(); ++i)
                    columns[i].push_back(values[i]);
            }
            const char *const names[]{"t", "x", "y", "theta", "v", "phi", "a", "omega"};
            std::vector<std::pair<std::string, MatValue>> fields;
            for (std::size_t i = 0; i < columns.size(); ++i)
                fields.emplace_back(names[i], MatValue::column(std::move(columns[i])));
            writeMat(file, "result", resultOf(result, "trajectory", MatValue::structure(std::move(fields))));
        }

        /** The columns of a solution, all of them as long as x but for \e shorter. */
        std::string columnsFault(const MatValue &solution, const std::vector<std::string> &names,
                                 const std::string &shorter)
        {
            const MatValue *x = solution.field("x");
            const std::size_t count = x != nullptr ? x->numbers.size() : 0;
            if (count < 2 || count > MOST)
                return "it has " + std::to_string(count) + " samples";
            for (const std::string &name : names)
            {
                const MatValue *value = solution.field(name);
                if (value == nullptr || value->columns != 1 ||
                    value->numbers.size() != (name == shorter ? count - 1 : count))
                    return name + " is no column of the right length";
                for (const double each : value->numbers)
                    if (!std::isfinite(each))
                        return name + " is not finite";
            }
            return "";
        }

        std::string pathFault(const MatValue &path)
        {
            std::string fault = columnsFault(path, {"s", "x", "y", "theta", "phi", "gear"}, "gear");
            if (!fault.empty())
                return fault;
            const auto &s = path.field("s")->numbers, &x = path.field("x")->numbers, &y = path.field("y")->numbers,
                       &gear = path.field("gear")->numbers, &cusps = path.field("cusp_indices")->numbers;
            if (s.front() != 0.0 || s.back() > LONGEST)
                return "the mileage must begin with 0 and end by 1000 m";
            std::vector<double> cuts{1.0};
            for (std::size_t i = 1; i < gear.size(); ++i)
                if (gear[i] != gear[i - 1])
                    cuts.push_back(static_cast<double>(i + 1));
            cuts.push_back(static_cast<double>(s.size()));
            if (cusps != cuts)
                return "cusp_indices are not both ends and every gear change";
            for (std::size_t i = 1; i < s.size(); ++i)
                if (!(s[i] > s[i - 1]) || std::hypot(x[i] - x[i - 1], y[i] - y[i - 1]) > s[i] - s[i - 1] + 1e-6)
                    return "the mileage does not fit the positions at sample " + std::to_string(i + 1);
            for (std::size_t j = 1; j < cuts.size(); ++j)
            {
                const auto from = static_cast<std::size_t>(cuts[j - 1]) - 1, to = static_cast<std::size_t>(cuts[j]) - 1;
                const double step = (s[to] - s[from]) / static_cast<double>(to - from);
                for (std::size_t i = from; i < to; ++i)
                    if (std::abs(s[i + 1] - s[i] - step) > 1e-8 || step > SPACING + 1e-8)
                        return "samples are not evenly spaced within a gear, or more than 5 cm apart";
            }
            return "";
        }

        std::string trajectoryFault(const MatValue &trajectory)
        {
            std::string fault = columnsFault(trajectory, {"t", "x", "y", "theta", "v", "phi", "a", "omega"}, "");
            if (!fault.empty())
                return fault;
            const auto &t = trajectory.field("t")->numbers, &v = trajectory.field("v")->numbers;
            if (t.front() != 0.0 || t.back() > LONGEST_TIME)
                return "time must begin with 0 and end by 600 s";
            for (std::size_t i = 1; i < t.size(); ++i)
                if (!(t[i] > t[i - 1]))
                    return "time does not increase at sample " + std::to_string(i + 1);
            if (std::abs(v.front()) > AT_REST || std::abs(v.back()) > AT_REST)
                return "it must begin and end at rest";
            return "";
        }

        std::string check(const StoredResult & /*result*/, const std::string &file)
        {
            const MatValue written = readMat(file, "result");
            const MatValue *kind = written.field("kind");
            const MatValue *solution = kind != nullptr ? written.field(kind->text) : nullptr;
            if (solution == nullptr)
                return "it has neither path nor trajectory";
            return kind->text == "path" ? pathFault(*solution) : trajectoryFault(*solution);
        }
    }  // namespace

    ResultFormat commonParkingPath()
    {
        return {"commonparking-path",
                ".mat",
                "path for CommonParking's EvaluateResult, with its exact arcs",
                false,
                writePath,
                check};
    }

    ResultFormat commonParkingTrajectory()
    {
        return {"commonparking-trajectory", ".mat", "trajectory for the same", true, writeTrajectory, check};
    }
}  // namespace parking
