#pragma once

#include <ctime>

namespace parking
{
    /** \brief Processor time in seconds of all threads of this process.
       It depends less on other load of the machine than the wall clock. */
    inline double processorTime()
    {
        std::timespec now{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }

    /** \brief Processor time in seconds of the calling thread. */
    inline double threadProcessorTime()
    {
        std::timespec now{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }
}  // namespace parking
