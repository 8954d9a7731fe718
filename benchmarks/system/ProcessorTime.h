#pragma once

#include <ctime>

namespace parking
{
    /** \brief Seconds of processor time that this process has had so far, all of its threads together. On a machine
       that has other things to do it tells more than a clock. */
    inline double processorTime()
    {
        std::timespec now{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }

    /** \brief Seconds of processor time that the thread that asks has had so far. */
    inline double threadProcessorTime()
    {
        std::timespec now{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }
}  // namespace parking
