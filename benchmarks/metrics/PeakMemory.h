#pragma once

#include <optional>

namespace parking
{
    /** \brief Maximum memory of this process during an operation, beyond its memory at the begin.

        The system counts resident pages. The heap reuses pages of earlier runs, so that the figure is exact only if
        each run has its own process. */
    class PeakMemory
    {
    public:
        /** \brief Starts the measurement. */
        void begin();

        /** \brief Megabytes (10^6 bytes) between the memory at begin() and the peak since then; empty if the system
            does not report them. */
        std::optional<double> megabytes() const;

    private:
        double before_{-1.0};  ///< bytes
    };
}  // namespace parking
