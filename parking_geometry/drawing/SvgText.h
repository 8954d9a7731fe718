#pragma once

#include "parking_geometry/drawing/SvgMap.h"

#include <string>
#include <string_view>
#include <vector>

namespace parking
{
    /** \brief A length or coordinate in pixels, to a hundredth; never in the style of a locale. */
    std::string px(double value);

    /** \brief Text that may stand in an SVG file: markup escaped, control characters and broken UTF-8 replaced. */
    std::string escaped(std::string_view text);

    /** \brief The attributes fill, stroke and so on of a style, each with a leading blank. */
    std::string attributes(const SvgStyle &style);

    /** \brief A text element. \param anchor start, middle or end */
    std::string textElement(double x, double y, double size, const std::string &colour, const std::string &anchor,
                            std::string_view text, const std::string &more = "");

    /** \brief Adds an entry to a legend that has none of its label; one without a label is left out. */
    void addToLegend(std::vector<SvgLegendEntry> &legend, const SvgLegendEntry &entry);

    /** \brief The sample of a legend's entry, SAMPLE_WIDTH wide and 16 pixels high; its upper left corner is at \e x,
        \e y. */
    std::string legendSample(const SvgLegendEntry &entry, double x, double y);

    /** \brief Pixels across the sample of a legend's entry. */
    constexpr double SAMPLE_WIDTH = 22.0;

    /** \brief About how wide a text is in the figures' font, in pixels. */
    double textWidth(std::string_view text, double size);

    /** \brief The 1, 2 or 5 times a power of ten next below or at \e value. */
    double roundStep(double value);

    /** \brief The multiples of \e step from \e begin to \e end. */
    std::vector<double> roundTicks(double begin, double end, double step);

    /** \brief A tick's label: as many decimals as \e step needs. */
    std::string tickLabel(double value, double step);
}  // namespace parking
