#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Polygon.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Colours with the same meaning in every figure of the project. */
    namespace svg_colour
    {
        constexpr const char *FORWARD = "#2563eb";        ///< forward motion
        constexpr const char *REVERSE = "#ea580c";        ///< reverse motion
        constexpr const char *START = "#334155";          ///< the car at its start
        constexpr const char *GOAL = "#059669";           ///< the car at its goal, and its slot
        constexpr const char *OBSTACLE = "#b4bdca";       ///< interior of an obstacle
        constexpr const char *OBSTACLE_EDGE = "#66717f";  ///< outline of an obstacle
        constexpr const char *OUTSIDE = "#e1e6ed";        ///< outside of the map or of the bounds of a polygon world

        /** \brief Unknown cells. Hue and lightness differ from all other grounds, also for red-green blind readers and
            in black and white prints. */
        constexpr const char *UNKNOWN = "#e3cf9b";

        /** \brief The driven track of a simulated car, beside the planned one. */
        constexpr const char *DRIVEN = "#be185d";
        constexpr const char *PLANNED = "#0f172a";  ///< the planned track, beside the driven one
    }                                               // namespace svg_colour

    /** \brief Style of a shape. Widths and dashes are in pixels. */
    struct SvgStyle
    {
        std::string fill{"none"};                 ///< SVG colour of the interior
        std::string stroke{"none"};               ///< SVG colour of the outline
        double strokeWidth{1.0};                  ///< width of the outline
        double fillOpacity{1.0};                  ///< opacity of the interior, 0 to 1
        double strokeOpacity{1.0};                ///< opacity of the outline, 0 to 1
        std::string dash;                         ///< SVG dash pattern, for example "6 4"; empty for a solid line
        std::map<std::string, std::string> data;  ///< attributes data-KEY for programs that read the file
    };

    /** \brief Layers of a map, from bottom to top. */
    enum class SvgLayer
    {
        Ground,     ///< unknown cells, the outside of the map, the slot
        Obstacles,  ///< polygons and occupied cells
        Sweep,      ///< footprints along a path
        Lines,      ///< paths
        Cars,       ///< outlines of the car at start and goals
        Marks       ///< texts and symbols
    };

    /** \brief Shape of the sample in a legend. */
    enum class SvgSample
    {
        Box,   ///< sample for areas and cars
        Line,  ///< sample for paths
        Dot    ///< sample for positions
    };

    /** \brief An entry of the legend: a sample of a style and its label. */
    struct SvgLegendEntry
    {
        std::string label;                 ///< plain text; the legend lists equal labels once
        SvgStyle style;                    ///< style of the sample
        SvgSample sample{SvgSample::Box};  ///< shape of the sample
    };

    /** \brief The map panel of a figure: shapes in metres, y up, at equal scale, with ticks at its frame.

        Coordinates are local ones of a scenario. The ticks show world coordinates, see setWorldOffset(). Shapes outside
        of the view are omitted. Each drawing function returns whether the shape is visible, so that legends can list
        visible shapes only. */
    class SvgMap
    {
    public:
        static constexpr double LEFT_OF_FRAME = 62.0;  ///< pixels for the ticks on the left of the panel
        static constexpr double BELOW_FRAME = 40.0;    ///< pixels for the ticks below the panel
        /** \brief A panel of \e width pixels that shows at least \e view, enlarged if necessary to a moderate aspect
            ratio.

            Throws parking::Error if the view is empty or not finite. */
        explicit SvgMap(const Box &view, double width = 912.0);

        /** \brief The visible area, in metres. */
        const Box &view() const
        {
            return view_;
        }

        /** \brief Width of the panel in pixels. */
        double width() const
        {
            return width_;
        }

        /** \brief Height of the panel in pixels. It follows from the view. */
        double height() const
        {
            return height_;
        }
        /** \brief Pixels per metre. */
        double scale() const
        {
            return scale_;
        }

        /** \brief Sets the world coordinates of the local origin, metres; 0, 0 by default.

            If world coordinates have too many digits for the ticks, an axis shows a round base once and the ticks show
            offsets from it. */
        void setWorldOffset(const Eigen::Vector2d &offset)
        {
            worldOffset_ = offset;
        }

        /** \brief Draws a closed shape. \return whether its interior is visible
            \param corners metres */
        bool drawPolygon(SvgLayer layer, const Polygon &corners, const SvgStyle &style);

        /** \brief Draws an open line. \return whether it is visible */
        bool drawLine(SvgLayer layer, const std::vector<Eigen::Vector2d> &points, const SvgStyle &style);

        /** \brief Draws a disc. \return whether it is visible
            \param radius pixels */
        bool drawDot(SvgLayer layer, const Eigen::Vector2d &centre, double radius, const SvgStyle &style);

        /** \brief Draws several closed outlines as one shape with holes (even-odd rule).

            A stroke is visible on the outer side only, so common edges of neighbouring outlines are not drawn.
            \param outlines corners in metres; a hole has the opposite orientation of the outline round it
            \return whether the interior is visible */
        bool drawOutlines(SvgLayer layer, const std::vector<Polygon> &outlines, const SvgStyle &style);

        /** \brief Adds an entry to the figure's legend. Equal labels are listed once, empty labels are omitted. */
        void addLegend(const SvgLegendEntry &entry);

        /** \brief The entries that addLegend() has added, in that order. */
        const std::vector<SvgLegendEntry> &legend() const
        {
            return legend_;
        }

        /** \brief The drawn shapes as SVG groups, one per layer, for panels with another frame. */
        std::string shapes() const;

        /** \brief A bar of a round length with its label, in the lower left corner. */
        std::string scaleBar() const;

        /** \brief The panel as an svg element with its upper left corner at \e x, \e y pixels, and its ticks. */
        std::string toSvg(double x, double y) const;

    private:
        Eigen::Vector2d toPixels(const Eigen::Vector2d &point) const;
        bool isVisible(const std::vector<Eigen::Vector2d> &points) const;
        /** Visible area of an outline in square pixels, negative for a clockwise one. */
        double visibleArea(const Polygon &outline) const;
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
