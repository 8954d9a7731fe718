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
        /** \brief An error that says \e message. Names from files may contain line ends and other control characters;
            each becomes a '?'. */
        explicit Error(const std::string &message) : std::runtime_error(onOneLine(message))
        {
        }

    private:
        static std::string onOneLine(std::string message)
        {
            for (char &letter : message)
                if (static_cast<unsigned char>(letter) < ' ' || letter == 0x7F)
                    letter = '?';
            return message;
        }
    };
}  // namespace parking
