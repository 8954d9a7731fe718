#pragma once

#include "parking_geometry/drawing/SvgMap.h"

#include <string>
#include <string_view>

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

    /** \brief About how wide a text is in the figures' font, in pixels. */
    double textWidth(std::string_view text, double size);

    /** \brief The 1, 2 or 5 times a power of ten next below or at \e value. */
    double roundStep(double value);

    /** \brief A tick's label: as many decimals as \e step needs. */
    std::string tickLabel(double value, double step);
}  // namespace parking
