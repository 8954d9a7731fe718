#pragma once

#include "parking_geometry/Scenario.h"

#include <cstddef>
#include <functional>
#include <string>

namespace parking
{
    /** \brief Largest distance of goals and obstacles from the start, in metres. Larger distances indicate mixed
        coordinate systems and exceed what a planner can search. */
    constexpr double WORLD_REACH = 1e5;

    /** \brief The part of a scenario that an error concerns. */
    enum class ScenarioPart
    {
        Start,   ///< the start pose
        Goal,    ///< the goal, or the slot that determines it
        Map,     ///< the occupancy grid
        Outline  ///< one of the polygons, given by its index
    };

    /** \brief Returns the place of a part of a scenario as "file:line". \e index selects the polygon of an outline. */
    using PlaceOfPart = std::function<std::string(ScenarioPart part, std::size_t index)>;

    /** \brief Validates a scenario in local coordinates and sets its bounds.

        Checks the start, the outlines and the extent of the world. World coordinates of the start may be up to
        MAX_COORDINATE.
        Throws parking::Error naming \e source or, if \e placeOf is given, the place of the invalid part. */
    void completeScenario(Scenario &scenario, const std::string &source, const PlaceOfPart &placeOf = {});

    /** \brief Makes a valid scenario from parts in world coordinates, as the file readers do.

        \param scenario vehicle, start, either goals or a slot, either polygons or a grid. The function sets
        worldOffset, bounds and, for a slot, the goals.
        \param source name of the scenario in messages, for example its file
        Throws parking::Error naming the invalid part and its value. */
    Scenario makeScenario(Scenario scenario, const std::string &source);
}  // namespace parking
