#pragma once

#include <stdexcept>
#include <string>

namespace parking
{
    /** \brief A bad value or file. The message is one line that names the file, line or field and says what would be
        right; programs print it and exit with status 2. */
    class Error : public std::runtime_error
    {
    public:
        /** \brief An error that says \e message. */
        explicit Error(const std::string &message) : std::runtime_error(message)
        {
        }
    };
}  // namespace parking
