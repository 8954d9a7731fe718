#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace parking
{
    /** \brief A Reeds-Shepp curve: up to five arcs at the turning radius or lines.

        Not a Path because a search tries thousands of them: its size is fixed, so nothing is allocated, and it has no
        start of its own. */
    struct ReedsSheppCurve
    {
        std::array<Arc, 5> pieces{};  ///< the first \e count of them are driven, in this order
        std::size_t count{0};         ///< how many pieces; 0 from a pose to itself, and where there is no curve
        double length{std::numeric_limits<double>::infinity()};  ///< metres, both directions counted positive

        /** \brief Number of changes between forwards and reverse. */
        std::size_t cusps() const;
    };

    /** \brief Which curves to consider. */
    enum class CurveFamily
    {
        ReedsShepp,  ///< forwards and reverse
        Dubins       ///< forwards only
    };

    /** \brief Shortest curves of bounded curvature between two poses.

        The words and their formulas are those of J. A. Reeds and L. A. Shepp, "Optimal paths for a car that goes both
        forwards and backwards", Pacific Journal of Mathematics 145(2), 1990 (equations 8.1 to 8.11), and of L. E.
        Dubins, "On curves of minimal length with a constraint on average curvature", 1957. Unlike a solver that returns
        the shortest curve only, candidates() returns all of them: among obstacles the second or tenth best is often the
        one that is free. No allocation but the growth of the caller's vector. */
    class ReedsShepp
    {
    public:
        /** \brief \param turningRadius metres, positive and finite (otherwise parking::Error). */
        explicit ReedsShepp(double turningRadius, CurveFamily family = CurveFamily::ReedsShepp);

        /** \brief Radius of all arcs in metres. */
        double turningRadius() const
        {
            return radius_;
        }

        /** \brief Which curves are considered. */
        CurveFamily family() const
        {
            return family_;
        }

        /** \brief Length of the shortest curve in metres. */
        double distance(const Pose &from, const Pose &to) const;

        /** \brief The shortest curve. */
        ReedsSheppCurve shortest(const Pose &from, const Pose &to) const;

        /** \brief Every word that joins the poses, in the order of length; \e curves is overwritten.

            \param longest words longer than this many metres are left out */
        void candidates(const Pose &from, const Pose &to, std::vector<ReedsSheppCurve> &curves,
                        double longest = std::numeric_limits<double>::infinity()) const;

    private:
        double radius_;
        CurveFamily family_;
    };
}  // namespace parking
