#pragma once

#include "parking_geometry/curves/ReedsShepp.h"
#include "tests/ompl_improved_astar/search/DiscCarWorld.h"

#include <cstddef>
#include <vector>

namespace parking_test
{
    /** \brief The shortest free curve between two poses, as whoever cares for nothing but length would drive; without
        pieces where none is free. */
    inline parking::Path shortestFree(const DiscCarWorld &world, const parking::ReedsShepp &curves,
                                      const parking::Pose &from, const parking::Pose &to)
    {
        std::vector<parking::ReedsSheppCurve> candidates;
        curves.candidates(from, to, candidates);
        for (const parking::ReedsSheppCurve &curve : candidates)
        {
            parking::Path path{from, {}};
            for (std::size_t k = 0; k < curve.count; ++k)
                path.append(curve.pieces[k]);
            if (faultOf(path, world, {from}, {path.end()}, curves.turningRadius()).empty())
                return path;
        }
        return {from, {}};
    }
}  // namespace parking_test
