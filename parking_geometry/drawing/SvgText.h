#pragma once

#include "parking_geometry/drawing/SvgMap.h"

#include <string>
#include <string_view>
#include <vector>

namespace parking
{
    /** \brief A length or coordinate in pixels with two decimals, independent of the locale. */
    std::string px(double value);

    /** \brief Text for an SVG file: markup is escaped, control characters and invalid UTF-8 are replaced. */
    std::string escaped(std::string_view text);

    /** \brief The SVG attributes of a style, such as fill and stroke, each with a leading blank. */
    std::string attributes(const SvgStyle &style);

    /** \brief An SVG text element. \param anchor start, middle or end
        \param more further attributes, with a leading blank */
    std::string textElement(double x, double y, double size, const std::string &colour, const std::string &anchor,
                            std::string_view text, const std::string &more = "");

    /** \brief Adds an entry to a legend unless the label is empty or already present. */
    void addToLegend(std::vector<SvgLegendEntry> &legend, const SvgLegendEntry &entry);

    /** \brief The sample of a legend entry, SAMPLE_WIDTH by 16 pixels, with its upper left corner at \e x, \e y. */
    std::string legendSample(const SvgLegendEntry &entry, double x, double y);

    /** \brief Width of the sample of a legend entry in pixels. */
    constexpr double SAMPLE_WIDTH = 22.0;

    /** \brief Approximate width of a text in the figures' font, in pixels. */
    double textWidth(std::string_view text, double size);

    /** \brief The largest of 1, 2 and 5 times a power of ten that is not above \e value. */
    double roundStep(double value);

    /** \brief All multiples of \e step from \e begin to \e end. */
    std::vector<double> roundTicks(double begin, double end, double step);

    /** \brief CSS that shows pictures in dark colours where the reader prefers a dark theme.

        It replaces the colours of svg_colour, and those of frames and texts, in the attributes fill and stroke. */
    std::string darkTheme();

    /** \brief Label of a tick with the number of decimals that \e step requires. */
    std::string tickLabel(double value, double step);
}  // namespace parking
