#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace parking
{
    /** \brief A Reeds-Shepp curve: up to five pieces, each an arc at the turning radius or a line.

        A search evaluates thousands of curves. Unlike a Path, a curve has a fixed size, allocates no memory and has no
        start. */
    struct ReedsSheppCurve
    {
        std::array<Arc, 5> pieces{};  ///< pieces in driving order, of which the first \e count are used
        std::size_t count{0};         ///< number of pieces; 0 from a pose to itself and if there is no curve
        double length{std::numeric_limits<double>::infinity()};  ///< metres; both directions count as positive

        /** \brief Number of changes between forwards and reverse. */
        std::size_t cusps() const;
    };

    /** \brief Family of curves. */
    enum class CurveFamily
    {
        ReedsShepp,  ///< forwards and reverse
        Dubins       ///< forwards only
    };

    /** \brief Shortest curves of bounded curvature between two poses.

        The words and formulas are from J. A. Reeds and L. A. Shepp, "Optimal paths for a car that goes both forwards
        and backwards", Pacific Journal of Mathematics 145(2), 1990 (equations 8.1 to 8.11), and from L. E. Dubins, "On
        curves of minimal length with a constraint on average curvature", 1957.

        Among obstacles a longer curve is often the shortest free one, so candidates() returns all words. The class
        allocates no memory except when the caller's vector grows. */
    class ReedsShepp
    {
    public:
        /** \brief Curves of this radius. Throws parking::Error unless \e turningRadius (metres) is positive and
            finite. */
        explicit ReedsShepp(double turningRadius, CurveFamily family = CurveFamily::ReedsShepp);

        /** \brief Radius of all arcs in metres. */
        double turningRadius() const
        {
            return radius_;
        }

        /** \brief Family of the curves. */
        CurveFamily family() const
        {
            return family_;
        }

        /** \brief Length of the shortest curve in metres. */
        double distance(const Pose &from, const Pose &to) const;

        /** \brief The shortest curve. */
        ReedsSheppCurve shortest(const Pose &from, const Pose &to) const;

        /** \brief Writes every word that joins the poses into \e curves, sorted by length.

            \param maxLength length in metres above which words are omitted */
        void candidates(const Pose &from, const Pose &to, std::vector<ReedsSheppCurve> &curves,
                        double maxLength = std::numeric_limits<double>::infinity()) const;

    private:
        double radius_;
        CurveFamily family_;
    };
}  // namespace parking
