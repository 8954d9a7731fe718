#include "parking_geometry/drawing/SvgMap.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/drawing/SvgText.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double FLATTEST = 0.36;  ///< height of a panel as a part of its width
        constexpr double TALLEST = 1.0;

        Box widened(Box view)
        {
            if (!view.min.allFinite() || !view.max.allFinite() || !(view.size().minCoeff() > 0.0))
                throw Error("the view of a map panel is empty or not finite");
            const Eigen::Vector2d size = view.size(), middle = 0.5 * (view.min + view.max);
            const Eigen::Vector2d half(0.5 * std::max(size.x(), size.y() / TALLEST),
                                       0.5 * std::max(size.y(), size.x() * FLATTEST));
            return {middle - half, middle + half};
        }
    }  // namespace

    SvgMap::SvgMap(const Box &view, double width) : view_(widened(view)), width_(width)
    {
        const Eigen::Vector2d size = view_.size();
        scale_ = width_ / size.x();
        height_ = size.y() * scale_;
    }

    Eigen::Vector2d SvgMap::toPixels(const Eigen::Vector2d &point) const
    {
        return {(point.x() - view_.min.x()) * scale_, (view_.max.y() - point.y()) * scale_};
    }

    bool SvgMap::isVisible(const std::vector<Eigen::Vector2d> &points) const
    {
        if (points.empty())
            return false;
        Eigen::Vector2d low = points.front(), high = low;
        for (const Eigen::Vector2d &point : points)
        {
            low = low.cwiseMin(point);
            high = high.cwiseMax(point);
        }
        return (low.array() <= view_.max.array()).all() && (high.array() >= view_.min.array()).all();
    }

    std::string &SvgMap::layerText(SvgLayer layer)
    {
        return layers_[static_cast<std::size_t>(layer)];
    }

    void SvgMap::drawPolygon(SvgLayer layer, const Polygon &corners, const SvgStyle &style)
    {
        if (!isVisible(corners))
            return;
        std::string &text = layerText(layer);
        text += "<polygon points=\"";
        for (const Eigen::Vector2d &corner : corners)
        {
            const Eigen::Vector2d at = toPixels(corner);
            text += px(at.x()) + ',' + px(at.y()) + ' ';
        }
        text.back() = '"';
        text += attributes(style) + " stroke-linejoin=\"round\"/>\n";
    }

    void SvgMap::drawLine(SvgLayer layer, const std::vector<Eigen::Vector2d> &points, const SvgStyle &style)
    {
        if (!isVisible(points))
            return;
        std::string &text = layerText(layer);
        text += "<polyline points=\"";
        Eigen::Vector2d last(HUGE_VAL, HUGE_VAL);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const Eigen::Vector2d at = toPixels(points[i]);
            // Nobody sees a fifth of a pixel, and finely sampled paths would make large files.
            if ((at - last).lpNorm<Eigen::Infinity>() < 0.2 && i + 1 < points.size())
                continue;
            text += px(at.x()) + ',' + px(at.y()) + ' ';
            last = at;
        }
        text.back() = '"';
        text += attributes(style) + " stroke-linecap=\"round\" stroke-linejoin=\"round\"/>\n";
    }

    void SvgMap::drawDot(SvgLayer layer, const Eigen::Vector2d &centre, double radius, const SvgStyle &style)
    {
        if (!isVisible({centre}))
            return;
        const Eigen::Vector2d at = toPixels(centre);
        layerText(layer) += "<circle cx=\"" + px(at.x()) + "\" cy=\"" + px(at.y()) + "\" r=\"" + px(radius) + '"' +
                            attributes(style) + "/>\n";
    }

    void SvgMap::drawText(const Eigen::Vector2d &centre, const std::string &text, const std::string &colour)
    {
        if (!isVisible({centre}))
            return;
        const Eigen::Vector2d at = toPixels(centre);
        layerText(SvgLayer::Marks) +=
            textElement(at.x(), at.y() + 4.5, 13.0, colour, "middle", text,
                        " font-weight=\"600\" stroke=\"#ffffff\" stroke-width=\"3\" stroke-opacity=\"0.85\" "
                        "paint-order=\"stroke\" stroke-linejoin=\"round\"");
    }

    void SvgMap::drawOutlines(SvgLayer layer, const std::vector<Polygon> &outlines, const SvgStyle &style)
    {
        std::string data;
        for (const Polygon &outline : outlines)
        {
            if (!isVisible(outline))
                continue;
            std::string lastX, lastY;
            for (const Eigen::Vector2d &corner : outline)
            {
                const Eigen::Vector2d at = toPixels(corner);
                const std::string x = px(at.x()), y = px(at.y());
                if (lastX.empty())
                    data += 'M' + x + ' ' + y;
                else if (y == lastY)
                    data += 'H' + x;
                else if (x == lastX)
                    data += 'V' + y;
                else
                    data += 'L' + x + ' ' + y;
                lastX = x;
                lastY = y;
            }
            data += 'Z';
        }
        if (!data.empty())
            layerText(layer) += "<path d=\"" + data + "\" fill-rule=\"evenodd\"" + attributes(style) + "/>\n";
    }

    void SvgMap::addLegend(const SvgLegendEntry &entry)
    {
        const bool listed = std::any_of(legend_.begin(), legend_.end(),
                                        [&entry](const SvgLegendEntry &other) { return other.label == entry.label; });
        if (!listed)
            legend_.push_back(entry);
    }

    std::string SvgMap::gridLines() const
    {
        // Lines about every 60 to 150 pixels, at round metres of the local frame.
        const double step = roundStep(150.0 / scale_);
        std::string data;
        for (double x = std::ceil(view_.min.x() / step) * step; x <= view_.max.x(); x += step)
            data += 'M' + px(toPixels({x, 0.0}).x()) + " 0V" + px(height_);
        for (double y = std::ceil(view_.min.y() / step) * step; y <= view_.max.y(); y += step)
            data += "M0 " + px(toPixels({0.0, y}).y()) + 'H' + px(width_);
        return "<path d=\"" + data + "\" fill=\"none\" stroke=\"#e9edf2\"/>\n";
    }

    std::string SvgMap::scaleBar() const
    {
        const double length = roundStep(160.0 / scale_), pixels = length * scale_;
        const double x = 16.0, y = height_ - 18.0;
        const std::string label = tickLabel(length, length) + " m";
        return "<rect x=\"" + px(x - 8) + "\" y=\"" + px(y - 20) + "\" width=\"" + px(pixels + 16) +
               "\" height=\"30\" rx=\"4\" fill=\"#ffffff\" fill-opacity=\"0.85\"/>\n<path d=\"M" + px(x) + ' ' +
               px(y - 4) + 'V' + px(y + 3) + 'H' + px(x + pixels) + 'V' + px(y - 4) +
               "\" fill=\"none\" stroke=\"#334155\" stroke-width=\"1.5\"/>\n" +
               textElement(x + 0.5 * pixels, y - 3, 12.0, "#334155", "middle", label);
    }

    std::string SvgMap::toSvg(double x, double y) const
    {
        std::string text = "<svg x=\"" + px(x) + "\" y=\"" + px(y) + "\" width=\"" + px(width_) + "\" height=\"" +
                           px(height_) + "\" viewBox=\"0 0 " + px(width_) + ' ' + px(height_) +
                           "\" overflow=\"hidden\" data-left=\"" + formatNumber(view_.min.x()) + "\" data-top=\"" +
                           formatNumber(view_.max.y()) + "\" data-scale=\"" + formatNumber(scale_) +
                           "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fbfcfd\"/>\n" + gridLines();
        for (const std::string &layer : layers_)
            if (!layer.empty())
                text += "<g>\n" + layer + "</g>\n";
        text += scaleBar();
        text += "<rect x=\"0.5\" y=\"0.5\" width=\"" + px(width_ - 1) + "\" height=\"" + px(height_ - 1) +
                "\" fill=\"none\" stroke=\"#cbd5e1\"/>\n</svg>\n";
        return text;
    }
}  // namespace parking
