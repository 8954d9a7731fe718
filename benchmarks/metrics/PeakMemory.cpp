#include "benchmarks/metrics/PeakMemory.h"

#include <algorithm>
#include <fstream>
#include <string>

namespace parking
{
    namespace
    {
        /** A line of /proc/self/status in bytes; negative without one. */
        double statusBytes(const std::string &key)
        {
            std::ifstream file("/proc/self/status");
            for (std::string name; file >> name;)
            {
                double kilobytes = 0.0;
                if (name == key + ":" && file >> kilobytes)
                    return 1024.0 * kilobytes;
            }
            return -1.0;
        }

        /** Resets the peak of the system's count. */
        bool resetPeak()
        {
            std::ofstream file("/proc/self/clear_refs");
            return static_cast<bool>(file << "5\n" << std::flush);
        }
    }  // namespace

    void PeakMemory::begin()
    {
        before_ = resetPeak() ? statusBytes("VmRSS") : -1.0;
    }

    std::optional<double> PeakMemory::megabytes() const
    {
        const double peak = statusBytes("VmHWM");
        if (before_ < 0.0 || peak < 0.0)
            return std::nullopt;
        return std::max(0.0, peak - before_) / 1e6;
    }
}  // namespace parking
