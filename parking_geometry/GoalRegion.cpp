#include "parking_geometry/GoalRegion.h"

#include "parking_geometry/text/Require.h"

#include <cmath>

#include <Eigen/Core>

namespace parking
{
    namespace
    {
        constexpr int POSITIONS_AROUND = 6;
        constexpr int HEADINGS = 16;           // round the circle
        constexpr double MAX_TOLERANCE = 100;  // metres; larger values indicate other units

        std::vector<double> headingsOf(const GoalRegion &region)
        {
            std::vector<double> headings;
            if (region.heading == GoalHeading::Any)
            {
                for (int i = 0; i < HEADINGS; ++i)
                    headings.push_back(region.pose.yaw + 2.0 * PI * i / HEADINGS);
                return headings;
            }
            const std::vector<double> offsets =
                region.yawTolerance > 0.0 ? std::vector<double>{0.0, region.yawTolerance, -region.yawTolerance}
                                          : std::vector<double>{0.0};
            for (const double offset : offsets)
                headings.push_back(region.pose.yaw + offset);
            for (const double offset : offsets)
                if (region.heading == GoalHeading::Both)
                    headings.push_back(region.pose.yaw + PI + offset);
            return headings;
        }
    }  // namespace

    std::vector<Pose> GoalRegion::goals() const
    {
        validate();
        std::vector<Eigen::Vector2d> positions{{pose.x, pose.y}};
        for (int i = 0; i < POSITIONS_AROUND && tolerance > 0.0; ++i)
        {
            const double angle = pose.yaw + 2.0 * PI * i / POSITIONS_AROUND;
            positions.emplace_back(pose.x + tolerance * std::cos(angle), pose.y + tolerance * std::sin(angle));
        }
        std::vector<Pose> goals;
        for (const Eigen::Vector2d &position : positions)
            for (const double yaw : headingsOf(*this))
                goals.push_back({position.x(), position.y(), wrapAngle(yaw)});
        return goals;
    }

    void GoalRegion::validate() const
    {
        const Require require("goal");
        require.finite("pose x", pose.x, "metres");
        require.finite("pose y", pose.y, "metres");
        require.finite("pose yaw", pose.yaw, "radians");
        require.that(tolerance >= 0.0 && tolerance <= MAX_TOLERANCE, "tolerance", tolerance,
                     "a number of metres from 0 to 100");
        require.that(yawTolerance >= 0.0 && yawTolerance < PI, "yaw_tolerance", yawTolerance,
                     "a number of radians from 0 to below 3.1416");
    }
}  // namespace parking
