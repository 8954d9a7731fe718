#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace parking
{
    /** \brief Versions and cores by the names of their columns in the table `experiments`. */
    std::map<std::string, std::int64_t> machineVersions();

    /** \brief Name and version of OMPL, such as "OMPL 1.5.2", also if OMPL's own text lacks the number. */
    std::string omplVersion();

    /** \brief Description of versions and machine on two lines. */
    std::string machineText();
}  // namespace parking
