#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Vehicle.h"

#include <cstdint>

namespace parking::search
{
    /** \brief Any number of cusps. */
    constexpr std::uint8_t ANY_CUSPS = 255;

    /** \brief Properties of car and space that the search needs besides the parameters. Lengths in metres. */
    struct CarInSpace
    {
        double turningRadius{3.0};    ///< of the rear axle
        bool forwardOnly{false};      ///< never drive in reverse (Dubins)
        double inscribedRadius{0.0};  ///< no obstacle can be nearer to the rear axle than this; 0: unknown
        Box bounds;                   ///< of the rear axle's positions
        /** Maximum number of cusps of a path found by the search. Improvement may add cusps that lower the cost. */
        std::uint8_t maxCusps{ANY_CUSPS};
        /** Radius of the largest disc within the car: half the width of the narrowest passable gap. Guides the search
            and sizes the cells of proofs; 0: inscribedRadius. */
        double bodyRadius{0.0};
        double turningLane{0.0};   ///< width of the lane covered at full lock. Guides the search; 0: unknown
        double centreOffset{0.0};  ///< of the body's middle ahead of the rear axle
    };

    /** \brief Properties of a vehicle enlarged by \e margin metres on all sides, at its smallest turning radius. */
    CarInSpace carInSpace(const Vehicle &vehicle, double margin, const Box &bounds);
}  // namespace parking::search
