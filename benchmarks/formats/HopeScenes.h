#pragma once

#include "parking_geometry/Scenario.h"

#include <cstdint>
#include <string>
#include <vector>

namespace parking
{
    /** \brief The levels of HOPE (M. Jiang and others, arXiv 2405.20579): normal, complex, extreme, dlp. */
    std::vector<std::string> hopeLevels();

    /** \brief A random parking problem of one of HOPE's levels; equal seeds give equal problems.

        Drawn by code of our own with the numbers that HOPE publishes (src/configs.py of github.com/jiamiya/HOPE): the
        room round the car in its slot, the width of the aisle, the number of obstacles beyond it, where cars start.
        normal and complex have bays and parallel slots, extreme parallel slots only. HOPE's fourth level plays
        recordings of the Dragon Lake lot, which are not ours to give: dlp here is a lot of that size (140 m by 80 m,
        about 400 bays), filled at random, with a start in an aisle up to 30 m away.

        Throws parking::Error for an unknown level. */
    Scenario hopeScene(const std::string &level, std::uint64_t seed);
}  // namespace parking
