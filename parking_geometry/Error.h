#pragma once

#include <stdexcept>
#include <string>
#include <utility>

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

    /** \brief An Error about one field of a thing: readers of files look up by its name on which line it stands. */
    class FieldError : public Error
    {
    public:
        /** \brief An error that says \e message, about \e field. */
        FieldError(const std::string &message, std::string field) : Error(message), field_(std::move(field))
        {
        }

        /** \brief What the message calls the field: the key of files, where there is one for it. */
        const std::string &field() const
        {
            return field_;
        }

    private:
        std::string field_;
    };
}  // namespace parking
