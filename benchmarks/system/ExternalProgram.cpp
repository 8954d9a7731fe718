#include "benchmarks/system/ExternalProgram.h"

#include "parking_geometry/Error.h"

#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace parking
{
    namespace
    {
        constexpr int WAIT = 10;                                    // milliseconds between two calls of a Stop
        constexpr std::size_t LONGEST_LINE = std::size_t(1) << 26;  // bytes
        constexpr int NOT_FOUND = 127;                              // exit status, as of a shell
    }                                                               // namespace

    ExternalProgram::ExternalProgram(const std::vector<std::string> &command) : name_(command.front())
    {
        std::vector<char *> arguments;
        for (const std::string &each : command)
            arguments.push_back(const_cast<char *>(each.c_str()));
        arguments.push_back(nullptr);
        std::array<int, 2> ends{};
        const pid_t self = getpid();
        const bool isOpen = socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0;
        const pid_t process = isOpen ? fork() : -1;
        if (process < 0)
        {
            const Error failure(name_ + " cannot be started: " + std::strerror(errno));
            if (isOpen)
                for (const int end : ends)
                    close(end);
            throw failure;
        }
        if (process == 0)
        {
            beginChild(self);
            // A copy onto itself would keep the flag that closes it.
            const bool isThere = ends[1] == SOCKET ? fcntl(SOCKET, F_SETFD, 0) == 0 : dup2(ends[1], SOCKET) == SOCKET;
            if (isThere && dup2(STDERR_FILENO, STDOUT_FILENO) >= 0)
                execvp(arguments.front(), arguments.data());
            _exit(NOT_FOUND);
        }
        close(ends[1]);
        socket_ = ends[0];
        fcntl(socket_, F_SETFL, O_NONBLOCK);
        process_.emplace(process);
    }

    ExternalProgram::~ExternalProgram()
    {
        close(socket_);
    }

    bool ExternalProgram::send(const std::string &line, const Stop &stop)
    {
        const std::string text = line + "\n";
        for (std::size_t sent = 0; sent < text.size();)
        {
            if (stop())
                return false;
            pollfd end{socket_, POLLOUT, 0};
            poll(&end, 1, WAIT);
            const ssize_t count = ::send(socket_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
            if (count > 0)
                sent += static_cast<std::size_t>(count);
            else if (errno != EAGAIN && errno != EINTR)
                return true;  // it has ended: receive() reports that
        }
        return true;
    }

    std::optional<std::string> ExternalProgram::receive(const Stop &stop)
    {
        for (std::size_t searched = 0;;)
        {
            if (stop())
                return std::nullopt;
            if (const std::size_t end = received_.find('\n', searched); end != std::string::npos)
            {
                std::string line = received_.substr(0, end);
                received_.erase(0, end + 1);
                return line;
            }
            searched = received_.size();
            if (searched > LONGEST_LINE)
                throw Error("its answer is too long");
            pollfd end{socket_, POLLIN, 0};
            poll(&end, 1, WAIT);
            std::array<char, 65536> buffer;
            const ssize_t count = recv(socket_, buffer.data(), buffer.size(), 0);
            if (count > 0)
                received_.append(buffer.data(), static_cast<std::size_t>(count));
            else if (count == 0 || (errno != EAGAIN && errno != EINTR))
            {
                // Its end may follow that of its channel.
                while (!process_->hasEnded())
                {
                    if (stop())
                        return std::nullopt;
                    poll(nullptr, 0, 1);
                }
                const int status = process_->end();
                throw Error(WIFEXITED(status) && WEXITSTATUS(status) == NOT_FOUND ? name_ + " cannot be started"
                                                                                  : textOfEnd(status));
            }
        }
    }
}  // namespace parking
