#include "state_validity/FootprintCells.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace parking
{
    namespace
    {
        // Margin of the size of cells for rounding within a few kilometres of the frame.
        constexpr double HAIR = 1e-9;

        /** Largest displacement of a point of the body along either of its axes for all positions in the cell. */
        double shiftIn(double side, double yaw, double halfTurn)
        {
            const double diagonal = std::sqrt(2.0);
            const double along =
                std::min(diagonal, std::abs(std::cos(yaw)) + std::abs(std::sin(yaw)) + diagonal * halfTurn);
            return 0.5 * side * along + HAIR;
        }
    }  // namespace

    FootprintCells::FootprintCells(const FootprintChecker &checker, double side, int headings) : checker_(checker)
    {
        Require("cells of footprints").positive("side", side, "metres");
        if (headings < 8 || headings > MAX_HEADINGS)
            throw Error("cells of footprints need 8 to " + std::to_string(MAX_HEADINGS) + " headings, not " +
                        std::to_string(headings));
        const bool isRectangle = checker.body().pieces.empty();
        const double halfLength = checker.body().halfLength, halfWidth = checker.body().halfWidth;
        const double halfTurn = PI / headings + HAIR, sine = std::sin(halfTurn);
        circumradius_ = inradius_ = 0.0;
        for (int i = 0; i < headings; ++i)
        {
            const double yaw = 2.0 * PI * (i + 0.5) / headings - PI;
            // For a body at another pose of the cell, a point of the box is displaced along the body's axes and turned
            // about its centre.
            const double shift = shiftIn(side, yaw, halfTurn);
            const double length = isRectangle ? halfLength - shift - halfWidth * sine : halfLength;
            const double width = halfWidth - shift - halfLength * sine;
            cannotTell_ = cannotTell_ || (isRectangle && (length <= 0.0 || width <= 0.0));
            const double local = yaw - checker.obstacles().frame().yaw;
            Heading body{std::cos(local), std::sin(local), {}};
            // The radius of the largest common circle: that in a smaller rectangle, or a circle in the outline less the
            // displacement of its centre.
            const auto radiusAt = [&](double offset)
            {
                return isRectangle ? std::min(width, length - std::abs(offset))
                                   : checker.body().depthAt(offset) - std::hypot(0.5, 0.5) * side -
                                         std::abs(offset) * sine / std::cos(0.5 * halfTurn);
            };
            const double half = length / static_cast<double>(body.circles.size());
            for (std::size_t k = 0; k < body.circles.size(); ++k)
            {
                const double offset = half * static_cast<double>(2 * k + 1) - length;
                body.circles[k] = {offset, radiusAt(offset) - HAIR};
            }
            bodies_.push_back(body);
            circumradius_ = std::max(circumradius_, std::hypot(length, isRectangle ? width : halfWidth) + HAIR);
            inradius_ = i == 0 ? radiusAt(0.0) : std::min(inradius_, radiusAt(0.0));
        }
        inradius_ -= HAIR;
    }

    bool FootprintCells::isBlocked(const Heading &body, double x, double y) const
    {
        const DistanceField &field = checker_.field();
        return std::any_of(body.circles.begin(), body.circles.end(),
                           [&](const Circle &circle)
                           {
                               const double cx = x + body.cosine * circle.offset, cy = y + body.sine * circle.offset;
                               return field.upperBound(cx, cy) < circle.radius;
                           });
    }

    FootprintCells::Headings FootprintCells::blocked(double x, double y) const
    {
        Headings bits{};
        if (cannotTell_)
            return bits;
        const Pose local = checker_.obstacles().toLocal({x, y, 0.0});
        const bool anywhere = !isFinite(local) || checker_.field().upperBound(local.x, local.y) < inradius_;
        if (!anywhere && checker_.field().lowerBound(local.x, local.y) > circumradius_)
            return bits;
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            if (anywhere || isBlocked(bodies_[i], local.x, local.y))
                bits[i / 64] |= std::uint64_t{1} << (i % 64);
        return bits;
    }
}  // namespace parking
