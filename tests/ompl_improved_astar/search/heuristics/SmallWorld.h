#pragma once

#include "ompl_improved_astar/search/heuristics/ObstacleHeuristic.h"
#include "tests/ompl_improved_astar/search/DiscCarWorld.h"

#include <cstdint>

#include <Eigen/Core>

namespace parking_test
{
    /** \brief A world whose outside is closed to discs of at least 1.5 cells. */
    inline DiscCarWorld smallWorld(std::uint64_t seed)
    {
        Random random(seed);
        DiscCarWorld world({{-6.0, -6.0}, {6.0, 6.0}});
        for (int i = 0; i < 8; ++i)
        {
            const double x = random.between(-6.0, 6.0), y = random.between(-6.0, 6.0);
            const double w = random.between(0.05, 1.5), h = random.between(0.05, 1.5);
            world.boxes.push_back({{x - w, y - h}, {x + w, y + h}});
        }
        return world;
    }

    /** \brief A point in it. */
    inline Eigen::Vector2d anywhere(Random &random)
    {
        const double x = random.between(-6.0, 6.0);
        return {x, random.between(-6.0, 6.0)};
    }

    /** \brief The heuristic, set up as it is made. */
    class HeuristicIn : public parking::search::ObstacleHeuristic
    {
    public:
        HeuristicIn(DiscCarWorld &world, double resolution, const parking::search::Disc &disc,
                    const Eigen::Vector2d &toward)
        {
            reset(world, resolution, disc, toward, stop);
        }

        parking::search::StopFunction stop;
    };
}  // namespace parking_test
