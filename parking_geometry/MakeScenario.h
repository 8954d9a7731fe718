#pragma once

#include "parking_geometry/Scenario.h"

#include <cstddef>
#include <functional>
#include <string>

namespace parking
{
    /** \brief How far from the start anything of a scenario may lie, in metres. Farther away coordinates are mixed up,
        and a planner would drown in the empty space between. */
    constexpr double WORLD_REACH = 1e5;

    /** \brief A part of a scenario that may be wrong. */
    enum class ScenarioPart
    {
        Start,   ///< where the car stands
        Goal,    ///< or the slot that it follows from
        Map,     ///< the grid
        Outline  ///< one of the polygons, by its index
    };

    /** \brief Says where a part of a scenario stands, as "file:line"; the index is that of a polygon. */
    using PlaceOfPart = std::function<std::string(ScenarioPart part, std::size_t index)>;

    /** \brief What all scenarios have in common once their parts are local: checks the start (its coordinates in the
        world up to FARTHEST_COORDINATE), the outlines and the reach of the world, and sets the bounds. Throws
        parking::Error naming \e source, or the place of the part that is wrong where \e placeOf is given. */
    void completeScenario(Scenario &scenario, const std::string &source, const PlaceOfPart &placeOf = {});

    /** \brief A scenario from parts in world coordinates, without a file: what the readers do with theirs.

        \param scenario vehicle, start, either goals or a slot, either polygons or a grid; worldOffset and bounds are
       set here, goals too where a slot is given \param source what messages call it, a file for example Throws
       parking::Error naming the part and the value that is wrong. */
    Scenario makeScenario(Scenario scenario, const std::string &source);
}  // namespace parking
