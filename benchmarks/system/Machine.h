#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace parking
{
    /** \brief Versions and cores by the names of their columns in the table `experiments`. */
    std::map<std::string, std::int64_t> machineVersions();

    /** \brief "OMPL 1.5.2", also where OMPL's own text leaves the number out. */
    std::string omplVersion();

    /** \brief The same and more in words, on two lines. */
    std::string machineText();
}  // namespace parking
