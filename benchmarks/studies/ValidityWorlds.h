#pragma once

#include "benchmarks/worlds/RandomWorlds.h"
#include "state_validity/FootprintChecker.h"
#include "state_validity/fcl/FclContactTest.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Where the poses of a benchmark lie. */
    enum class Surroundings
    {
        Free,     ///< more than a metre from every obstacle
        Mixed,    ///< anywhere in the world
        Tight,    ///< at most half a metre from touching an obstacle, on either side
        Search,   ///< what a parking search asks about
        FromSlot  ///< the same, searched from the goal only, out of the slot
    };

    /** \brief The random worlds of the tests, or the bundled parking problems, with poses in each. */
    struct ValidityWorlds
    {
        /** \brief A world with both kinds of check, and the poses that are asked about there. */
        struct Place
        {
            std::unique_ptr<FootprintChecker> tiered;  ///< distance field and circles before the exact test
            std::unique_ptr<PlainFclChecker> plain;    ///< FCL for every pose
            std::vector<Pose> poses;                   ///< of the rear axle, in the world's local coordinates
        };
        std::vector<Place> places;  ///< one for each world

        /** \brief Number of poses of all places together. */
        std::size_t poseCount() const;
    };

    /** \brief Eight random worlds with 4000 poses each, always the same ones.

        \param grids occupancy grids, otherwise polygons; \e surroundings any but those of a search */
    ValidityWorlds randomWorlds(bool grids, Surroundings surroundings);

    /** \brief The bundled parking problems with the poses that ImprovedAStar asks about while it solves them.

        For that the planner is given a checker that it does not know: it then asks for every state along the motions
        that it tries. At most 20 000 poses are kept of each problem, evenly spread over its search.

        Throws parking::Error when a problem cannot be read. */
    ValidityWorlds searchedWorlds(const std::string &folder, bool fromSlot);
}  // namespace parking
