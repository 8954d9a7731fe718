#include "path_tracking/trajectory/Trajectory.h"

#include "parking_geometry/Error.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace parking::test
{
    namespace
    {
        const Trajectory EXAMPLE{{0.0, 1.0 / 3.0, -2e-17, 3.0, 0.0, 0.8, -0.75, 0.5},
                                 {0.1, 4.48e9 + 0.125, 1e300, -3.0, -2.5, -1.0, 0.1, -0.5}};

        TEST(Trajectory, CsvReadsBackExactly)
        {
            std::istringstream lines(toCsv(EXAMPLE));
            std::string line;
            std::getline(lines, line);
            EXPECT_EQ(line, "t,x,y,yaw,v,a,steering,steering_rate");
            for (const TrajectoryPoint &point : EXAMPLE)
            {
                ASSERT_TRUE(std::getline(lines, line));
                std::istringstream cells(line);
                std::vector<double> values;
                for (std::string cell; std::getline(cells, cell, ',');)
                    values.push_back(std::strtod(cell.c_str(), nullptr));
                const std::vector<double> expected{point.t,        point.x,           point.y,
                                                   point.yaw,      point.v,           point.acceleration,
                                                   point.steering, point.steeringRate};
                EXPECT_EQ(values, expected);
            }
            EXPECT_FALSE(std::getline(lines, line));
        }

        TEST(Trajectory, IsWrittenWholeOrNotAtAll)
        {
            const auto folder = std::filesystem::temp_directory_path() / "parking_trajectory_test";
            std::filesystem::create_directories(folder);
            const auto file = folder / "drive.csv";
            writeCsv(EXAMPLE, file.string());
            std::ifstream stream(file);
            std::stringstream content;
            content << stream.rdbuf();
            EXPECT_EQ(content.str(), toCsv(EXAMPLE));
            EXPECT_THROW(writeCsv(EXAMPLE, (folder / "missing" / "drive.csv").string()), Error);
            EXPECT_FALSE(std::filesystem::exists(folder / "missing"));
            std::filesystem::remove_all(folder);
        }
    }  // namespace
}  // namespace parking::test
