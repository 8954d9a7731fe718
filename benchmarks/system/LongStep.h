#pragma once

#include <iostream>
#include <string>

#include <unistd.h>

namespace parking
{
    /** \brief Shows the current step of the program on standard error during its lifetime, if that is a terminal. */
    class LongStep
    {
    public:
        /** \brief \param what for example "planning" */
        explicit LongStep(const std::string &what) : width_(isatty(STDERR_FILENO) == 1 ? what.size() + 3 : 0)
        {
            if (width_ > 0)
                std::cerr << '\r' << what << "..." << std::flush;
        }

        ~LongStep()
        {
            if (width_ > 0)
                std::cerr << '\r' << std::string(width_, ' ') << '\r' << std::flush;
        }

        LongStep(const LongStep &) = delete;
        LongStep &operator=(const LongStep &) = delete;

    private:
        std::size_t width_;
    };
}  // namespace parking
