#pragma once

#include "benchmarks/system/ChildProcess.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Another program with which this one exchanges lines of text. It and its children end with this object.

        The lines pass through a socket, file descriptor 3 of the program. Its input is empty, and its output goes to
        standard error, so that its own messages are no answers. */
    class ExternalProgram
    {
    public:
        /** \brief When to give up waiting; called at least every 10 ms. */
        using Stop = std::function<bool()>;

        /** \brief Starts a program. \param command name, searched in PATH, and arguments
            Throws parking::Error when no process can be created; a program that does not exist ends at once. */
        explicit ExternalProgram(const std::vector<std::string> &command);
        ~ExternalProgram();
        ExternalProgram(const ExternalProgram &) = delete;
        ExternalProgram &operator=(const ExternalProgram &) = delete;

        /** \brief Writes a line. \return false if \e stop became true first */
        bool send(const std::string &line, const Stop &stop);

        /** \brief The next line, without its end; nothing if \e stop became true first.
            Throws parking::Error with the cause when the program has ended, and for lines of more than 64 MB. */
        std::optional<std::string> receive(const Stop &stop);

    private:
        static constexpr int SOCKET = 3;  ///< file descriptor of the program

        std::string name_;
        int socket_{-1};
        std::string received_;
        std::optional<ChildProcess> process_;
    };
}  // namespace parking
