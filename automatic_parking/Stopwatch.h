#pragma once

#include <chrono>

namespace parking
{
    /** \brief Measures the time since its construction, with a monotonic clock. */
    class Stopwatch
    {
    public:
        /** \brief Seconds since construction. */
        double seconds() const
        {
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        }

    private:
        std::chrono::steady_clock::time_point begin_{std::chrono::steady_clock::now()};
    };
}  // namespace parking
