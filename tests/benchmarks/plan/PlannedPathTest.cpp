// What readPath() makes of the motions of a plain SE2 space, which no car can make: a path in the terms of a car.

#include "benchmarks/plan/PlannedPath.h"

#include "parking_geometry/Error.h"
#include "state_validity/ompl/OmplPose.h"
#include "tests/automatic_parking/ParkingProblems.h"

#include <gtest/gtest.h>

#include <ompl/base/ScopedState.h>

#include <cmath>
#include <memory>
#include <vector>

namespace
{
    using namespace parking;

    /** A field without obstacles but for a far one, and its car. */
    const Problem &field()
    {
        static const std::unique_ptr<Problem> problem = []
        {
            ProblemSettings settings;
            settings.space = SpaceKind::SE2;
            settings.footprint = FootprintKind::Circle;
            return std::make_unique<Problem>(parking_test::openGround(20.0), settings);
        }();
        return *problem;
    }

    PlannedPath planned(const std::vector<Pose> &poses)
    {
        ompl::geometric::PathGeometric path(field().spaceInformation());
        ompl::base::ScopedState<> state(field().spaceInformation());
        for (const Pose &pose : poses)
        {
            setPose(state.get(), pose);
            path.append(state.get());
        }
        return readPath(field(), path, false);
    }

    void expectAt(const Pose &pose, const Pose &wanted)
    {
        EXPECT_NEAR(pose.x, wanted.x, 1e-9);
        EXPECT_NEAR(pose.y, wanted.y, 1e-9);
        EXPECT_NEAR(wrapAngle(pose.yaw - wanted.yaw), 0.0, 1e-8);
    }

    std::size_t turns(const Path &path)
    {
        std::size_t count = 0;
        for (const PathPiece &piece : path.pieces)
            count += piece.turn != 0.0;
        return count;
    }

    TEST(PlannedPath, GridPathsAreLinesAndTurnsOnTheSpot)
    {
        const double diagonal = 0.25 * PI;
        const PlannedPath path = planned(
            {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, diagonal}, {3, 1, diagonal}, {3, 1, 0}, {4, 1, 0}, {4, 1, 0.5}});
        ASSERT_EQ(path.path.pieces.size(), 6u);
        EXPECT_EQ(turns(path.path), 3u);
        EXPECT_NEAR(path.path.pieces[0].length, 2.0, 1e-12);
        EXPECT_NEAR(path.path.pieces[1].turn, diagonal, 1e-12);
        EXPECT_NEAR(path.path.pieces[2].length, std::sqrt(2.0), 1e-12);
        EXPECT_NEAR(path.length, 3.0 + std::sqrt(2.0), 1e-9);
        expectAt(path.path.end(), {4, 1, 0.5});
    }

    TEST(PlannedPath, MotionsAcrossTheHeadingBecomeTurnsAndALine)
    {
        const PlannedPath path = planned({{0, 0, 0}, {3, 3, 0.1}, {0, 4, -0.4}});
        EXPECT_EQ(turns(path.path), 3u);
        EXPECT_NEAR(path.path.length(), path.length, 1e-9);
        // The second motion goes back: its direction is nearer to the reverse of the mean heading.
        EXPECT_EQ(path.path.pieces.back().direction() + path.path.pieces[path.path.pieces.size() - 2].direction(), -1);
        EXPECT_EQ(path.cusps, 1u);
        expectAt(path.path.end(), {0, 4, -0.4});
    }

    TEST(PlannedPath, SmoothCurvesKeepTheirShapeWithoutCorners)
    {
        // States on a clothoid and an arc, forwards and in reverse; the motions between them are OMPL's straight ones.
        for (const double direction : {1.0, -1.0})
        {
            const Path curve{{}, {{0.0, direction * 4.0, 0.05}, {0.2, direction * 5.0}}};
            std::vector<Pose> poses;
            for (const PathState &state : curve.sample(0.3))
                poses.push_back(state.pose);
            const PlannedPath path = planned(poses);
            EXPECT_EQ(turns(path.path), 0u);
            EXPECT_EQ(path.cusps, 0u);
            EXPECT_NEAR(path.path.length(), curve.length(), 1e-3);
            expectAt(path.path.end(), poses.back());
            for (const PathPiece &piece : path.path.pieces)
                EXPECT_LE(std::abs(piece.curvature), 0.21);
            EXPECT_LE(field().closedLoop().drive(path.path).evaluation.finalPositionError, 0.01);
        }
    }

    TEST(PlannedPath, TurnsTooSharpForTheCarAreCorners)
    {
        const double sharp = 2.0 / field().scenario().vehicle.minTurningRadius();
        const Path curve{{}, {{0.0, 3.0}, {sharp, 1.0}, {0.0, 4.0}}};
        std::vector<Pose> poses;
        for (const PathState &state : curve.sample(0.2))
            poses.push_back(state.pose);
        const PlannedPath path = planned(poses);
        EXPECT_GE(turns(path.path), 5u);
        expectAt(path.path.end(), poses.back());
        const DriveResult drive = field().closedLoop().drive(path.path);
        EXPECT_TRUE(drive.arrived) << drive.message;
        EXPECT_LE(drive.evaluation.finalPositionError, 0.03);
        EXPECT_GT(drive.evaluation.cornerDeviation, 0.01);
    }

    TEST(PlannedPath, WhatDoesNotMoveCannotBeDriven)
    {
        EXPECT_THROW(field().closedLoop().drive(planned({{0, 0, 0}}).path), Error);
        EXPECT_THROW(field().closedLoop().drive(planned({{0, 0, 0}, {0, 0, 1.0}}).path), Error);
    }
}  // namespace
