#include "benchmarks/system/Subprocess.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace parking
{
    namespace
    {
        constexpr int NOT_STARTED = 127;  // status, as of a shell
    }

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
        std::array<int, 2> errors{};
        if (pipe2(errors.data(), O_CLOEXEC) != 0)
            throw Error(command.front() + ": cannot be started: " + std::strerror(errno));
        const pid_t self = getpid(), child = fork();
        if (child == 0)
        {
            // It must not go on writing when this process was killed and its successor writes the same.
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            const int nothing = open("/dev/null", O_RDWR);
            if (getppid() == self && dup2(nothing, STDIN_FILENO) >= 0 && dup2(nothing, STDOUT_FILENO) >= 0 &&
                dup2(errors[1], STDERR_FILENO) >= 0)
                execvp(arguments.front(), arguments.data());
            perror(arguments.front());
            _exit(NOT_STARTED);
        }
        close(errors[1]);
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
        close(errors[0]);
        if (child < 0)
            throw Error(command.front() + ": cannot be started: no more processes");
        int status = 0;
        while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        {
        }
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
