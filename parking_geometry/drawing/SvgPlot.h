#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace parking
{
    /** \brief A curve of a plot. Values that are not finite interrupt the curve. */
    struct SvgSeries
    {
        std::string label;      ///< legend label, equal ones listed once; empty for no entry
        std::vector<double> x;  ///< x values in the unit of the axis
        std::vector<double> y;  ///< y values, one per x value
        std::string colour;     ///< SVG colour; empty for the next colour of the palette
        bool dashed{false};     ///< whether the curve is dashed instead of solid
    };

    /** \brief An interval of the x axis with a tinted background, for example where the car drives in reverse. */
    struct SvgBand
    {
        double begin{0.0};   ///< lower x value
        double end{0.0};     ///< upper x value, not less than begin
        std::string colour;  ///< SVG colour, drawn pale
        std::string label;   ///< legend label, equal ones listed once; empty for no entry
    };

    /** \brief A line plot, one panel of a figure. */
    struct SvgPlot
    {
        static constexpr double LEFT = 62.0;   ///< pixels on the left of the frame, for its ticks
        static constexpr double RIGHT = 10.0;  ///< pixels on the right of the frame
        static constexpr double ABOVE = 30.0;  ///< pixels above the frame, for the title
        static constexpr double BELOW = 40.0;  ///< pixels below the frame, for its ticks

        std::string title;                                ///< text above the panel
        std::string xLabel;                               ///< label of the x axis with its unit
        std::string yLabel;                               ///< label of the y axis with its unit
        std::vector<SvgSeries> series;                    ///< curves in drawing order
        std::vector<SvgBand> bands;                       ///< tinted intervals behind all curves
        std::optional<std::pair<double, double>> xRange;  ///< range of the x axis; default: that of the values
        std::optional<std::pair<double, double>> yRange;  ///< range of the y axis; default: values and a margin
        std::vector<double> limits;                       ///< y values that dashed lines mark
        std::string limitsLabel;                          ///< legend label of the limits; empty for no entry
        double height{190.0};                             ///< height of the panel in pixels

        /** \brief The panel as an SVG group with its upper left corner at \e x, \e y pixels.

            Throws parking::Error naming a series with different numbers of x and y values. */
        std::string toSvg(double x, double y, double width) const;
    };
}  // namespace parking
