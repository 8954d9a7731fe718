#pragma once

#include <chrono>

namespace parking
{
    /** \brief Measures from when it was made, by a clock that is never set. */
    class Stopwatch
    {
    public:
        /** \brief Since then. */
        double seconds() const
        {
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        }

    private:
        std::chrono::steady_clock::time_point begin_{std::chrono::steady_clock::now()};
    };
}  // namespace parking
