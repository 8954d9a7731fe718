#pragma once

#include "parking_geometry/Polygon.h"

#include <string>
#include <vector>

namespace parking_test
{
    /** \brief Names of the kinds of worlds for madeWorld(). */
    std::vector<std::string> worldKinds();

    /** \brief The obstacles of a random world of a kind, in millimetres and thus equal on every machine.

        parked_rows: aisles between rows of parked cars, 40 to 90 m wide. streets: blocks of houses, cars along the
        kerbs. multi_storey: decks with a ring of lanes each, side by side in the plane, with a narrow ramp from each to
        the next. clutter: posts, boxes and debris. shapes: large polygons of any form. large_lot: hundreds of cars on
        up to 250 m. angled_lot: angled slots along one-way aisles that are too narrow to turn round in. careless_lot:
        cars across the lines, and some in the aisles. maze: lanes between walls, with dead ends.

        \param seed equal seeds give equal worlds
        Throws parking::Error naming the known kinds for any other. */
    std::vector<parking::Polygon> madeWorld(const std::string &kind, const std::string &seed);
}  // namespace parking_test
