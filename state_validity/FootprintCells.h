#pragma once

#include "state_validity/FootprintChecker.h"

#include <array>
#include <cstdint>
#include <vector>

namespace parking
{
    /** \brief Proves collisions of the body for whole cells of positions and headings.

        A cell is a square of positions of the body's centre and an interval of headings. It is blocked if the body
        touches an obstacle at each of its poses.

        All bodies of a cell cover a common box: the body at the cell's centre, reduced by the motion of its points
        within the cell. The cell is blocked if, by the distance field, an obstacle reaches into a circle in this box. A
        cell that is not reported as blocked may still be blocked.

        For an outline the circles lie in the body and are reduced by the motion of their centres. The body's centre is
        that of the bounding rectangle. */
    class FootprintCells
    {
    public:
        static constexpr int MAX_HEADINGS = 128;  ///< largest number of heading intervals

        /** \brief One bit per heading interval. The first interval begins at -pi. */
        using Headings = std::array<std::uint64_t, MAX_HEADINGS / 64>;

        /** \brief Cells for the body of \e checker.

            \param checker must outlive this object
            \param side side of the squares in metres, positive; the squares are parallel to the axes of the problem
            \param headings number of heading intervals, from 8 to MAX_HEADINGS
            Throws parking::Error for other values. */
        FootprintCells(const FootprintChecker &checker, double side, int headings);

        /** \brief The blocked heading intervals of the cell whose square has its centre at (x, y), in the coordinates
            of the problem. If a coordinate is not finite, all are blocked. */
        Headings blocked(double x, double y) const;

    private:
        struct Circle
        {
            double offset;  // of its centre from the body's centre, along the body
            double radius;
        };

        /** Circles inside of all bodies of a cell with this heading interval. */
        struct Heading
        {
            double cosine, sine;  // of the heading
            std::array<Circle, 6> circles;
        };

        bool isBlocked(const Heading &body, double x, double y) const;

        const FootprintChecker &checker_;
        std::vector<Heading> bodies_;
        bool cannotTell_{false};  // the cells are as wide as the body: none is blocked
        double circumradius_, inradius_;
    };
}  // namespace parking
