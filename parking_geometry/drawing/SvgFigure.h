#pragma once

#include "parking_geometry/drawing/SvgMap.h"
#include "parking_geometry/drawing/SvgPlot.h"

#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief A self-contained SVG figure: a title, a map with its legend, and line plots below. */
    class SvgFigure
    {
    public:
        /** \brief A figure without a map and plots.

            \param title text of the first line, may be empty
            \param subtitle text of the second, smaller line, may be empty */
        explicit SvgFigure(std::string title = {}, std::string subtitle = {});

        /** \brief Sets the map panel. A figure has at most one. */
        void setMap(const SvgMap &map);

        /** \brief Adds a plot below the existing panels. */
        void addPlot(const SvgPlot &plot);

        /** \brief Content of the SVG file. Throws the errors of SvgPlot::toSvg(). */
        std::string toString() const;

        /** \brief Writes the SVG file atomically. Throws parking::Error like writeFileAtomically(). */
        void write(const std::string &file) const;

    private:
        std::string title_;
        std::string subtitle_;
        std::optional<SvgMap> map_;
        std::vector<SvgPlot> plots_;
    };
}  // namespace parking
