#include "path_tracking/reference/PathSections.h"

#include "parking_geometry/Error.h"
#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <limits>

namespace parking::test
{
    namespace
    {
        std::string errorOf(const SampledPath &path)
        {
            try
            {
                splitPath(path, Vehicle());
            }
            catch (const Error &error)
            {
                return error.what();
            }
            return "";
        }

        TEST(PathSections, SplitsWhereTheDirectionChanges)
        {
            const SampledPath path = arcs({1.0, 2.0, 0.5}, {{1.0, 2.0}, {0.0, 1.0}, {-1.0, -3.0}, {0.0, 0.5}});
            const std::vector<PathSection> sections = splitPath(path, Vehicle());
            ASSERT_EQ(sections.size(), 3u);
            EXPECT_EQ(sections[0].direction, 1);
            EXPECT_EQ(sections[1].direction, -1);
            EXPECT_EQ(sections[2].direction, 1);
            std::size_t nodes = 0;
            for (const PathSection &section : sections)
            {
                EXPECT_EQ(section.cornerCount, 0u);
                nodes += section.nodes.size() - 1;
                double length = 0.0;
                for (const PathNode &node : section.nodes)
                    length += node.length;
                EXPECT_GT(length, 0.4);
            }
            EXPECT_EQ(nodes + 1, path.size());
            double length = 0.0;
            for (const PathNode &node : sections[0].nodes)
                length += node.length;
            EXPECT_NEAR(length, 3.0, 1e-9);
        }

        TEST(PathSections, LongArcsKeepTheirLength)
        {
            // Two states three quarters of a circle apart: the chord alone would say a quarter.
            const double radius = Vehicle().minTurningRadius();
            const double length = 1.5 * PI * radius;
            const Pose end = advance({}, 1.0 / radius, length);
            const SampledPath path{{{}, 0.0, 1.0 / radius, 1},
                                   {{end.x, end.y, wrapAngle(end.yaw)}, length, 1.0 / radius, 1}};
            const std::vector<PathSection> sections = splitPath(path, Vehicle());
            ASSERT_EQ(sections.size(), 1u);
            EXPECT_EQ(sections[0].cornerCount, 0u);
            EXPECT_NEAR(sections[0].nodes[1].length, length, 1e-9);
        }

        TEST(PathSections, FindsCornersInBothWaysOfWritingThem)
        {
            for (const bool before : {true, false})
            {
                const SampledPath path = chords({1.0, -2.0, 0.3}, {2.0, 1.0, 3.0}, {PI / 4, -PI / 2}, before, 0.5);
                const std::vector<PathSection> sections = splitPath(path, Vehicle());
                ASSERT_EQ(sections.size(), 1u);
                EXPECT_EQ(sections[0].cornerCount, 2u);
                EXPECT_NEAR(sections[0].largestCorner, PI / 2, 1e-9);
                EXPECT_TRUE(sections[0].corner[4]);
                EXPECT_TRUE(sections[0].corner[6]);
                EXPECT_EQ(sections[0].lastCornerNode, 6u);
            }
        }

        TEST(PathSections, AJumpBelowTheThresholdIsRounding)
        {
            EXPECT_EQ(splitPath(chords({}, {2.0, 2.0}, {0.9 * CORNER_ANGLE}, true), Vehicle())[0].cornerCount, 0u);
            EXPECT_EQ(splitPath(chords({}, {2.0, 2.0}, {1.1 * CORNER_ANGLE}, true), Vehicle())[0].cornerCount, 1u);
        }

        TEST(PathSections, DropsRepeatedStates)
        {
            const SampledPath path = arcs({}, {{1.0, 2.0}, {0.0, -1.0}});
            SampledPath repeated;
            for (const PathState &state : path)
                repeated.insert(repeated.end(), 3, state);
            const auto expected = splitPath(path, Vehicle()), actual = splitPath(repeated, Vehicle());
            ASSERT_EQ(actual.size(), expected.size());
            for (std::size_t i = 0; i < actual.size(); ++i)
                EXPECT_EQ(actual[i].nodes.size(), expected[i].nodes.size());
        }

        TEST(PathSections, TurningOnTheSpotIsACorner)
        {
            SampledPath path = arcs({}, {{0.0, 2.0}});
            PathState turned = path.back();
            turned.pose.yaw = 1.0;
            path.push_back(turned);
            PathState next = turned;
            next.pose = advance(turned.pose, 0.0, 1.0);
            next.arcLength += 1.0;
            path.push_back(next);
            const std::vector<PathSection> sections = splitPath(path, Vehicle());
            ASSERT_EQ(sections.size(), 1u);
            EXPECT_EQ(sections[0].cornerCount, 1u);
            EXPECT_NEAR(sections[0].largestCorner, 1.0, 1e-9);
        }

        TEST(PathSections, RefusesNonsenseNamingTheState)
        {
            EXPECT_EQ(errorOf({}), "path: it has 0 states; at least 2 are needed");
            EXPECT_EQ(errorOf({PathState()}), "path: it has 1 states; at least 2 are needed");
            EXPECT_NE(errorOf(SampledPath(5)).find("at one place"), std::string::npos);

            const SampledPath good = arcs({}, {{1.0, 2.0}});
            EXPECT_EQ(errorOf(good), "");
            for (double PathState::*field : {&PathState::curvature, &PathState::arcLength})
            {
                SampledPath path = good;
                path[7].*field = std::numeric_limits<double>::quiet_NaN();
                EXPECT_NE(errorOf(path).find("path state 7"), std::string::npos);
            }
            SampledPath path = good;
            path[3].pose.x = std::numeric_limits<double>::infinity();
            EXPECT_NE(errorOf(path).find("path state 3"), std::string::npos);
            path = good;
            path[4].direction = 0;
            EXPECT_EQ(errorOf(path), "path state 4: direction is 0; it must be 1 or -1");
            path = good;
            path[5].curvature *= 1.02;
            EXPECT_NE(errorOf(path).find("path state 5: curvature"), std::string::npos);
            path[5].curvature = good[5].curvature * 1.005;
            EXPECT_EQ(errorOf(path), "");
        }
    }  // namespace
}  // namespace parking::test
