// Trajectories as tables, in the quantities of the Trajectory Planning Competition of Automated Parking.

#include "benchmarks/formats/ResultFormat.h"

#include "parking_geometry/text/ReadFile.h"

namespace parking
{
    namespace
    {
        void write(const StoredResult &result, const std::string &file)
        {
            writeCsv(result.trajectory, file);
        }

        std::string check(const StoredResult &result, const std::string &file)
        {
            for (std::size_t i = 1; i < result.trajectory.size(); ++i)
                if (!(result.trajectory[i].t > result.trajectory[i - 1].t))
                    return "time does not increase at sample " + std::to_string(i + 1);
            const std::string written = readFile(file, std::size_t(1) << 30);
            return written == toCsv(result.trajectory) ? "" : "the file is not what was written";
        }
    }  // namespace

    ResultFormat tpcapTrajectory()
    {
        return {"tpcap-trajectory",
                ".csv",
                "trajectory as t, x, y, yaw, v, a, steering, steering_rate",
                true,
                write,
                check};
    }
}  // namespace parking
