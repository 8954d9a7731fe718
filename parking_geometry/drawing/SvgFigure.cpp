#include "parking_geometry/drawing/SvgFigure.h"

#include "parking_geometry/drawing/SvgText.h"
#include "parking_geometry/text/WriteFile.h"

#include <utility>

namespace parking
{
    namespace
    {
        constexpr double MARGIN = 24.0;
        constexpr double PANEL_WIDTH = 912.0;

        /** The legend in rows from \e y downwards. Moves \e y below the legend. */
        std::string legendRows(const std::vector<SvgLegendEntry> &entries, double width, double &y)
        {
            constexpr double SIZE = 12.5, ROW = 20.0;
            std::string text;
            double x = MARGIN;
            for (const SvgLegendEntry &entry : entries)
            {
                const double space = SAMPLE_WIDTH + 6.0 + textWidth(entry.label, SIZE) + 20.0;
                if (x > MARGIN && x + space - 20.0 > MARGIN + width)
                {
                    x = MARGIN;
                    y += ROW;
                }
                text += legendSample(entry, x, y);
                text += textElement(x + SAMPLE_WIDTH + 6.0, y + 12.5, SIZE, "#334155", "start", entry.label);
                x += space;
            }
            y += ROW + 6.0;
            return text;
        }
    }  // namespace

    SvgFigure::SvgFigure(std::string title, std::string subtitle)
      : title_(std::move(title)),
        subtitle_(std::move(subtitle))
    {
    }

    void SvgFigure::setMap(const SvgMap &map)
    {
        map_ = map;
    }

    void SvgFigure::addPlot(const SvgPlot &plot)
    {
        plots_.push_back(plot);
    }

    std::string SvgFigure::toString() const
    {
        const double panel = map_ ? SvgMap::LEFT_OF_FRAME + map_->width() : PANEL_WIDTH;
        std::string body;
        double y = MARGIN;
        if (!title_.empty())
        {
            body += textElement(MARGIN, y + 14.0, 19.0, "#0f172a", "start", title_, " font-weight=\"600\"");
            y += 24.0;
        }
        if (!subtitle_.empty())
        {
            body += textElement(MARGIN, y + 12.0, 13.0, "#64748b", "start", subtitle_);
            y += 22.0;
        }
        if (!title_.empty() || !subtitle_.empty())
            y += 6.0;
        if (map_)
        {
            if (!map_->legend().empty())
                body += legendRows(map_->legend(), panel, y);
            body += map_->toSvg(MARGIN + SvgMap::LEFT_OF_FRAME, y);
            y += map_->height() + SvgMap::BELOW_FRAME + 8.0;
        }
        for (const SvgPlot &plot : plots_)
        {
            body += plot.toSvg(MARGIN, y, panel);
            y += plot.height + 8.0;
        }
        y += MARGIN - 8.0;
        const std::string width = px(panel + 2.0 * MARGIN), height = px(y);
        return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
               "\" viewBox=\"0 0 " + width + ' ' + height +
               "\" font-family=\"Inter, 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif\">\n"
               "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" +
               body + "</svg>\n";
    }

    void SvgFigure::write(const std::string &file) const
    {
        writeFileAtomically(file, toString());
    }
}  // namespace parking
