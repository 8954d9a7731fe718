#include "benchmarks/system/ChildProcess.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace parking
{
    ChildProcess::ChildProcess(pid_t process) : process_(process)
    {
        setpgid(process_, process_);
    }

    ChildProcess::~ChildProcess()
    {
        end();
    }

    bool ChildProcess::hasEnded()
    {
        if (!ended_)
            ended_ = waitpid(process_, &status_, WNOHANG) == process_;
        return ended_;
    }

    int ChildProcess::end()
    {
        kill(-process_, SIGKILL);
        if (!ended_)
        {
            kill(process_, SIGKILL);
            while (waitpid(process_, &status_, 0) < 0 && errno == EINTR)
            {
            }
        }
        ended_ = true;
        return status_;
    }

    void beginChild(pid_t parent)
    {
        setpgid(0, 0);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        std::signal(SIGINT, SIG_DFL);
        std::signal(SIGTERM, SIG_DFL);
        if (getppid() != parent || dup2(open("/dev/null", O_RDWR | O_CLOEXEC), STDIN_FILENO) < 0)
            _exit(EXIT_FAILURE);
    }

    std::string textOfEnd(int status)
    {
        if (!WIFSIGNALED(status))
            return "it ended its process with status " + std::to_string(WEXITSTATUS(status));
        const char *name = strsignal(WTERMSIG(status));
        return "killed by signal " + std::to_string(WTERMSIG(status)) +
               (name != nullptr ? std::string(" (") + name + ")" : "");
    }
}  // namespace parking
