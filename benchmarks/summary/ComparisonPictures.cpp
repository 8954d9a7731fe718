#include "benchmarks/summary/ComparisonPictures.h"

#include "benchmarks/plan/PlannedPath.h"
#include "parking_geometry/drawing/Svg.h"

#include <array>
#include <cstdio>

namespace parking
{
    namespace
    {
        SampledPath sampled(const RunRecord &record)
        {
            return record.path.sample(samplingOf(record.path.length(), record.is("densely valid")));
        }
        /** Twelve colours that most readers can distinguish, also in print. */
        constexpr std::array<const char *, 12> COLOURS{"#2563eb", "#ea580c", "#059669", "#be185d",
                                                       "#7c3aed", "#0891b2", "#a16207", "#dc2626",
                                                       "#4d7c0f", "#9333ea", "#475569", "#b45309"};
    }  // namespace

    const RunRecord *bestRun(const std::vector<const RunRecord *> &records)
    {
        const RunRecord *best = nullptr;
        const auto rank = [](const RunRecord &record)
        {
            return record.isSuccess() ? 2 : record.exact ? 1 : 0;
        };
        for (const RunRecord *record : records)
        {
            if (!record->hasPath)
                continue;
            if (best == nullptr || rank(*record) > rank(*best) ||
                (rank(*record) == rank(*best) && record->number("path length") < best->number("path length")))
                best = record;
        }
        return best;
    }

    std::string comparisonSvg(const Scenario &scenario, const std::string &title,
                              const std::vector<std::pair<std::string, const RunRecord *>> &best)
    {
        SampledPath all;
        std::size_t solved = 0;
        for (const auto &[planner, record] : best)
        {
            if (record == nullptr)
                continue;
            const SampledPath path = sampled(*record);
            all.insert(all.end(), path.begin(), path.end());
            solved += record->isSuccess() ? 1 : 0;
        }
        SvgFigure figure(title, "best path of each planner; " + std::to_string(solved) + " of " +
                                    std::to_string(best.size()) + " planners solved it");
        SvgMap map(viewAround(scenario, all));
        drawScenario(map, scenario);
        for (std::size_t i = 0; i < best.size(); ++i)
        {
            const auto &[planner, record] = best[i];
            if (record == nullptr)
                continue;
            SvgStyle style;
            style.stroke = COLOURS[i % COLOURS.size()];
            style.strokeWidth = 2.0;
            style.strokeOpacity = 0.9;
            style.dash = record->isSuccess() ? "" : "3 4";
            const SvgStyle legend = style;
            style.data = {{"planner", planner}, {"run", std::to_string(record->run())}};
            std::vector<Eigen::Vector2d> line;
            const SampledPath path = sampled(*record);
            for (std::size_t k = 1; k < path.size(); ++k)
            {
                line.emplace_back(path[k - 1].pose.x, path[k - 1].pose.y);
                // The last state of a stretch has the stretch's direction.
                if (k + 1 < path.size() && path[k + 1].direction == path[k].direction)
                    continue;
                line.emplace_back(path[k].pose.x, path[k].pose.y);
                style.data["direction"] = path[k].direction < 0 ? "reverse" : "forward";
                map.drawLine(SvgLayer::Lines, line, style);
                line.clear();
            }
            char length[32];
            std::snprintf(length, sizeof length, " %.1f m", record->number("path length"));
            map.addLegend({planner + length +
                               (record->isSuccess() ? ""
                                : record->exact     ? " (invalid)"
                                                    : " (approximate)"),
                           legend, SvgSample::Line});
        }
        figure.setMap(map);
        return figure.toString();
    }
}  // namespace parking
