#pragma once

#include <optional>

namespace parking
{
    /** \brief How much memory this process takes at most while something runs, beyond what it had before.

        As the system counts it (resident pages). What an earlier run has left in the heap is used again and does not
        show, so the figure is a run's own only where each run has a process of its own. */
    class PeakMemory
    {
    public:
        /** \brief From now on. */
        void begin();

        /** \brief Megabytes (10^6 bytes) by which the peak since begin() is above what there was then; nothing where
            the system does not tell. */
        std::optional<double> megabytes() const;

    private:
        double before_{-1.0};  ///< bytes
    };
}  // namespace parking
