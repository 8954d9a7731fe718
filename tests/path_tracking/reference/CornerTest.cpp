#include "path_tracking/reference/MakeDrivable.h"
#include "path_tracking/reference/ReferencePath.h"

#include "tests/parking_geometry/ExpectError.h"
#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace parking::test
{
    namespace
    {
        using parking_test::expectError;

        /** Distance of a point from a path, by brute force. */
        double distanceTo(const Path &exact, const Pose &point)
        {
            const SampledPath path = exact.sample(0.02);
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

        /** Checks that a car can drive what a reference follows, and that its poses are those of that path. */
        void expectDrivable(const ReferencePath &reference)
        {
            const double most = 1.0 / reference.vehicle().minTurningRadius();
            for (const PathPiece &piece : reference.path().pieces)
            {
                EXPECT_EQ(piece.turn, 0.0);
                EXPECT_LE(std::abs(piece.curvature), most * (1.0 + 1e-9));
                EXPECT_LE(std::abs(piece.endCurvature()), most * (1.0 + 1e-9));
            }
            const Pose off = relativeTo(reference.path().end(), reference.end());
            EXPECT_NEAR(off.x, 0.0, 1e-9);
            EXPECT_NEAR(off.y, 0.0, 1e-9);
            EXPECT_NEAR(off.yaw, 0.0, 1e-9);
        }

        TEST(Corners, AreCutByLittleMoreThanTheInscribedArc)
        {
            const double radius = Vehicle().minTurningRadius();
            for (const double degrees : {0.5, 5.0, 15.0, 26.565, 45.0, 60.0})
            {
                const double angle = degrees * PI / 180.0;
                const Path path = chords({3.0, 1.0, 2.0}, {10.0, 10.0}, {angle});
                const ReferencePath reference(path, Vehicle());
                const double inscribed = radius * (1.0 / std::cos(0.5 * angle) - 1.0);
                EXPECT_EQ(reference.drivable().corners, 1u);
                EXPECT_EQ(reference.drivable().shunts, 0u) << degrees;
                EXPECT_LE(reference.drivable().deviation, inscribed + 0.03) << degrees;
                EXPECT_EQ(reference.legs().size(), 1u);
                expectDrivable(reference);
                // Behind the corner the car is on the path again, exactly unless it takes ten metres to settle.
                const Pose off = relativeTo(path.end(), reference.end());
                EXPECT_LE(std::hypot(off.x, off.y), degrees < 60.0 ? 1e-9 : 0.02) << degrees;
                EXPECT_LE(std::abs(off.yaw), degrees < 60.0 ? 1e-9 : 0.03) << degrees;
            }
        }

        TEST(Corners, APathWithoutThemIsLeftAlone)
        {
            const Path path = randomReedsShepp(4, 20.0);
            const DrivablePath drivable = makeDrivable(path, Vehicle());
            const Path &same = drivable.path;
            ASSERT_EQ(same.pieces.size(), path.pieces.size());
            for (std::size_t i = 0; i < path.pieces.size(); ++i)
            {
                EXPECT_EQ(same.pieces[i].curvature, path.pieces[i].curvature);
                EXPECT_EQ(same.pieces[i].length, path.pieces[i].length);
            }
            EXPECT_EQ(drivable.corners, 0u);
            EXPECT_EQ(drivable.deviation, 0.0);
        }

        TEST(Corners, NonsenseIsRefusedNamingThePiece)
        {
            const auto refused = [](const std::string &words, const Path &path)
            {
                expectError([&] { makeDrivable(path, Vehicle()); }, {words});
            };
            const double most = 1.0 / Vehicle().minTurningRadius();
            PathPiece both(0.0, 1.0);
            both.turn = 1.0;
            EXPECT_NO_THROW(makeDrivable({{}, {{0.0, 1.0}, {1.009 * most, 1.0}}}, Vehicle()));
            refused("path piece 1: curvature", {{}, {{0.0, 1.0}, {1.011 * most, 1.0}}});
            refused("path piece 1: curvature", {{}, {{0.0, 1.0}, {0.0, 2.0, 0.51 * most}}});
            refused("path piece 1: curvature, length", {{}, {{0.0, 1.0}, {0.0, std::nan("")}}});
            refused("path piece 1: it both drives and turns", {{}, {{0.0, 1.0}, both}});
            refused("start", {{std::nan(""), 0.0, 0.0}, {{0.0, 1.0}}});
            // Each piece is too short to be one.
            for (const std::vector<PathPiece> &pieces :
                 std::vector<std::vector<PathPiece>>{{},
                                                     {PathPiece::turnOnTheSpot(1.0)},
                                                     {{0.0, 6e-8}, {0.0, -6e-8}},
                                                     {{0.0, 6e-8}, PathPiece::turnOnTheSpot(1.0), {0.0, 6e-8}}})
                refused("it must have a length", {{}, pieces});
        }

        TEST(Corners, TheStatedDeviationHolds)
        {
            for (std::uint64_t seed = 0; seed < 30; ++seed)
            {
                const Path path = randomGridPath(seed, {0.0, 0.0, 0.1 * static_cast<double>(seed)}, 40, 5);
                const ReferencePath reference(path, Vehicle());
                expectDrivable(reference);
                double farthest = 0.0;
                for (const PathState &state : reference.path().sample(0.1))
                    farthest = std::max(farthest, distanceTo(path, state.pose));
                EXPECT_LE(farthest, reference.drivable().deviation + 0.01) << seed;
                EXPECT_GT(reference.drivable().deviation, 0.0) << seed;
                // However it was driven, it ends at the last pose.
                const Pose end = relativeTo(path.end(), reference.end());
                EXPECT_LE(std::hypot(end.x, end.y), 0.021) << seed;
                EXPECT_LE(std::abs(end.yaw), 0.03) << seed;
            }
        }

        TEST(Corners, SharpOnesAreTurnedAtAndTheLimitIsKept)
        {
            const Path path = chords({}, {8.0, 8.0}, {PI / 2});
            ReferenceParameters parameters;
            const ReferencePath cut(path, Vehicle(), parameters);
            EXPECT_EQ(cut.drivable().corners, 1u);
            EXPECT_GT(cut.drivable().deviation, 0.3);
            parameters.maxCornerCut = 0.3;
            const ReferencePath turned(path, Vehicle(), parameters);
            EXPECT_EQ(turned.drivable().corners, 1u);
            EXPECT_EQ(turned.drivable().shunts, 1u);
            EXPECT_GT(turned.legs().size(), 3u);
            expectDrivable(turned);
            parameters.maxCornerRadii = 0.5 / Vehicle().minTurningRadius();
            expectError([&] { ReferencePath(path, Vehicle(), parameters); }, {"at most 0.5 m are allowed"});
        }

        TEST(Corners, TheStartMayFaceAnyWay)
        {
            for (const double degrees : {10.0, 30.0, 45.0, 90.0, 135.0, 180.0})
            {
                Path path = chords({}, {10.0, 5.0}, {PI / 4});
                path.start.yaw = degrees * PI / 180.0;
                path.pieces.insert(path.pieces.begin(), PathPiece::turnOnTheSpot(-path.start.yaw));
                const ReferencePath reference(path, Vehicle());
                expectDrivable(reference);
                EXPECT_NEAR(wrapAngle(reference.pose(0, 0.0).yaw - path.start.yaw), 0.0, 1e-9);
            }
        }

        TEST(Corners, TheEndMayFaceAnyWay)
        {
            for (const double degrees : {10.0, -45.0, 180.0})
            {
                Path path = chords({}, {6.0, 5.0}, {PI / 4});
                path.append(PathPiece::turnOnTheSpot(degrees * PI / 180.0));
                const ReferencePath reference(path, Vehicle());
                expectDrivable(reference);
                const Pose off = relativeTo(path.end(), reference.end());
                EXPECT_LE(std::hypot(off.x, off.y), 1e-5) << degrees;
                EXPECT_LE(std::abs(off.yaw), 1e-5) << degrees;
            }
        }

        TEST(Corners, AManoeuvreBehindAGridPathIsKeptExactly)
        {
            for (const double misfit : {0.0, 0.3, PI / 4})
            {
                Path path = chords({}, {6.0, 6.0}, {PI / 4});
                path.append(PathPiece::turnOnTheSpot(misfit));
                const Path manoeuvre = arcs(path.end(), {{0.0, -2.0}, {1.0, -4.0}, {0.0, -3.0}});
                path.extend(manoeuvre);
                const ReferencePath reference(path, Vehicle());
                expectDrivable(reference);
                // The arc and the last line are the manoeuvre's own; a metre of the first may lead there.
                const Path &driven = reference.path();
                ASSERT_GE(driven.pieces.size(), 3u);
                const PathPiece &last = driven.pieces.back(), &turn = driven.pieces[driven.pieces.size() - 2];
                EXPECT_NEAR(last.length, -3.0, 1e-9);
                EXPECT_NEAR(turn.length, -4.0, 1e-9);
                EXPECT_EQ(last.curvature, 0.0);
                EXPECT_EQ(turn.curvature, manoeuvre.pieces[1].curvature);
                EXPECT_NEAR(reference.end().x, path.end().x, 1e-9);
                EXPECT_NEAR(reference.end().y, path.end().y, 1e-9);
                EXPECT_NEAR(wrapAngle(reference.end().yaw - path.end().yaw), 0.0, 1e-9);
            }
        }

        TEST(Corners, ArePlacedAlikeInReverse)
        {
            // The same polyline driven in reverse: the mirror image of the drive.
            Path path = chords({}, {8.0, 8.0}, {PI / 4});
            const ReferencePath forwards(path, Vehicle());
            path.start.yaw += PI;
            for (PathPiece &piece : path.pieces)
                piece.length = -piece.length;
            const ReferencePath reverse(path, Vehicle());
            EXPECT_NEAR(reverse.drivable().deviation, forwards.drivable().deviation, 1e-9);
            ASSERT_EQ(reverse.legs().size(), 1u);
            ASSERT_EQ(forwards.legs().size(), 1u);
            EXPECT_NEAR(reverse.length(), forwards.length(), 1e-9);
            for (double s = 0.0; s < forwards.length(); s += 0.1)
            {
                const Pose one = reverse.pose(0, s), other = forwards.pose(0, s);
                EXPECT_NEAR(one.x, other.x, 1e-9);
                EXPECT_NEAR(one.y, other.y, 1e-9);
                EXPECT_NEAR(reverse.steering(0, s), -forwards.steering(0, s), 1e-9);
            }
        }
    }  // namespace
}  // namespace parking::test
