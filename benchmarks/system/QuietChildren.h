#pragma once

#include <fcntl.h>
#include <unistd.h>

namespace parking
{
    /** \brief While it lives, programs that this one starts have no standard error stream; this one keeps its own.

        OMPL asks the program lscpu what machine this is, and lscpu complains where it cannot read /sys (in a bare
        chroot, for example): no reason to bother anybody. */
    class QuietChildren
    {
    public:
        QuietChildren() : flags_(fcntl(STDERR_FILENO, F_GETFD))
        {
            if (flags_ >= 0)
                fcntl(STDERR_FILENO, F_SETFD, flags_ | FD_CLOEXEC);
        }

        ~QuietChildren()
        {
            if (flags_ >= 0)
                fcntl(STDERR_FILENO, F_SETFD, flags_);
        }

        QuietChildren(const QuietChildren &) = delete;
        QuietChildren &operator=(const QuietChildren &) = delete;

    private:
        int flags_;
    };
}  // namespace parking
