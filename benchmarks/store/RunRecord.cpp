#include "benchmarks/store/RunRecord.h"

#include "benchmarks/plan/PathJson.h"
#include "benchmarks/store/RunColumns.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <cmath>
#include <limits>

using nlohmann::json;

namespace parking
{
    namespace
    {
        /** JSON has no infinity: values that are not finite are stored as words. */
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

    void RunRecord::setFigure(const std::string &column, const FigureValue &value)
    {
        figures[column] = runColumn(column).checked(value);
    }

    double RunRecord::number(const std::string &column) const
    {
        const auto found = figures.find(column);
        if (found == figures.end())
            return std::numeric_limits<double>::quiet_NaN();
        return std::visit([](auto each) { return static_cast<double>(each); }, found->second);
    }

    std::optional<PlanStatus> RunRecord::outcome() const
    {
        const double value = number("outcome");
        return std::isnan(value) ? std::nullopt : std::optional<PlanStatus>(static_cast<PlanStatus>(value));
    }

    json RunRecord::toJson() const
    {
        json text{{"experiment", experiment},   {"planner", planner}, {"parameters", parameters},
                  {"fingerprint", fingerprint}, {"reason", reason},   {"figures", json::object()},
                  {"progress", json::array()}};
        for (const auto &[name, value] : figures)
            text["figures"][name] = figureJson(value);
        for (const Improvement &each : progress)
            text["progress"].push_back(json::array({each.time, each.cost}));
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
        text.at("fingerprint").get_to(record.fingerprint);
        text.at("reason").get_to(record.reason);
        for (const auto &[name, value] : text.at("figures").items())
            if (findRunColumn(name) != nullptr)
                record.setFigure(name, figureFrom(value));
            else
                record.figures[name] = figureFrom(value);
        for (const char *which : {"run", "seed"})
            if (record.figures.count(which) == 0)
                throw Error(std::string("a run without its ") + which);
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
