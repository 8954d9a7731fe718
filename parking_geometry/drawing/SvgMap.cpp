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
        constexpr double MIN_HEIGHT = 0.36;  ///< smallest height of a panel as a share of its width
        constexpr double TALLEST = 1.0;
        constexpr double SEEN = 0.5;  ///< smallest visible area in square pixels

        Box widened(const Box &view)
        {
            if (!view.min.allFinite() || !view.max.allFinite() || !(view.size().minCoeff() > 0.0))
                throw Error("the view of a map panel is empty or not finite");
            const Eigen::Vector2d size = view.size(), middle = 0.5 * (view.min + view.max);
            const Eigen::Vector2d half(0.5 * std::max(size.x(), size.y() / TALLEST),
                                       0.5 * std::max(size.y(), size.x() * MIN_HEIGHT));
            return {middle - half, middle + half};
        }

        /** The part of an outline on which a coordinate is at least (\e sign 1) or at most (\e sign -1) \e limit. */
        Polygon cut(const Polygon &outline, Eigen::Index axis, double sign, double limit)
        {
            Polygon result;
            for (std::size_t i = 0; i < outline.size(); ++i)
            {
                const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
                const double in = sign * (a[axis] - limit), next = sign * (b[axis] - limit);
                if (in >= 0.0)
                    result.push_back(a);
                if ((in < 0.0) != (next < 0.0))
                    result.emplace_back(a + in / (in - next) * (b - a));
            }
            return result;
        }

        /** The ticks of one axis: round world coordinates, their local positions and their labels. */
        struct WorldAxis
        {
            /** \param begin,end local \param offset of the local origin in the world */
            WorldAxis(double begin, double end, double offset, double spacing) : step(spacing)
            {
                const auto label = [&](double tick)
                {
                    return tickLabel(tick - base, step);
                };
                if (std::max(label(begin + offset).size(), label(end + offset).size()) > MAX_CHARACTERS)
                {
                    const double unit = std::pow(10.0, std::max(3.0, std::ceil(std::log10(end - begin))));
                    base = std::floor((begin + offset) / unit) * unit;
                }
                // Offsets from the base are small, so far worlds lose no digits.
                const double shift = offset - base;
                for (const double tick : roundTicks(begin + shift, end + shift, step))
                    ticks.emplace_back(tick - shift, tickLabel(tick, step));
            }

            std::string title(const std::string &name) const
            {
                if (base == 0.0)
                    return name + " (m)";
                return name + (base < 0.0 ? " + " : " - ") + formatNumber(std::abs(base), 0) + " (m)";
            }

            static constexpr std::size_t MAX_CHARACTERS = 6;  ///< longest label; ticks are at least 60 pixels apart

            double step;
            double base{0.0};
            std::vector<std::pair<double, std::string>> ticks;
        };
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

    double SvgMap::visibleArea(const Polygon &outline) const
    {
        Polygon part = outline;
        for (const Eigen::Index axis : {0, 1})
            part = cut(cut(part, axis, 1.0, view_.min[axis]), axis, -1.0, view_.max[axis]);
        return part.size() < 3 ? 0.0 : signedArea(part) * scale_ * scale_;
    }

    std::string &SvgMap::layerText(SvgLayer layer)
    {
        return layers_[static_cast<std::size_t>(layer)];
    }

    bool SvgMap::drawPolygon(SvgLayer layer, const Polygon &corners, const SvgStyle &style)
    {
        if (!isVisible(corners))
            return false;
        std::string &text = layerText(layer);
        text += "<polygon points=\"";
        for (const Eigen::Vector2d &corner : corners)
        {
            const Eigen::Vector2d at = toPixels(corner);
            text += px(at.x()) + ',' + px(at.y()) + ' ';
        }
        text.back() = '"';
        text += attributes(style) + " stroke-linejoin=\"round\"/>\n";
        return std::abs(visibleArea(corners)) > SEEN;
    }

    bool SvgMap::drawLine(SvgLayer layer, const std::vector<Eigen::Vector2d> &points, const SvgStyle &style)
    {
        if (!isVisible(points))
            return false;
        std::string &text = layerText(layer);
        text += "<polyline points=\"";
        Eigen::Vector2d last(HUGE_VAL, HUGE_VAL);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const Eigen::Vector2d at = toPixels(points[i]);
            // A fifth of a pixel is invisible, and finely sampled paths would result in large files.
            if ((at - last).lpNorm<Eigen::Infinity>() < 0.2 && i + 1 < points.size())
                continue;
            text += px(at.x()) + ',' + px(at.y()) + ' ';
            last = at;
        }
        text.back() = '"';
        text += attributes(style) + " stroke-linecap=\"round\" stroke-linejoin=\"round\"/>\n";
        return true;
    }

    bool SvgMap::drawDot(SvgLayer layer, const Eigen::Vector2d &centre, double radius, const SvgStyle &style)
    {
        if (!isVisible({centre}))
            return false;
        const Eigen::Vector2d at = toPixels(centre);
        layerText(layer) += "<circle cx=\"" + px(at.x()) + "\" cy=\"" + px(at.y()) + "\" r=\"" + px(radius) + '"' +
                            attributes(style) + "/>\n";
        return true;
    }

    bool SvgMap::drawOutlines(SvgLayer layer, const std::vector<Polygon> &outlines, const SvgStyle &style)
    {
        std::string data;
        double area = 0.0;
        for (const Polygon &outline : outlines)
        {
            if (!isVisible(outline))
                continue;
            area += visibleArea(outline);
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
            layerText(layer) +=
                "<path d=\"" + data + "\" fill-rule=\"evenodd\" paint-order=\"stroke\"" + attributes(style) + "/>\n";
        return std::abs(area) > SEEN;
    }

    void SvgMap::addLegend(const SvgLegendEntry &entry)
    {
        addToLegend(legend_, entry);
    }

    std::string SvgMap::shapes() const
    {
        std::string text;
        for (const std::string &layer : layers_)
            if (!layer.empty())
                text += "<g>\n" + layer + "</g>\n";
        return text;
    }

    std::string SvgMap::scaleBar() const
    {
        const double length = roundStep(std::min(160.0, 0.25 * width_) / scale_), pixels = length * scale_;
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
        constexpr const char *FAINT = "#64748b";
        constexpr double SIZE = 12.0, MARK = 4.0;
        // Lines about every 60 to 150 pixels.
        const double step = roundStep(150.0 / scale_);
        const WorldAxis across(view_.min.x(), view_.max.x(), worldOffset_.x(), step);
        const WorldAxis upwards(view_.min.y(), view_.max.y(), worldOffset_.y(), step);
        const double bottom = y + height_;
        std::string lines, marks, labels;
        for (const auto &[at, label] : across.ticks)
        {
            const double place = toPixels({at, 0.0}).x();
            lines += 'M' + px(place) + " 0V" + px(height_);
            marks += 'M' + px(x + place) + ' ' + px(bottom) + 'v' + px(MARK);
            labels += textElement(x + place, bottom + 17.0, SIZE, FAINT, "middle", label);
        }
        for (const auto &[at, label] : upwards.ticks)
        {
            const double place = toPixels({0.0, at}).y();
            lines += "M0 " + px(place) + 'H' + px(width_);
            marks += 'M' + px(x) + ' ' + px(y + place) + 'h' + px(-MARK);
            labels += textElement(x - 8.0, y + place + 4.0, SIZE, FAINT, "end", label);
        }
        const double left = x - LEFT_OF_FRAME + 14.0, middle = y + 0.5 * height_;
        labels += textElement(x + 0.5 * width_, bottom + 34.0, SIZE, FAINT, "middle", across.title("x"));
        labels += textElement(left, middle, SIZE, FAINT, "middle", upwards.title("y"),
                              " transform=\"rotate(-90 " + px(left) + ' ' + px(middle) + ")\"");

        std::string text =
            "<svg x=\"" + px(x) + "\" y=\"" + px(y) + "\" width=\"" + px(width_) + "\" height=\"" + px(height_) +
            "\" viewBox=\"0 0 " + px(width_) + ' ' + px(height_) +
            "\" overflow=\"hidden\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fbfcfd\"/>\n<path d=\"" + lines +
            "\" fill=\"none\" stroke=\"#e9edf2\"/>\n";
        text += shapes() + scaleBar();
        text += "<rect x=\"0.5\" y=\"0.5\" width=\"" + px(width_ - 1) + "\" height=\"" + px(height_ - 1) +
                "\" fill=\"none\" stroke=\"#cbd5e1\"/>\n</svg>\n";
        return text + "<path d=\"" + marks + "\" fill=\"none\" stroke=\"#cbd5e1\"/>\n" + labels;
    }
}  // namespace parking
