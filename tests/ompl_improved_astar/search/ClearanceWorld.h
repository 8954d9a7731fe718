#pragma once

#include "tests/ompl_improved_astar/search/DiscCarWorld.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace parking_test
{
    /** \brief A world that knows how far motions keep a clearance, by conservative advancement. */
    class ClearanceWorld : public DiscCarWorld
    {
    public:
        explicit ClearanceWorld(const DiscCarWorld &world) : DiscCarWorld(world)
        {
        }

        void clearLengths(const parking::Pose &from, const parking::Arc *arcs, std::size_t count, double clearance,
                          double *clear) override
        {
            for (std::size_t i = 0; i < count; ++i)
            {
                const auto &[curvature, length] = arcs[i];
                const double whole = std::abs(length);
                const double farthest = *std::max_element(offsets.begin(), offsets.end());
                const double speed = std::hypot(1.0, farthest * curvature);
                double driven = 0.0, last = 0.0;
                while (driven < whole)
                {
                    const double room = gap(advance(from, curvature, std::copysign(driven, length))) - clearance;
                    if (room < 1e-4)
                        break;
                    last = driven;
                    driven += room / speed;
                }
                const bool keepsAll = driven >= whole && gap(advance(from, curvature, length)) >= clearance;
                clear[i] = keepsAll ? whole : std::min(last, whole);
            }
        }
    };
}  // namespace parking_test
