#include "benchmarks/summary/ComparisonPictures.h"

#include "benchmarks/plan/PlannedPath.h"
#include "benchmarks/system/Counted.h"
#include "parking_geometry/drawing/Svg.h"
#include "parking_geometry/drawing/SvgText.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>

namespace parking
{
    namespace
    {
        constexpr double MARGIN = 1.2;                                            // metres round the shapes
        constexpr double ASPECT = 1.5;                                            // width of a panel over its height
        constexpr double BEST_WIDTH = 480.0, PANEL = 294.0;                       // pixels of the drawn panels
        constexpr double WIDTH = 912.0, EDGE = 24.0, GAP = 15.0, CAPTION = 26.0;  // pixels of the picture
        constexpr std::size_t COLUMNS = 3;

        /** The view widened to the sides of the report's pictures. */
        SvgMap mapOf(const Scenario &scenario, const SampledPath &path, double width)
        {
            const Box view = viewAround(scenario, path, MARGIN);
            const Eigen::Vector2d middle = 0.5 * (view.min + view.max), size = view.size();
            const Eigen::Vector2d half(0.5 * std::max(size.x(), size.y() * ASPECT),
                                       0.5 * std::max(size.y(), size.x() / ASPECT));
            return SvgMap({middle - half, middle + half}, width);
        }

        SampledPath sampled(const RunRecord &record)
        {
            return record.path.sample(samplingOf(record.path.length(), record.is("densely valid")));
        }

        int rankOf(const RunRecord &record)
        {
            return record.isSuccess() ? 2 : record.exact ? 1 : 0;
        }

        bool isBetter(const RunRecord &record, const RunRecord *other)
        {
            if (other == nullptr || rankOf(record) != rankOf(*other))
                return other == nullptr || rankOf(record) > rankOf(*other);
            return record.number("path length") < other->number("path length");
        }

        /** The path alone, on a panel with the view of \e map. */
        std::string pathShapes(const SvgMap &map, const RunRecord &record, const Vehicle &vehicle, double radius)
        {
            SvgMap shapes(map.view(), map.width());
            if (radius > 0.0)
                drawDiscPath(shapes, sampled(record), radius);
            else
                drawPath(shapes, sampled(record), vehicle);
            return shapes.shapes();
        }

        std::string captionOf(const std::string &planner, const RunRecord &record)
        {
            if (!record.isSuccess())
                return planner + (record.exact ? ": invalid" : ": approximate");
            return planner + ": " + formatNumber(record.number("path length"), 1) + " m, " +
                   counted(static_cast<std::size_t>(record.number("cusps")), "change") + " of direction";
        }

        /** An svg element that shows \e content of the size of \e map. */
        std::string panel(const SvgMap &map, double x, double y, double width, const std::string &kind,
                          const std::string &content)
        {
            return "<svg class=\"" + kind + "\" x=\"" + px(x) + "\" y=\"" + px(y) + "\" width=\"" + px(width) +
                   "\" height=\"" + px(width * map.height() / map.width()) + "\" viewBox=\"0 0 " + px(map.width()) +
                   ' ' + px(map.height()) + "\" overflow=\"hidden\">\n" + content +
                   "<rect x=\"0.5\" y=\"0.5\" width=\"" + px(map.width() - 1.0) + "\" height=\"" +
                   px(map.height() - 1.0) + "\" fill=\"none\" stroke=\"#cbd5e1\"/>\n</svg>\n";
        }

        /** The scenario without paths. */
        std::string groundOf(SvgMap map, const Scenario &scenario)
        {
            drawScenario(map, scenario);
            return "<rect width=\"100%\" height=\"100%\" fill=\"#fbfcfd\"/>\n" + map.shapes() + map.scaleBar();
        }

