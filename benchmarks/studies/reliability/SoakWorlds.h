#pragma once

#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"

#include <vector>

namespace parking
{
    /** \brief Where queries are put. */
    struct SoakWorld
    {
        Scenario scenario;         ///< obstacles, bounds and car; start and goal are not chosen yet
        std::vector<Pose> places;  ///< where a car could be asked to park: in slots and bays, free or not
    };

    /** \brief Strewn obstacles or a grid on 50 m; three cars in ten are of the catalogue. */
    SoakWorld soakWorld(parking_test::Random &random);

    /** \brief Little of everything on 16 to 30 m: strewn obstacles, rows of parked cars with slots between them, bays,
        winding lanes, grids of blocks, and grids as sensors leave them. */
    SoakWorld smallSoakWorld(parking_test::Random &random);
}  // namespace parking
