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
        std::string label;  ///< empty: not listed
        std::vector<double> x;
        std::vector<double> y;  ///< as many as x
        std::string colour;     ///< empty: the next one of the palette
        bool dashed{false};
    };

    /** \brief A stretch of the x axis with a tinted background, for example where the car drives in reverse. */
    struct SvgBand
    {
        double begin{0.0};
        double end{0.0};
        std::string colour;
    };

    /** \brief A line plot: a panel below the map. */
    struct SvgPlot
    {
        std::string title;
        std::string xLabel;
        std::string yLabel;
        std::vector<SvgSeries> series;
        std::vector<SvgBand> bands;
        std::optional<std::pair<double, double>> xRange;  ///< without it: that of the values
        std::optional<std::pair<double, double>> yRange;  ///< without it: that of the values, with some room
        std::vector<double> limits;                       ///< values of y marked by dashed lines
        double height{190.0};                             ///< pixels

        /** \brief The panel as a group whose upper left corner is at \e x, \e y pixels.

            Throws parking::Error naming the series whose x and y differ in number. */
        std::string toSvg(double x, double y, double width) const;
    };
}  // namespace parking
