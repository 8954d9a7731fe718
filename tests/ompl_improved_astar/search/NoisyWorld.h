#pragma once

#include "tests/ompl_improved_astar/search/DiscCarWorld.h"

#include <cmath>

namespace parking_test
{
    /** \brief A world where what is close changes from millimetre to millimetre: no two ways to cut a path agree on
       what it costs. */
    class NoisyWorld : public DiscCarWorld
    {
    public:
        using DiscCarWorld::DiscCarWorld;

        bool keeps(const parking::Pose &pose, double /*clearance*/) override
        {
            return std::fmod(std::abs(1e3 * pose.x + 777.0 * pose.y), 2.0) < 1.0;
        }

        double clearance(const parking::Pose &pose) override
        {
            return keeps(pose, 0.0) ? 0.6 : 0.15;
        }
    };
}  // namespace parking_test
