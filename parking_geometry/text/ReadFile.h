#pragma once

#include <cstddef>
#include <string>

namespace parking
{
    /** \brief Reads all bytes of a file. A pipe (`<(...)`, /dev/stdin) can be read only once.

        \param limit largest allowed size in bytes
        Throws parking::Error naming the file if it is missing, a directory, a device, not readable, empty or too
        large. */
    std::string readFile(const std::string &file, std::size_t limit);
}  // namespace parking
