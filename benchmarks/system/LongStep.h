#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace parking
{
    /** \brief Tells on standard error, when that is a terminal, what a step is that takes longer than half a second,
       and for how long it has been going on. The line is gone when the step is over.

        Not round anything that forks without starting another program. */
    class LongStep
    {
    public:
        /** \brief \param what for example "planning" */
        explicit LongStep(std::string what);
        ~LongStep();
        LongStep(const LongStep &) = delete;
        LongStep &operator=(const LongStep &) = delete;

    private:
        void tell();

        std::string what_;
        std::chrono::steady_clock::time_point begin_;
        std::mutex mutex_;
        std::condition_variable over_;
        bool isOver_{false};
        std::thread teller_;
    };
}  // namespace parking
