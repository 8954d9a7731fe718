#include "parking_geometry/drawing/SvgText.h"

#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Number of bytes of the UTF-8 character at the beginning of \e text; 0 if it is invalid. */
        std::size_t characterLength(std::string_view text)
        {
            const auto lead = static_cast<unsigned char>(text[0]);
            const std::size_t length = lead < 0x80                   ? 1
                                       : lead >= 0xC2 && lead < 0xE0 ? 2
                                       : lead >= 0xE0 && lead < 0xF0 ? 3
                                       : lead >= 0xF0 && lead < 0xF5 ? 4
                                                                     : 0;
            if (length == 0 || length > text.size())
                return 0;
            for (std::size_t i = 1; i < length; ++i)
                if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80)
                    return 0;
            return length;
        }
    }  // namespace

    std::string px(double value)
    {
        // Coordinates of figures are far smaller.
        std::string text = formatNumber(std::isfinite(value) ? std::clamp(value, -1e30, 1e30) : 0.0, 2);
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.')
            text.pop_back();
        return text;
    }

    std::string escaped(std::string_view text)
    {
        std::string result;
        while (!text.empty())
        {
            const std::size_t length = characterLength(text);
            const char c = text[0];
            if (length == 0 || (length == 1 && (c < ' ' || c == 0x7F)))
                result += '?';
            else if (c == '&')
                result += "&amp;";
            else if (c == '<')
                result += "&lt;";
            else if (c == '>')
                result += "&gt;";
            else if (c == '"')
                result += "&quot;";
            else
                result += text.substr(0, length);
            text.remove_prefix(std::max<std::size_t>(length, 1));
        }
        return result;
    }

    std::string attributes(const SvgStyle &style)
    {
        std::string text;
        for (const auto &[key, value] : style.data)
            text += " data-" + key + "=\"" + escaped(value) + '"';
        text += " fill=\"" + escaped(style.fill) + '"';
        if (style.fill != "none" && style.fillOpacity < 1.0)
            text += " fill-opacity=\"" + px(style.fillOpacity) + '"';
        if (style.stroke == "none")
            return text;
        text += " stroke=\"" + escaped(style.stroke) + "\" stroke-width=\"" + px(style.strokeWidth) + '"';
        if (style.strokeOpacity < 1.0)
            text += " stroke-opacity=\"" + px(style.strokeOpacity) + '"';
        if (!style.dash.empty())
            text += " stroke-dasharray=\"" + escaped(style.dash) + '"';
        return text;
    }

    std::string textElement(double x, double y, double size, const std::string &colour, const std::string &anchor,
                            std::string_view text, const std::string &more)
    {
        return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" font-size=\"" + px(size) + "\" fill=\"" + colour +
               "\" text-anchor=\"" + anchor + '"' + more + '>' + escaped(text) + "</text>\n";
    }

    void addToLegend(std::vector<SvgLegendEntry> &legend, const SvgLegendEntry &entry)
    {
        const bool listed = std::any_of(legend.begin(), legend.end(),
                                        [&entry](const SvgLegendEntry &other) { return other.label == entry.label; });
        if (!entry.label.empty() && !listed)
            legend.push_back(entry);
    }

    std::string legendSample(const SvgLegendEntry &entry, double x, double y)
    {
        const std::string style = attributes(entry.style) + "/>\n";
        switch (entry.sample)
        {
            case SvgSample::Line:
                return "<path d=\"M" + px(x) + ' ' + px(y + 8.0) + 'h' + px(SAMPLE_WIDTH) +
                       "\" stroke-linecap=\"round\"" + style;
            case SvgSample::Dot:
                return "<circle cx=\"" + px(x + 0.5 * SAMPLE_WIDTH) + "\" cy=\"" + px(y + 8.0) + "\" r=\"3.4\"" + style;
            case SvgSample::Box:
                break;
        }
        return "<rect x=\"" + px(x + 1.0) + "\" y=\"" + px(y + 2.0) + "\" width=\"" + px(SAMPLE_WIDTH - 2.0) +
               "\" height=\"12\" rx=\"2\"" + style;
    }

    double textWidth(std::string_view text, double size)
    {
        return 0.54 * size * static_cast<double>(text.size());
    }

    double roundStep(double value)
    {
        const double power = std::pow(10.0, std::floor(std::log10(value)));
        for (const double factor : {5.0, 2.0})
            if (factor * power <= value * (1.0 + 1e-9))
                return factor * power;
        return power;
    }

    std::vector<double> roundTicks(double begin, double end, double step)
    {
        std::vector<double> ticks;
        const double first = std::ceil(begin / step - 1e-9), maxCount = (end - begin) / step + 1.0;
        // Multiples instead of sums, so that zero is exact, and a limit for numbers too large for steps to change them.
        for (double k = 0.0; k <= maxCount && (first + k) * step <= end + 1e-9 * (end - begin); k += 1.0)
            ticks.push_back((first + k) * step);
        return ticks;
    }

    std::string darkTheme()
    {
        // Pairs of a light and a dark colour with the same meaning.
        constexpr const char *DARK[][2] = {{"#ffffff", "#14181d"},
                                           {"#fbfcfd", "#191e24"},
                                           {"#e9edf2", "#272e36"},
                                           {"#cbd5e1", "#3b4550"},
                                           {"#b6c0cd", "#566270"},
                                           {"#64748b", "#94a3b8"},
                                           {"#0f172a", "#f1f5f9"},
                                           {svg_colour::START, "#cbd5e1"},
                                           {svg_colour::FORWARD, "#6ea0ff"},
                                           {svg_colour::REVERSE, "#fb923c"},
                                           {svg_colour::GOAL, "#34d399"},
                                           {svg_colour::DRIVEN, "#f472b6"},
                                           {svg_colour::OBSTACLE, "#434e5b"},
                                           {svg_colour::OBSTACLE_EDGE, "#8492a3"},
                                           {svg_colour::OUTSIDE, "#20262d"},
                                           {svg_colour::UNKNOWN, "#5c5132"}};
        std::string rules;
        for (const auto &[light, dark] : DARK)
            for (const std::string attribute : {"fill", "stroke"})
                rules += "[" + attribute + "=\"" + light + "\"]{" + attribute + ":" + dark + "}";
        return "@media (prefers-color-scheme: dark){" + rules + "}";
    }

    std::string tickLabel(double value, double step)
    {
        return formatNumber(value, std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9));
    }
}  // namespace parking
