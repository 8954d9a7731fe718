#include "path_tracking/reference/DrivablePath.h"
#include "path_tracking/reference/ReferencePath.h"

#include "parking_geometry/Error.h"
#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace parking::test
{
    namespace
    {
        /** Distance of a point from a polyline of states, by brute force. */
        double distanceTo(const SampledPath &path, const Pose &point)
        {
            double best = 1e9;
            for (std::size_t i = 1; i < path.size(); ++i)
            {
                const Pose &a = path[i - 1].pose, &b = path[i].pose;
                const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
                if (squared == 0.0)
                    continue;
                const double t = std::clamp(((point.x - a.x) * dx + (point.y - a.y) * dy) / squared, 0.0, 1.0);
                best = std::min(best, std::hypot(point.x - a.x - t * dx, point.y - a.y - t * dy));
            }
            return best;
        }

        /** Checks that the legs of a reference are drivable arcs that hang together. */
        void expectDrivable(const ReferencePath &reference)
        {
            const double most = 1.0 / reference.vehicle().minTurningRadius();
            for (const ReferenceLeg &leg : reference.legs())
                for (std::size_t i = leg.firstNode + 1; i <= leg.lastNode; ++i)
                {
                    const PathNode &from = reference.nodes()[i - 1], &to = reference.nodes()[i];
                    EXPECT_LE(std::abs(to.curvature), most * (1.0 + 1e-9));
                    const Pose driven = advance(from.pose, to.curvature, leg.direction * to.length);
                    EXPECT_NEAR(driven.x, to.pose.x, 0.006);
                    EXPECT_NEAR(driven.y, to.pose.y, 0.006);
                    EXPECT_NEAR(wrapAngle(driven.yaw - to.pose.yaw), 0.0, 0.006);
                }
            for (std::size_t i = 1; i < reference.legs().size(); ++i)
            {
                const Pose &end = reference.nodes()[reference.legs()[i - 1].lastNode].pose;
                const Pose &begin = reference.nodes()[reference.legs()[i].firstNode].pose;
                EXPECT_NEAR(std::hypot(end.x - begin.x, end.y - begin.y), 0.0, 0.011);
                EXPECT_NEAR(wrapAngle(end.yaw - begin.yaw), 0.0, CORNER_ANGLE);
            }
        }

        TEST(Corners, AreCutByLittleMoreThanTheInscribedArc)
        {
            const double radius = Vehicle().minTurningRadius();
            for (const double degrees : {5.0, 15.0, 26.565, 45.0, 60.0})
                for (const bool before : {true, false})
                {
                    const double angle = degrees * PI / 180.0;
                    const ReferencePath reference(chords({3.0, 1.0, 2.0}, {10.0, 10.0}, {angle}, before), Vehicle());
                    const double inscribed = radius * (1.0 / std::cos(0.5 * angle) - 1.0);
                    EXPECT_EQ(reference.corners(), 1u);
                    EXPECT_EQ(reference.cornerTurns(), 0u) << degrees;
                    EXPECT_LE(reference.cornerDeviation(), inscribed + 0.03) << degrees;
                    EXPECT_EQ(reference.legs().size(), 1u);
                    expectDrivable(reference);
                }
        }

        TEST(Corners, TheStatedDeviationHolds)
        {
            for (std::uint64_t seed = 0; seed < 30; ++seed)
            {
                Random random(seed);
                std::vector<double> lengths, turns;
                for (int i = 0; i < 40; ++i)
                {
                    lengths.push_back(random.below(2) == 0 ? 0.5 : std::sqrt(0.5));
                    turns.push_back(random.below(5) == 0 ? (random.below(2) == 0 ? 1 : -1) * PI / 4 : 0.0);
                }
                turns.pop_back();
                const SampledPath path =
                    chords({0.0, 0.0, 0.1 * static_cast<double>(seed)}, lengths, turns, seed % 2 == 0);
                const ReferencePath reference(path, Vehicle());
                expectDrivable(reference);
                double farthest = 0.0;
                for (const PathNode &node : reference.nodes())
                    farthest = std::max(farthest, distanceTo(path, node.pose));
                EXPECT_LE(farthest, reference.cornerDeviation() + 0.01) << seed;
                EXPECT_GT(reference.cornerDeviation(), 0.0) << seed;
                // However it was driven, it ends at the last pose.
                const Pose end = relativeTo(path.back().pose, reference.end());
                EXPECT_LE(std::hypot(end.x, end.y), 0.021) << seed;
                EXPECT_LE(std::abs(end.yaw), CORNER_ANGLE) << seed;
            }
        }

        TEST(Corners, SharpOnesAreTurnedAtAndTheLimitIsKept)
        {
            const SampledPath path = chords({}, {8.0, 8.0}, {PI / 2}, true);
            ReferenceParameters parameters;
            const ReferencePath cut(path, Vehicle(), parameters);
            EXPECT_EQ(cut.corners(), 2u);  // the corner, and the end that the car misses by cutting it so late
            parameters.maxCornerCut = 0.3;
            const ReferencePath turned(path, Vehicle(), parameters);
            EXPECT_EQ(turned.corners(), 1u);
            EXPECT_EQ(turned.cornerTurns(), 1u);
            EXPECT_GT(turned.legs().size(), 3u);
            expectDrivable(turned);
            parameters.maxCornerDeviation = 0.5;
            try
            {
                ReferencePath(path, Vehicle(), parameters);
                ADD_FAILURE() << "not refused";
            }
            catch (const Error &error)
            {
                EXPECT_NE(std::string(error.what()).find("at most 0.5 m are allowed"), std::string::npos);
            }
        }

        TEST(Corners, TheStartMayFaceAnyWay)
        {
            for (const double degrees : {10.0, 30.0, 45.0, 90.0, 135.0, 180.0})
            {
                SampledPath path = chords({}, {10.0, 5.0}, {PI / 4}, true);
                path.front().pose.yaw = degrees * PI / 180.0;
                const ReferencePath reference(path, Vehicle());
                expectDrivable(reference);
                EXPECT_NEAR(wrapAngle(reference.nodes().front().pose.yaw - degrees * PI / 180.0), 0.0, 1e-9);
            }
        }

        TEST(Corners, AManoeuvreBehindAGridPathIsKeptExactly)
        {
            for (const double misfit : {0.0, 0.3, PI / 4})
            {
                SampledPath path = chords({}, {6.0, 6.0}, {PI / 4}, true, 0.5);
                Pose begin = path.back().pose;
                begin.yaw += misfit;
                const SampledPath manoeuvre = arcs(begin, {{0.0, -2.0}, {1.0, -4.0}, {0.0, -3.0}});
                for (std::size_t i = 1; i < manoeuvre.size(); ++i)
                {
                    path.push_back(manoeuvre[i]);
                    path.back().arcLength += 12.0;
                }
                const ReferencePath reference(path, Vehicle());
                expectDrivable(reference);
                // The last 9 metres are the manoeuvre's own poses.
                const std::size_t leg = reference.legs().size() - 1;
                const double end = reference.length();
                for (double back = 0.0; back < reference.legs()[leg].length(); back += 0.1)
                    EXPECT_NEAR(distanceTo(manoeuvre, reference.pose(leg, end - back)), 0.0, 1e-3);
                EXPECT_NEAR(reference.end().x, path.back().pose.x, 1e-9);
            }
        }

        TEST(Corners, ArePlacedAlikeInReverse)
        {
            // The same polyline driven in reverse: the mirror image of the drive.
            SampledPath path = chords({}, {8.0, 8.0}, {PI / 4}, true);
            const ReferencePath forwards(path, Vehicle());
            for (PathState &state : path)
            {
                state.pose.yaw = wrapAngle(state.pose.yaw + PI);
                state.direction = -1;
            }
            const ReferencePath reverse(path, Vehicle());
            EXPECT_NEAR(reverse.cornerDeviation(), forwards.cornerDeviation(), 1e-9);
            ASSERT_EQ(reverse.nodes().size(), forwards.nodes().size());
            for (std::size_t i = 0; i < forwards.nodes().size(); ++i)
            {
                EXPECT_NEAR(reverse.nodes()[i].pose.x, forwards.nodes()[i].pose.x, 1e-9);
                EXPECT_NEAR(reverse.nodes()[i].pose.y, forwards.nodes()[i].pose.y, 1e-9);
                EXPECT_NEAR(reverse.nodes()[i].curvature, -forwards.nodes()[i].curvature, 1e-9);
            }
        }
    }  // namespace
}  // namespace parking::test
