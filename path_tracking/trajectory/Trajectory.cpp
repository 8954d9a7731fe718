#include "path_tracking/trajectory/Trajectory.h"

#include "parking_geometry/text/Text.h"
#include "parking_geometry/text/WriteFile.h"

namespace parking
{
    std::string toCsv(const Trajectory &trajectory)
    {
        std::string text = "t,x,y,yaw,v,a,steering,steering_rate\n";
        for (const TrajectoryPoint &point : trajectory)
        {
            const double values[] = {point.t,        point.x,           point.y, point.yaw, point.v, point.acceleration,
                                     point.steering, point.steeringRate};
            char separator = '\0';
            for (const double value : values)
            {
                if (separator != '\0')
                    text += separator;
                text += formatNumber(value);
                separator = ',';
            }
            text += '\n';
        }
        return text;
    }

    void writeCsv(const Trajectory &trajectory, const std::string &file)
    {
        writeFileAtomically(file, toCsv(trajectory));
    }
}  // namespace parking
