#include "benchmarks/system/Subprocess.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace parking
{
    bool isProgram(const std::string &name)
    {
        if (name.find('/') != std::string::npos)
            return access(name.c_str(), X_OK) == 0;
        const char *path = std::getenv("PATH");
        std::istringstream folders(path == nullptr ? "/usr/bin:/bin" : path);
        for (std::string folder; std::getline(folders, folder, ':');)
            if (access((folder + "/" + name).c_str(), X_OK) == 0)
                return true;
        return false;
    }

    ProcessResult runProcess(const std::vector<std::string> &command)
    {
        std::vector<char *> arguments;
        for (const std::string &each : command)
            arguments.push_back(const_cast<char *>(each.c_str()));
        arguments.push_back(nullptr);
        std::array<int, 2> errors{}, failure{};
        const auto refuse = [&command](int error)
        {
            throw Error(command.front() + ": cannot be started: " + std::strerror(error));
        };
        if (pipe2(errors.data(), O_CLOEXEC) != 0)
            refuse(errno);
        if (pipe2(failure.data(), O_CLOEXEC) != 0)
        {
            const int error = errno;
            close(errors[0]);
            close(errors[1]);
            refuse(error);
        }
        const pid_t self = getpid(), child = fork();
        if (child == 0)
        {
            // It must not go on writing when this process was killed and its successor writes the same.
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            if (getppid() != self)
                _exit(EXIT_FAILURE);
            const int nothing = open("/dev/null", O_RDWR);
            if (dup2(nothing, STDIN_FILENO) >= 0 && dup2(nothing, STDOUT_FILENO) >= 0 &&
                dup2(errors[1], STDERR_FILENO) >= 0)
                execvp(arguments.front(), arguments.data());
            const int error = errno;
            _exit(write(failure[1], &error, sizeof error) > 0 ? EXIT_FAILURE : EXIT_FAILURE + 1);
        }
        int error = child < 0 ? errno : 0;
        close(errors[1]);
        close(failure[1]);
        ProcessResult result;
        std::array<char, 4096> buffer{};
        while (child > 0)
        {
            const ssize_t count = read(errors[0], buffer.data(), buffer.size());
            if (count > 0)
                result.errors.append(buffer.data(), static_cast<std::size_t>(count));
            else if (count == 0 || errno != EINTR)
                break;
        }
        if (child > 0 && read(failure[0], &error, sizeof error) < static_cast<ssize_t>(sizeof error))
            error = 0;
        close(errors[0]);
        close(failure[0]);
        int status = 0;
        while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR)
        {
        }
        if (error != 0)
            refuse(error);
        result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        return result;
    }

    std::string lastLine(const std::string &text)
    {
        const std::size_t last = text.find_last_not_of(" \r\n");
        if (last == std::string::npos)
            return "it says nothing";
        const std::size_t before = text.rfind('\n', last);
        const std::size_t first = before == std::string::npos ? 0 : before + 1;
        return oneLine(text.substr(first, last + 1 - first));
    }
}  // namespace parking
