#pragma once

#include <string>

#include <sys/types.h>

namespace parking
{
    /** \brief A process that was started by fork() and leads its own process group. It ends with this object. */
    class ChildProcess
    {
    public:
        /** \brief Makes \e process the leader of its group. \param process result of fork(), positive */
        explicit ChildProcess(pid_t process);
        ~ChildProcess();
        ChildProcess(const ChildProcess &) = delete;
        ChildProcess &operator=(const ChildProcess &) = delete;

        /** \brief Whether the process has ended. */
        bool hasEnded();

        /** \brief Kills the process if it still runs, and its children. \return its status as of waitpid() */
        int end();

    private:
        pid_t process_;
        bool ended_{false};
        int status_{0};
    };

    /** \brief Prepares the new process after fork(): it leads its own group and is killed when \e parent ends. Its
       input is empty. */
    void beginChild(pid_t parent);

    /** \brief How a process ended, as the end of a sentence. \param status as of waitpid() */
    std::string textOfEnd(int status);
}  // namespace parking
