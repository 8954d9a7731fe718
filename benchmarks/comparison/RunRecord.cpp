#include "benchmarks/comparison/RunRecord.h"

#include "benchmarks/comparison/RunColumns.h"
#include "parking_geometry/curves/Kinematics.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <limits>

using nlohmann::json;

namespace parking
{
    namespace
    {
        /** Fewer digits than a double has: a hundredth of a millimetre will do for pictures. */
        double rounded(double value)
        {
            return std::round(value * 1e5) / 1e5;
        }

        json poseArray(const Pose &pose)
        {
            return json::array({rounded(pose.x), rounded(pose.y), rounded(pose.yaw)});
        }

        Pose poseFrom(const json &array)
        {
            return {array.at(0).get<double>(), array.at(1).get<double>(), array.at(2).get<double>()};
        }

        /** JSON has no infinity: what is not finite is the word for it. */
        json figureJson(const FigureValue &value)
        {
            const auto *real = std::get_if<double>(&value);
            if (real != nullptr && !std::isfinite(*real))
                return formatNumber(*real);
            return std::visit([](auto each) { return json(each); }, value);
        }

        FigureValue figureFrom(const json &value)
        {
            if (value.is_boolean())
                return value.get<bool>();
            if (value.is_number_integer())
                return value.get<std::int64_t>();
            if (value == "inf" || value == "-inf")
                return (value == "inf" ? 1.0 : -1.0) * std::numeric_limits<double>::infinity();
            if (value == "nan")
                return std::numeric_limits<double>::quiet_NaN();
            return value.get<double>();
        }
    }  // namespace

    StoredPath StoredPath::of(const PlannedPath &path)
    {
        StoredPath stored;
        if (path.states.empty())
            return stored;
        stored.start = path.states.front().pose;
        if (path.straight)
        {
            for (std::size_t i = 1; i < path.states.size(); ++i)
            {
                // States in the middle of a straight line say nothing.
                const PathState &state = path.states[i];
                const bool corner = i + 1 == path.states.size() || [&]
                {
                    const Pose &before = path.states[i - 1].pose, &after = path.states[i + 1].pose;
                    const double ax = state.pose.x - before.x, ay = state.pose.y - before.y;
                    const double bx = after.x - state.pose.x, by = after.y - state.pose.y;
                    return std::abs(ax * by - ay * bx) > 1e-6 || ax * bx + ay * by < 0.0 ||
                           std::abs(wrapAngle(after.yaw - state.pose.yaw)) > 1e-6 ||
                           std::abs(wrapAngle(state.pose.yaw - before.yaw)) > 1e-6;
                }();
                if (corner)
                    stored.corners.push_back(state.pose);
            }
            return stored;
        }
        Path arcs;
        for (std::size_t i = 1; i < path.states.size(); ++i)
            arcs.append({path.states[i].curvature,
                         (path.states[i].arcLength - path.states[i - 1].arcLength) * path.states[i].direction});
        stored.arcs = std::move(arcs.pieces);
        return stored;
    }

    SampledPath StoredPath::sample(double step) const
    {
        if (corners.empty())
            return Path{start, arcs}.sample(step);
        SampledPath path;
        PathState state;
        state.pose = start;
        path.push_back(state);
        for (const Pose &corner : corners)
        {
            const Pose from = path.back().pose;
            const double begin = path.back().arcLength;
            const double length = std::hypot(corner.x - from.x, corner.y - from.y);
            const double turn = wrapAngle(corner.yaw - from.yaw);
            const Arc arc = arcBetween(from, corner);
            const auto steps = static_cast<std::size_t>(std::max(1.0, std::ceil(length / step)));
            for (std::size_t k = 1; k <= steps; ++k)
            {
                const double share = static_cast<double>(k) / static_cast<double>(steps);
                state.pose = {from.x + share * (corner.x - from.x), from.y + share * (corner.y - from.y),
                              wrapAngle(from.yaw + share * turn)};
                state.arcLength = begin + share * length;
                state.curvature = length > 0.0 ? arc.curvature : 0.0;
                state.direction = arc.length < 0.0 ? -1 : 1;
                path.push_back(state);
            }
        }
        if (path.size() > 1)
        {
            path.front().curvature = path[1].curvature;
            path.front().direction = path[1].direction;
        }
        return path;
    }

    json RunRecord::toJson() const
    {
        json text{{"experiment", experiment}, {"planner", planner}, {"parameters", parameters}};
        json &figures = text["figures"] = json::object();
        for (const RunColumn &column : runColumns())
            if (const std::optional<FigureValue> value = column.valueOf(*this))
                figures[column.name] = figureJson(*value);
        json &own = text["reported"] = json::object();
        for (const auto &[name, value] : reported)
            own[name] = figureJson(value);
        json improvements = json::array();
        for (const Improvement &each : progress)
            improvements.push_back(json::array({each.time, each.cost}));
        text["progress"] = std::move(improvements);
        if (!hasPath)
            return text;
        json stored{{"exact", exact}, {"start", poseArray(path.start)}};
        if (path.corners.empty())
        {
            json arcs = json::array();
            for (const PathPiece &arc : path.arcs)
                arcs.push_back(json::array({rounded(1e2 * arc.curvature) / 1e2, rounded(arc.length)}));
            stored["arcs"] = std::move(arcs);
        }
        else
        {
            json corners = json::array();
            for (const Pose &corner : path.corners)
                corners.push_back(poseArray(corner));
            stored["corners"] = std::move(corners);
        }
        text["path"] = std::move(stored);
        return text;
    }

    RunRecord RunRecord::fromJson(const json &text)
    {
        RunRecord record;
        text.at("experiment").get_to(record.experiment);
        text.at("planner").get_to(record.planner);
        text.at("parameters").get_to(record.parameters);
        const json &figures = text.at("figures");
        for (const char *key : {"run", "seed"})
            figures.at(key);  // which run it is must be there, all else may be missing
        for (const auto &[name, value] : figures.items())
            runColumn(name).set(record, figureFrom(value));
        for (const auto &[name, value] : text.at("reported").items())
            record.reported[name] = figureFrom(value);
        for (const json &each : text.at("progress"))
            record.progress.push_back({each.at(0).get<double>(), each.at(1).get<double>()});
        const auto path = text.find("path");
        if (path == text.end())
            return record;
        record.hasPath = true;
        path->at("exact").get_to(record.exact);
        record.path.start = poseFrom(path->at("start"));
        if (path->contains("arcs"))
            for (const json &arc : path->at("arcs"))
                record.path.arcs.emplace_back(arc.at(0).get<double>(), arc.at(1).get<double>());
        else
            for (const json &corner : path->at("corners"))
                record.path.corners.push_back(poseFrom(corner));
        return record;
    }
}  // namespace parking
