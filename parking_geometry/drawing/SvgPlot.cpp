#include "parking_geometry/drawing/SvgPlot.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/drawing/SvgText.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr const char *INK = "#334155";
        constexpr const char *FAINT = "#64748b";
        constexpr double TEXT = 12.0;

        // Distinguishable for colour-blind readers too.
        constexpr std::array<const char *, 6> PALETTE = {"#2563eb", "#ea580c", "#059669",
                                                         "#be185d", "#7c3aed", "#854d0e"};

        using Range = std::pair<double, double>;

        /** Range of all finite values; [0, 1] if there are none. */
        Range rangeOf(const std::vector<SvgSeries> &series, const std::vector<double> SvgSeries::*values,
                      const std::vector<double> &more)
        {
            Range range(HUGE_VAL, -HUGE_VAL);
            const auto grow = [&range](double value)
            {
                if (!std::isfinite(value))
                    return;
                range.first = std::min(range.first, value);
                range.second = std::max(range.second, value);
            };
            for (const SvgSeries &each : series)
                std::for_each((each.*values).begin(), (each.*values).end(), grow);
            std::for_each(more.begin(), more.end(), grow);
            if (range.first > range.second)
                return {0.0, 1.0};
            return range;
        }

        bool isWithin(const Range &range, double value)
        {
            return value >= range.first && value <= range.second;
        }

        /** A range that is not empty, with a share of it added at both ends. */
        Range padded(Range range, double share)
        {
            const double size = range.second - range.first;
            const double minSize = std::max(1e-9, 1e-6 * std::max(std::abs(range.first), std::abs(range.second)));
            if (size < minSize)
                return {range.first - 0.5, range.second + 0.5};
            return {range.first - share * size, range.second + share * size};
        }

        /** Maps the values of one axis to pixels. */
        struct Axis
        {
            Range range;
            double begin, end;

            double operator()(double value) const
            {
                return begin + (value - range.first) / (range.second - range.first) * (end - begin);
            }

            std::vector<double> ticks(double spacing, double &step) const
            {
                const double pixels = std::abs(end - begin), size = range.second - range.first;
                step = roundStep(size * std::min(1.0, 2.0 * spacing / pixels));
                return roundTicks(range.first, range.second, step);
            }
        };

        std::string curve(const SvgSeries &series, const SvgStyle &style, const Axis &x, const Axis &y)
        {
            std::string data;
            bool pen = false;
            double lastX = 0.0, lastY = 0.0;
            for (std::size_t i = 0; i < series.x.size(); ++i)
            {
                if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i]))
                {
                    pen = false;
                    continue;
                }
                const double atX = x(series.x[i]), atY = y(series.y[i]);
                const bool last = i + 1 == series.x.size();
                if (pen && !last && std::abs(atX - lastX) < 0.15 && std::abs(atY - lastY) < 0.15)
                    continue;
                data += (pen ? 'L' : 'M') + px(atX) + ' ' + px(atY);
                pen = true;
                lastX = atX;
                lastY = atY;
            }
            return data.empty() ? "" : "<path d=\"" + data + '"' + attributes(style) + " stroke-linejoin=\"round\"/>\n";
        }

        SvgStyle styleOf(const SvgSeries &series, std::size_t index)
        {
            SvgStyle style;
            style.stroke = series.colour.empty() ? PALETTE[index % PALETTE.size()] : series.colour;
            style.strokeWidth = 1.8;
            style.dash = series.dashed ? "6 4" : "";
            return style;
        }

        SvgStyle styleOf(const SvgBand &band)
        {
            SvgStyle style;
            style.fill = band.colour;
            style.fillOpacity = 0.09;
            return style;
        }

        SvgStyle styleOfLimits()
        {
            SvgStyle style;
            style.stroke = FAINT;
            style.dash = "2 4";
            return style;
        }

        /** Entries for all drawn items with a label, each label once. */
        std::vector<SvgLegendEntry> legendOf(const SvgPlot &plot, const Range &upwards)
        {
            std::vector<SvgLegendEntry> entries;
            for (std::size_t i = 0; i < plot.series.size(); ++i)
                addToLegend(entries, {plot.series[i].label, styleOf(plot.series[i], i), SvgSample::Line});
            for (const SvgBand &band : plot.bands)
                addToLegend(entries, {band.label, styleOf(band), SvgSample::Box});
            if (std::any_of(plot.limits.begin(), plot.limits.end(),
                            [&upwards](double limit) { return isWithin(upwards, limit); }))
                addToLegend(entries, {plot.limitsLabel, styleOfLimits(), SvgSample::Line});
            return entries;
        }

        std::string line(double x0, double y0, double x1, double y1, const SvgStyle &style)
        {
            return "<path d=\"M" + px(x0) + ' ' + px(y0) + 'L' + px(x1) + ' ' + px(y1) + '"' + attributes(style) +
                   "/>\n";
        }

        std::string line(double x0, double y0, double x1, double y1, const char *colour)
        {
            SvgStyle style;
            style.stroke = colour;
            return line(x0, y0, x1, y1, style);
        }

        std::string grid(const Axis &x, const Axis &y)
        {
            std::string text;
            double step = 1.0;
            for (const double value : x.ticks(70.0, step))
            {
                text += line(x(value), y.begin, x(value), y.end, "#e9edf2");
                text += textElement(x(value), y.begin + 16.0, TEXT, FAINT, "middle", tickLabel(value, step));
            }
            for (const double value : y.ticks(22.0, step))
            {
                const bool zero = value == 0.0;
                text += line(x.begin, y(value), x.end, y(value), zero ? "#b6c0cd" : "#e9edf2");
                text += textElement(x.begin - 8.0, y(value) + 4.0, TEXT, FAINT, "end", tickLabel(value, step));
            }
            return text;
        }
    }  // namespace

    std::string SvgPlot::toSvg(double left, double top, double width) const
    {
        for (const SvgSeries &each : series)
            if (each.x.size() != each.y.size())
                throw Error("plot '" + title + "', series '" + each.label + "': " + std::to_string(each.x.size()) +
                            " values of x and " + std::to_string(each.y.size()) +
                            " of y; both must have the same number");
        const Range across = padded(xRange.value_or(rangeOf(series, &SvgSeries::x, {})), 0.0);
        const Range upwards = yRange ? padded(*yRange, 0.0) : padded(rangeOf(series, &SvgSeries::y, limits), 0.06);
        const Axis x{across, LEFT, width - RIGHT}, y{upwards, height - BELOW, ABOVE};

        std::string text = "<g transform=\"translate(" + px(left) + ' ' + px(top) + ")\">\n";
        for (const SvgBand &band : bands)
        {
            const double begin = std::clamp(x(band.begin), x.begin, x.end);
            const double end = std::clamp(x(band.end), x.begin, x.end);
            text += "<rect x=\"" + px(begin) + "\" y=\"" + px(y.end) + "\" width=\"" + px(std::max(0.0, end - begin)) +
                    "\" height=\"" + px(y.begin - y.end) + '"' + attributes(styleOf(band)) + "/>\n";
        }
        text += grid(x, y);
        for (const double limit : limits)
            if (isWithin(upwards, limit))
                text += line(x.begin, y(limit), x.end, y(limit), styleOfLimits());
        text += "<rect x=\"" + px(x.begin) + "\" y=\"" + px(y.end) + "\" width=\"" + px(x.end - x.begin) +
                "\" height=\"" + px(y.begin - y.end) + "\" fill=\"none\" stroke=\"#cbd5e1\"/>\n";

        // A nested svg element clips values outside of a given range.
        text += "<svg x=\"0\" y=\"" + px(y.end) + "\" width=\"" + px(width) + "\" height=\"" + px(y.begin - y.end) +
                "\" viewBox=\"0 " + px(y.end) + ' ' + px(width) + ' ' + px(y.begin - y.end) +
                "\" overflow=\"hidden\">\n";
        for (std::size_t i = 0; i < series.size(); ++i)
            text += curve(series[i], styleOf(series[i], i), x, y);
        text += "</svg>\n";

        text += textElement(x.begin, 18.0, 13.0, INK, "start", title, " font-weight=\"600\"");
        text += textElement(0.5 * (x.begin + x.end), height - 6.0, TEXT, FAINT, "middle", xLabel);
        const double middle = 0.5 * (y.begin + y.end);
        text += textElement(14.0, middle, TEXT, FAINT, "middle", yLabel,
                            " transform=\"rotate(-90 14 " + px(middle) + ")\"");
        const std::vector<SvgLegendEntry> entries = legendOf(*this, upwards);
        double at = x.end;
        for (std::size_t i = entries.size(); i-- > 0;)
        {
            // Text widths are estimates, so each label begins beside its sample.
            at -= textWidth(entries[i].label, TEXT);
            text += textElement(at, 18.0, TEXT, INK, "start", entries[i].label);
            at -= 6.0 + SAMPLE_WIDTH;
            text += legendSample(entries[i], at, 6.0);
            at -= 14.0;
        }
        return text + "</g>\n";
    }
}  // namespace parking
