#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Polygon.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Colours that mean the same in every figure of the project. */
    namespace svg_colour
    {
        constexpr const char *FORWARD = "#2563eb";        ///< driven forwards
        constexpr const char *REVERSE = "#ea580c";        ///< driven in reverse
        constexpr const char *START = "#334155";          ///< the car where it stands
        constexpr const char *GOAL = "#059669";           ///< the car at its goal, and its slot
        constexpr const char *OBSTACLE = "#b4bdca";       ///< inside of an obstacle
        constexpr const char *OBSTACLE_EDGE = "#66717f";  ///< outline of an obstacle
        constexpr const char *OUTSIDE = "#e1e6ed";        ///< beyond the end of the map, or of a world of polygons

        /** \brief Cells of which nothing is known: of another hue than all other grounds, on the axis that the
            red-green blind see too, and of another lightness, which is all that a print in black and white has. */
        constexpr const char *UNKNOWN = "#e3cf9b";

        /** \brief What a simulated car drove, where it stands beside what was planned. */
        constexpr const char *DRIVEN = "#be185d";
        constexpr const char *PLANNED = "#0f172a";  ///< what was planned, beside what came of it
    }                                               // namespace svg_colour

    /** \brief How a shape is drawn. Widths and dashes in pixels. */
    struct SvgStyle
    {
        std::string fill{"none"};                 ///< colour of the inside as in SVG
        std::string stroke{"none"};               ///< colour of the outline as in SVG
        double strokeWidth{1.0};                  ///< of the outline
        double fillOpacity{1.0};                  ///< 0 (invisible) to 1
        double strokeOpacity{1.0};                ///< 0 (invisible) to 1
        std::string dash;                         ///< for example "6 4"; empty: solid
        std::map<std::string, std::string> data;  ///< attributes data-KEY, for programs that read the picture
    };

    /** \brief What lies above what on a map. */
    enum class SvgLayer
    {
        Ground,     ///< lowest: unknown cells, the outside of the map, the slot
        Obstacles,  ///< polygons and occupied cells
        Sweep,      ///< footprints along a path
        Lines,      ///< paths
        Cars,       ///< outlines of the car at start and goals
        Marks       ///< texts and symbols
    };

    /** \brief What the sample of a legend looks like. */
    enum class SvgSample
    {
        Box,   ///< for areas and cars
        Line,  ///< for paths
        Dot    ///< for places
    };

    /** \brief An entry of the legend: a sample of the style beside its meaning. */
    struct SvgLegendEntry
    {
        std::string label;                 ///< plain text; listed once
        SvgStyle style;                    ///< of the sample
        SvgSample sample{SvgSample::Box};  ///< its shape
    };

    /** \brief The map panel of a figure: shapes in metres, y up, at equal scale, with ticks at its frame.

        Coordinates are local ones of a scenario; the ticks are labelled with those of the world, see
        setWorldOffset(). Shapes that lie outside of the view are left out; what draws a shape tells whether it can be
        seen, so that legends name only that. */
    class SvgMap
    {
    public:
        static constexpr double LEFT_OF_FRAME = 62.0;  ///< pixels on the left of the panel that its ticks take
        static constexpr double BELOW_FRAME = 40.0;    ///< and below
        /** \brief A panel \e width pixels wide that shows at least \e view: the shorter side is widened until the panel
            is neither a strip nor a tower.

            Throws parking::Error when the view is empty or not finite. */
        explicit SvgMap(const Box &view, double width = 912.0);

        /** \brief What is shown, in metres. */
        const Box &view() const
        {
            return view_;
        }

        /** \brief Pixels across the panel. */
        double width() const
        {
            return width_;
        }

        /** \brief Pixels down the panel; follows from the view. */
        double height() const
        {
            return height_;
        }
        /** \brief Pixels per metre. */
        double scale() const
        {
            return scale_;
        }

        /** \brief Where the local origin lies in the world, metres; without it the local coordinates are the world's.

            At coordinates of more digits than can be read at a tick, an axis names a round number once and its ticks
            what has to be added to it. */
        void setWorldOffset(const Eigen::Vector2d &offset)
        {
            worldOffset_ = offset;
        }

        /** \brief A closed shape. \param corners metres \return can its inside be seen? */
        bool drawPolygon(SvgLayer layer, const Polygon &corners, const SvgStyle &style);

        /** \brief An open line. \return can it be seen? */
        bool drawLine(SvgLayer layer, const std::vector<Eigen::Vector2d> &points, const SvgStyle &style);

        /** \brief A disc. \param radius pixels \return can it be seen? */
        bool drawDot(SvgLayer layer, const Eigen::Vector2d &centre, double radius, const SvgStyle &style);

        /** \brief Several closed outlines as one shape, where holes stay open (even-odd rule). What outlines of
           neighbours have in common is not drawn: a stroke shows on the outer side only.

            \param outlines holes run the other way round than what they are in \return can its inside be seen? */
        bool drawOutlines(SvgLayer layer, const std::vector<Polygon> &outlines, const SvgStyle &style);

        /** \brief Explains a style in the figure's legend; the same label is listed once, an empty one never. */
        void addLegend(const SvgLegendEntry &entry);

        /** \brief What addLegend() was told, in that order. */
        const std::vector<SvgLegendEntry> &legend() const
        {
            return legend_;
        }

        /** \brief The panel as an svg element whose upper left corner is at \e x, \e y pixels, and its ticks beside it.
         */
        std::string toSvg(double x, double y) const;

    private:
        Eigen::Vector2d toPixels(const Eigen::Vector2d &point) const;
        bool isVisible(const std::vector<Eigen::Vector2d> &points) const;
        /** Pixels of an outline's inside that lie in the view; negative for one that runs clockwise. */
        double visibleArea(const Polygon &outline) const;
        std::string scaleBar() const;
        std::string &layerText(SvgLayer layer);

        Box view_;
        double width_;
        double height_{0.0};
        double scale_{1.0};
        Eigen::Vector2d worldOffset_{0.0, 0.0};
        std::array<std::string, 6> layers_;
        std::vector<SvgLegendEntry> legend_;
    };
}  // namespace parking
