#pragma once

#include <cstddef>
#include <string>

namespace parking
{
    /** \brief "1 obstacle", "2 obstacles"; \e plural is for words that need more than an s. */
    inline std::string counted(std::size_t count, const std::string &what, const std::string &plural = "")
    {
        return std::to_string(count) + " " + (count == 1 ? what : plural.empty() ? what + "s" : plural);
    }
}  // namespace parking
