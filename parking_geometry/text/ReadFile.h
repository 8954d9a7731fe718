#pragma once

#include <cstddef>
#include <string>

namespace parking
{
    /** \brief All bytes of a file.

        \param limit the most bytes that are taken; a larger file is an error and is not read further
        A pipe (`<(...)`, /dev/stdin) is read to its end, which its writer decides; a second time it is empty.
        Throws parking::Error, naming the file, when it is missing, a directory, a device, not readable,
        empty or too large. */
    std::string readFile(const std::string &file, std::size_t limit);
}  // namespace parking
