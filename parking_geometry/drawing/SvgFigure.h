#pragma once

#include "parking_geometry/drawing/SvgMap.h"
#include "parking_geometry/drawing/SvgPlot.h"

#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief A figure: a title, a map with its legend, and line plots below it. Self-contained SVG. */
    class SvgFigure
    {
    public:
        /** \brief \param title may be empty \param subtitle a second line, smaller */
        explicit SvgFigure(std::string title = {}, std::string subtitle = {});

        /** \brief The map panel; a figure has at most one. */
        void setMap(const SvgMap &map);

        /** \brief Another plot below what is there. */
        void addPlot(const SvgPlot &plot);

        /** \brief The whole file. Throws what SvgPlot::toSvg throws. */
        std::string toString() const;

        /** \brief Writes the file whole or not at all; throws parking::Error like writeFileAtomically. */
        void write(const std::string &file) const;

    private:
        std::string title_;
        std::string subtitle_;
        std::optional<SvgMap> map_;
        std::vector<SvgPlot> plots_;
    };
}  // namespace parking