        /** The path with what a program requires to move the body along it: its extent behind, ahead and beside the
            pose, in pixels. */
        std::string pathGroup(const std::pair<std::string, const RunRecord *> &of, const SvgMap &map,
                              const Scenario &scenario, double radius)
        {
            const Vehicle &vehicle = scenario.vehicle;
            const bool isDisc = radius > 0.0;
            const double behind = isDisc ? radius : vehicle.rearOverhang;
            const double ahead = isDisc ? radius : vehicle.wheelbase + vehicle.frontOverhang;
            const double beside = isDisc ? radius : 0.5 * vehicle.width;
            return "<g data-planner=\"" + escaped(of.first) + "\" data-run=\"" + std::to_string(of.second->run()) +
                   "\" data-body=\"" + px(map.scale() * behind) + ' ' + px(map.scale() * ahead) + ' ' +
                   px(map.scale() * beside) + (isDisc ? " disc" : "") + "\">\n" +
                   pathShapes(map, *of.second, vehicle, radius) + "</g>\n";
        }
    }  // namespace

    const RunRecord *bestRun(const std::vector<const RunRecord *> &records)
    {
        const RunRecord *best = nullptr;
        for (const RunRecord *record : records)
            if (record->hasPath && isBetter(*record, best))
                best = record;
        return best;
    }

    std::string comparisonSvg(const Scenario &scenario, const std::string &title, double radius,
                              const std::vector<std::pair<std::string, const RunRecord *>> &best)
    {
        std::vector<std::pair<std::string, const RunRecord *>> solved;
        SampledPath valid;
        std::string failed;
        const std::pair<std::string, const RunRecord *> *shortest = nullptr;
        for (const auto &each : best)
        {
            const auto &[planner, record] = each;
            if (record != nullptr && (shortest == nullptr || isBetter(*record, shortest->second)))
                shortest = &each;
            if (record == nullptr || !record->isSuccess())
            {
                failed += (failed.empty() ? "No valid path: " : ", ") + planner;
                continue;
            }
            solved.push_back(each);
            const SampledPath path = sampled(*record);
            valid.insert(valid.end(), path.begin(), path.end());
        }
        const SampledPath shown = shortest == nullptr ? SampledPath{} : sampled(*shortest->second);
        const SvgMap large = mapOf(scenario, shown, BEST_WIDTH);
        const SvgMap small = mapOf(scenario, valid, PANEL);

        double y = EDGE;
        std::string body = textElement(EDGE, y + 14.0, 19.0, "#0f172a", "start", title, " font-weight=\"600\"");
        y += 24.0;
        body += textElement(EDGE, y + 12.0, 13.0, "#64748b", "start",
                            std::to_string(solved.size()) + " of " + std::to_string(best.size()) +
                                " planners solved it; blue: forwards, orange: in reverse, circle: change of direction");
        y += 28.0;
        body += panel(
            large, EDGE, y, WIDTH, "best",
            groundOf(large, scenario) + (shortest == nullptr ? "" : pathGroup(*shortest, large, scenario, radius)));
        y += WIDTH * large.height() / large.width();
        body += textElement(EDGE, y + 18.0, 13.0, "#334155", "start",
                            shortest == nullptr ? "no path" : captionOf(shortest->first, *shortest->second));
        y += CAPTION + GAP;

        body += "<defs><g id=\"ground\">\n" + groundOf(small, scenario) + "</g></defs>\n";
        const double height = small.height() + CAPTION;
        for (std::size_t i = 0; i < solved.size(); ++i)
        {
            const double left = EDGE + static_cast<double>(i % COLUMNS) * (PANEL + GAP);
            const double top = y + static_cast<double>(i / COLUMNS) * height;
            body += panel(small, left, top, PANEL, "planner",
                          "<use href=\"#ground\"/>\n" + pathGroup(solved[i], small, scenario, radius));
            body += textElement(left, top + small.height() + 16.0, 12.0, "#334155", "start",
                                captionOf(solved[i].first, *solved[i].second));
        }
        y += static_cast<double>((solved.size() + COLUMNS - 1) / COLUMNS) * height;
        body += textElement(EDGE, y + 14.0, 12.0, "#64748b", "start", failed);
        y += CAPTION + EDGE;
        const std::string width = px(WIDTH + 2.0 * EDGE);
        return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + px(y) +
               "\" viewBox=\"0 0 " + width + ' ' + px(y) +
               "\" font-family=\"Inter, 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif\">\n<style>" + darkTheme() +
               "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" + body + "</svg>\n";
    }
}  // namespace parking
