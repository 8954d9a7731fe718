#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Vehicle.h"

#include <cstdint>

namespace parking::search
{
    /** \brief In the place of a number of cusps: any number. */
    constexpr std::uint8_t ANY_CUSPS = 255;

    /** \brief What the search has to know of the car and the space beyond the parameters. Lengths in metres. */
    struct CarInSpace
    {
        double turningRadius{3.0};    ///< of the rear axle
        bool forwardOnly{false};      ///< never drive in reverse (Dubins)
        double inscribedRadius{0.0};  ///< no obstacle can be nearer to the rear axle than this; 0: unknown
        Box bounds;                   ///< of the rear axle's positions
        /** Changes of direction that a path may have. Improving adds some where they are worth their cost. */
        std::uint8_t maxCusps{ANY_CUSPS};
        /** Of the largest disc within the car wherever its centre is: how wide a gap must be. Guides the search and
            sizes the cells of proofs; 0: as inscribedRadius. */
        double bodyRadius{0.0};
        double turningLane{0.0};   ///< width of the lane covered at full lock. Guides the search; 0: unknown
        double centreOffset{0.0};  ///< of the body's middle ahead of the rear axle
    };

    /** \brief A vehicle that keeps \e margin metres to all sides, at its sharpest turn. */
    CarInSpace carInSpace(const Vehicle &vehicle, double margin, const Box &bounds);
}  // namespace parking::search
