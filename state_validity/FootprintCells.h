#pragma once

#include "state_validity/FootprintChecker.h"

#include <array>
#include <cstdint>
#include <vector>

namespace parking
{
    /** \brief Where the body surely collides, for whole cells of places and headings at a time.

        The body's middle is somewhere in a square, its heading somewhere in a part of the circle; a cell is blocked
        when the body touches an obstacle at all of these. What a body of the cell covers in any case is at least the
        body at the cell's middle, made narrower and shorter by what its points move within the cell: when an obstacle
        reaches into a circle in that box, by the distance field, the cell is blocked. A yes is proven; a no says
        nothing. */
    class FootprintCells
    {
    public:
        static constexpr int MOST_HEADINGS = 128;  ///< parts of the circle at the most

        /** \brief A bit for each part of the circle, the first of which begins at a heading of minus pi. */
        using Headings = std::array<std::uint64_t, MOST_HEADINGS / 64>;

        /** \brief \param checker must outlive the cells
            \param side of the squares in metres, positive; their sides are parallel to the axes of the problem
            \param headings parts of the circle, from 8 to MOST_HEADINGS
            Throws parking::Error for others. */
        FootprintCells(const FootprintChecker &checker, double side, int headings);

        /** \brief The headings at which the cell is blocked whose square has the middle (x, y), in the coordinates of
            the problem. All are blocked for coordinates that are not finite. */
        Headings blocked(double x, double y) const;

    private:
        struct Circle
        {
            double offset;  // of its centre along the body from the body's middle
            double radius;
        };

        /** Circles inside of the box that all bodies of a cell with this heading cover. */
        struct Body
        {
            double cosine, sine;  // of the heading
            std::array<Circle, 6> circles;
        };

        bool isBlocked(const Body &body, double x, double y) const;

        const FootprintChecker &checker_;
        std::vector<Body> bodies_;
        bool cannotTell_{false};  // the cells are as wide as the body
        double circumradius_, inradius_;
    };
}  // namespace parking
