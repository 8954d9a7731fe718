#include "benchmarks/comparison/RunRecord.h"

#include "benchmarks/comparison/RunColumns.h"
#include "benchmarks/problems/PathJson.h"
#include "parking_geometry/text/Text.h"

#include <cmath>
#include <limits>

using nlohmann::json;

namespace parking
{
    namespace
    {
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

    json RunRecord::toJson() const
    {
        json text{{"experiment", experiment}, {"planner", planner}, {"parameters", parameters}};
        if (!fingerprint.empty())
            text["fingerprint"] = fingerprint;
        if (!reason.empty())
            text["reason"] = reason;
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
        text["path"] = parking::toJson(path);
        text["path"]["exact"] = exact;
        return text;
    }

    RunRecord RunRecord::fromJson(const json &text)
    {
        RunRecord record;
        text.at("experiment").get_to(record.experiment);
        text.at("planner").get_to(record.planner);
        text.at("parameters").get_to(record.parameters);
        record.fingerprint = text.value("fingerprint", "");
        record.reason = text.value("reason", "");
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
        record.path = pathFromJson(*path);
        return record;
    }
}  // namespace parking
