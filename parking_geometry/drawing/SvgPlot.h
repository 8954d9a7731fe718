#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace parking
{
    /** \brief A curve of a plot. Values that are not finite interrupt it. */
    struct SvgSeries
    {
        std::string label;      ///< empty: not listed; the same label is listed once
        std::vector<double> x;  ///< in the unit of the axis
        std::vector<double> y;  ///< as many as x
        std::string colour;     ///< empty: the next one of the palette
        bool dashed{false};     ///< drawn as dashes, otherwise solid
    };

    /** \brief A stretch of the x axis with a tinted background, for example where the car drives in reverse. */
    struct SvgBand
    {
        double begin{0.0};   ///< value of x
        double end{0.0};     ///< value of x, not less than begin
        std::string colour;  ///< as in SVG; drawn pale
        std::string label;   ///< empty: not listed; the same label is listed once
    };

    /** \brief A line plot: a panel below the map. */
    struct SvgPlot
    {
        static constexpr double LEFT = 62.0;   ///< pixels on the left of the frame, for its ticks
        static constexpr double RIGHT = 10.0;  ///< pixels on the right of the frame
        static constexpr double ABOVE = 30.0;  ///< pixels above the frame, for the title
        static constexpr double BELOW = 40.0;  ///< pixels below the frame, for its ticks

        std::string title;                                ///< above the panel
        std::string xLabel;                               ///< with the unit
        std::string yLabel;                               ///< with the unit
        std::vector<SvgSeries> series;                    ///< drawn in this order
        std::vector<SvgBand> bands;                       ///< behind all series
        std::optional<std::pair<double, double>> xRange;  ///< without it: that of the values
        std::optional<std::pair<double, double>> yRange;  ///< without it: that of the values, with some room
        std::vector<double> limits;                       ///< values of y marked by dashed lines
        std::string limitsLabel;                          ///< empty: not listed
        double height{190.0};                             ///< pixels

        /** \brief The panel as a group whose upper left corner is at \e x, \e y pixels.

            Throws parking::Error naming the series whose x and y differ in number. */
        std::string toSvg(double x, double y, double width) const;
    };
}  // namespace parking
