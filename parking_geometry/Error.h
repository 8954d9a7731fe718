#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace parking
{
    /** \brief The exception for an invalid value or file.

        The message is one line. It names the file, line or field and states the valid values. Programs print it and
        exit with status 2. */
    class Error : public std::runtime_error
    {
    public:
        /** \brief An error with this message. Each control character, such as a line end in a file name, becomes
            '?'. */
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

    /** \brief An Error about one field. Readers of files use its name to look up the line of the field. */
    class FieldError : public Error
    {
    public:
        /** \brief An error with \e message about \e field. */
        FieldError(const std::string &message, std::string field) : Error(message), field_(std::move(field))
        {
        }

        /** \brief Name of the field as in the message: its key in files, if it has one. */
        const std::string &field() const
        {
            return field_;
        }

    private:
        std::string field_;
    };
}  // namespace parking
