// What the controller is given to drive: pathToDrive().

#include "benchmarks/problems/PathQuality.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Kinematics.h"
#include "path_tracking/reference/PathSections.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace parking
{
    namespace
    {
        const Vehicle CAR = vehicleByName("vw_golf8");

        /** States joined by straight lines, as PlannedPath has them on a plain SE2 space. */
        PlannedPath straightLines(const std::vector<Pose> &poses)
        {
            PlannedPath path;
            path.straight = true;
            PathState state;
            state.pose = poses.front();
            path.states.push_back(state);
            for (std::size_t i = 1; i < poses.size(); ++i)
            {
                const Pose &from = poses[i - 1], &to = poses[i];
                const Arc arc = arcBetween(from, to);
                const double length = std::hypot(to.x - from.x, to.y - from.y);
                state.pose = to;
                state.arcLength += length;
                state.curvature = length > 1e-7 ? arc.curvature : 0.0;
                state.direction = arc.length < 0.0 ? -1 : 1;
                path.states.push_back(state);
            }
            return path;
        }

        double sharpest(const SampledPath &path)
        {
            double most = 0.0;
            for (const PathState &state : path)
                most = std::max(most, std::abs(state.curvature));
            return most;
        }
    }  // namespace

    TEST(PathToDrive, KeepsArcs)
    {
        PlannedPath path;
        path.states = Path{{1.0, 2.0, 0.3}, {{0.2, 3.0}, {-0.2, -2.0}}}.sample(0.1);
        const SampledPath drive = pathToDrive(path, CAR);
        ASSERT_EQ(drive.size(), path.states.size());
        for (std::size_t i = 0; i < drive.size(); ++i)
            EXPECT_EQ(drive[i].pose.x, path.states[i].pose.x);
    }

    TEST(PathToDrive, MakesACornerOfATurnInAShortStep)
    {
        // A grid path round a corner, whose heading jumps within 3 mm: 500 times what the car can turn.
        const PlannedPath path =
            straightLines({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2.0, 0.003, PI / 2}, {2, 1, PI / 2}, {2, 2, PI / 2}});
        ASSERT_THROW(splitPath(path.states, CAR), std::exception);
        const SampledPath drive = pathToDrive(path, CAR);
        EXPECT_LE(sharpest(drive), 1.0 / CAR.minTurningRadius());
        const std::vector<PathSection> sections = splitPath(drive, CAR);
        ASSERT_EQ(sections.size(), 1U);
        EXPECT_EQ(sections[0].cornerCount, 1U);
        EXPECT_NEAR(sections[0].largestCorner, PI / 2, 1e-6);
        EXPECT_NEAR(drive.back().pose.x, 2.0, 1e-9);
        EXPECT_NEAR(drive.back().pose.y, 2.0, 1e-9);
        EXPECT_NEAR(drive.back().arcLength, 4.0, 0.01);
    }

    TEST(PathToDrive, CornersLieWhereTheLinesMeet)
    {
        // The same corner cut by a tight curve of 0.5 m radius, in steps.
        std::vector<Pose> poses{{0, 0, 0}, {1.5, 0, 0}};
        for (int k = 1; k <= 10; ++k)
        {
            const double angle = k * PI / 20;
            poses.push_back({1.5 + 0.5 * std::sin(angle), 0.5 - 0.5 * std::cos(angle), angle});
        }
        poses.push_back({2, 3, PI / 2});
        const SampledPath drive = pathToDrive(straightLines(poses), CAR);
        EXPECT_LE(sharpest(drive), 1.0 / CAR.minTurningRadius());
        bool found = false;
        for (const PathState &state : drive)
            found = found || std::hypot(state.pose.x - 2.0, state.pose.y) < 1e-6;
        EXPECT_TRUE(found);
        EXPECT_EQ(splitPath(drive, CAR)[0].cornerCount, 1U);
    }

    TEST(PathToDrive, KeepsGentleCurves)
    {
        std::vector<Pose> poses;
        for (int k = 0; k <= 40; ++k)
            poses.push_back({6.0 * std::sin(0.02 * k), 6.0 - 6.0 * std::cos(0.02 * k), 0.02 * k});
        const SampledPath drive = pathToDrive(straightLines(poses), CAR);
        ASSERT_EQ(drive.size(), poses.size());
        EXPECT_NEAR(drive[5].curvature, 1.0 / 6.0, 1e-3);
        EXPECT_EQ(splitPath(drive, CAR)[0].cornerCount, 0U);
    }

    TEST(PathToDrive, DrivesInReverseToo)
    {
        const PlannedPath path =
            straightLines({{0, 0, 0}, {-1, 0, 0}, {-2, 0, 0}, {-2.0, -0.003, PI / 2}, {-2, -1, PI / 2}});
        const SampledPath drive = pathToDrive(path, CAR);
        for (const PathState &state : drive)
            EXPECT_EQ(state.direction, -1);
        for (std::size_t i = 1; i < drive.size(); ++i)
        {
            // The car's nose points away from where it goes.
            const Pose &from = drive[i - 1].pose, &to = drive[i].pose;
            const double way = std::atan2(from.y - to.y, from.x - to.x);
            EXPECT_NEAR(wrapAngle(to.yaw - way), 0.0, 1e-3) << i;
        }
        EXPECT_LE(sharpest(drive), 1.0 / CAR.minTurningRadius());
        EXPECT_NEAR(drive.back().pose.y, -1.0, 1e-9);
        EXPECT_NEAR(drive.back().arcLength, 3.0, 0.01);
    }

    TEST(PathToDrive, EndsWhereThePathEnds)
    {
        // In the middle of a turn, and with a turn on the spot.
        for (const Pose &end : {Pose{1.1, 0.2, 1.2}, Pose{1.0, 0.0, 0.7}})
        {
            const SampledPath drive = pathToDrive(straightLines({{0, 0, 0}, {1, 0, 0}, end}), CAR);
            EXPECT_NEAR(drive.back().pose.x, end.x, 1e-9);
            EXPECT_NEAR(drive.back().pose.y, end.y, 1e-9);
            EXPECT_NEAR(drive.back().pose.yaw, end.yaw, 1e-9);
        }
    }

    TEST(PathToDrive, LeavesShortPathsAlone)
    {
        PlannedPath path;
        EXPECT_TRUE(pathToDrive(path, CAR).empty());
        path.straight = true;
        path.states.resize(1);
        EXPECT_EQ(pathToDrive(path, CAR).size(), 1U);
    }
}  // namespace parking
