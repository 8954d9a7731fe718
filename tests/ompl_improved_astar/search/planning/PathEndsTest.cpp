// The ends of paths: starts at a goal, straights, and starts in contact.

#include "benchmarks/worlds/RandomWorlds.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Error.h"
#include "tests/ompl_improved_astar/search/CarWorlds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    const Vehicle CAR;
    const Box FIELD{{-25.0, -25.0}, {25.0, 25.0}};

    PlanResult planned(const std::vector<Polygon> &walls, const Pose &start, const std::vector<Pose> &goals,
                       const PlannerParameters &parameters, bool forwardOnly = false)
    {
        const FootprintChecker checker(ObstacleSet::fromPolygons(walls, FIELD), CAR);
        FootprintEnvironment environment(checker, FIELD, FootprintEnvironment::TOLERANCE);
        PlanRequest request;
        request.starts = {start};
        request.goals = goals;
        request.car = carInSpace(CAR, 0.0, FIELD);
        request.car.forwardOnly = forwardOnly;
        request.parameters = parameters;
        request.maxExpansions = 20000;
        return plan(environment, request);
    }

    PlannerParameters with(double PlannerParameters::*member, double value)
    {
        PlannerParameters parameters;
        parameters.*member = value;
        return parameters;
    }

    /** Metres of straight drive in one direction at the beginning of the pieces. */
    double straightOf(const std::vector<PathPiece> &pieces)
    {
        double length = 0.0;
        for (const PathPiece &piece : pieces)
        {
            if (piece.curvature != 0.0 || piece.length * pieces.front().length < 0.0)
                break;
            length += piece.driven();
        }
        return length;
    }

    double straightAtEnd(const Path &path)
    {
        return straightOf(path.reversed().pieces);
    }

    /** A wall so many metres ahead of the bumper of a car at the origin. */
    Polygon wallAhead(double gap)
    {
        return rectangle(2.0, 40.0, {CAR.wheelbase + CAR.frontOverhang + gap + 1.0, 0.0, 0.0});
    }
}  // namespace

TEST(PathEnds, AStartWithinTheToleranceIsAtTheGoal)
{
    const Pose start{3.0, -2.0, 1.0};
    for (const char *model : {"car", "grid8"})
        for (const bool anytime : {false, true})
        {
            PlannerParameters parameters;
            parameters.motionModel = model;
            parameters.anytime = anytime;
            parameters.finalStraight = 2.0;
            for (const Pose &off : {Pose{0.0, 0.0, 0.0}, {9e-6, 0.0, 9e-6}, {0.0, -9e-6, -9e-6}})
            {
                const PlanResult result = planned({}, start, {{9.0, 9.0, 0.0}, compose(start, off)}, parameters);
                EXPECT_EQ(result.outcome, PlanOutcome::Solved);
                EXPECT_TRUE(result.path.pieces.empty());
                EXPECT_TRUE(isSamePose(result.path.start, start, 0.0));
                EXPECT_EQ(result.goal, 1u);
                EXPECT_EQ(result.cost, 0.0);
                EXPECT_EQ(result.suboptimalityBound, 1.0);
            }
        }
    for (const Pose &off : {Pose{0.0, 1.1e-5, 0.0}, {0.0, 0.0, 1.1e-5}})
    {
        const PlanResult result = planned({}, start, {compose(start, off)}, {});
        EXPECT_EQ(result.outcome, PlanOutcome::Solved);
        EXPECT_GT(result.path.length(), 0.01);
        EXPECT_TRUE(isSamePose(result.path.end(), compose(start, off), 1e-9));
    }
    // Zero is the tolerance of equal poses; one centimetre is far.
    EXPECT_GT(planned({}, start, {compose(start, {0.0, 9e-6, 0.0})}, with(&PlannerParameters::goalTolerance, 0.0))
                  .path.length(),
              0.01);
    EXPECT_TRUE(planned({}, start, {compose(start, {0.0, 9e-3, 0.0})}, with(&PlannerParameters::goalTolerance, 0.01))
                    .path.pieces.empty());
    // A goal in collision is not a goal, however near.
    EXPECT_NE(planned({wallAhead(5e-6)}, {}, {{6e-6, 0.0, 0.0}}, {}).outcome, PlanOutcome::Solved);
}

TEST(PathEnds, TheLastMetresAreStraight)
{
    const Pose start{-12.0, -9.0, 0.3}, goal{4.0, 2.0, 2.0};
    EXPECT_LT(straightAtEnd(planned({}, start, {goal}, {}).path), 1.0);
    for (const bool anytime : {false, true})
        for (const double length : {0.5, 2.0, 5.0})
        {
            PlannerParameters parameters = with(&PlannerParameters::finalStraight, length);
            parameters.anytime = anytime;
            const PlanResult result = planned({}, start, {goal}, parameters);
            ASSERT_EQ(result.outcome, PlanOutcome::Solved);
            EXPECT_GE(straightAtEnd(result.path), length - 1e-9);
            EXPECT_TRUE(isSamePose(result.path.start, start, 1e-12));
            EXPECT_TRUE(isSamePose(result.path.end(), goal, 1e-9));
            EXPECT_GE(result.cost, result.path.length() - 1e-9);
            EXPECT_GE(result.suboptimalityBound, 1.0);
            EXPECT_EQ(result.notice, "");
        }
}

TEST(PathEnds, TheFirstMetresAreStraight)
{
    const Pose start{-12.0, -9.0, 1.3}, goal{4.0, 2.0, 2.0};
    PlannerParameters parameters = with(&PlannerParameters::initialStraight, 3.0);
    EXPECT_LT(straightOf(planned({}, start, {goal}, {}).path.pieces), 3.0);
    EXPECT_GE(straightOf(planned({}, start, {goal}, parameters).path.pieces), 3.0 - 1e-9);
    parameters.finalStraight = 2.0;
    const PlanResult both = planned({}, start, {goal}, parameters, true);
    ASSERT_EQ(both.outcome, PlanOutcome::Solved);
    EXPECT_GE(straightOf(both.path.pieces), 3.0 - 1e-9);
    EXPECT_GE(straightAtEnd(both.path), 2.0 - 1e-9);
    // Forwards only, even where a straight in reverse would save a part of the way.
    const PlanResult away = planned({}, {}, {{-14.0, 0.0, 0.0}}, parameters, true);
    ASSERT_EQ(away.outcome, PlanOutcome::Solved);
    for (const PlanResult *result : {&both, &away})
        for (const PathPiece &piece : result->path.pieces)
            EXPECT_GT(piece.length, 0.0);
}

TEST(PathEnds, AStraightIsAsLongAsThereIsRoom)
{
    // A goal in front of a wall: behind it there is room, unless the car must come from ahead.
    const Pose start{-12.0, 6.0, 0.0}, goal{0.0, 0.0, 0.0};
    const PlanResult behind = planned({wallAhead(0.5)}, start, {goal}, with(&PlannerParameters::finalStraight, 4.0));
    ASSERT_EQ(behind.outcome, PlanOutcome::Solved);
    EXPECT_GE(straightAtEnd(behind.path), 4.0 - 1e-9);
    EXPECT_GT(behind.path.pieces.back().length, 0.0);
    // A second wall behind the car leaves less room than required, and the result says so.
    const Polygon wall = rectangle(1.0, 3.0, {-CAR.rearOverhang - 1.5 - 0.5, 0.0, 0.0});
    const PlanResult cut =
        planned({wallAhead(6.0), wall}, {2.0, 8.0, 0.0}, {goal}, with(&PlannerParameters::finalStraight, 8.0));
    ASSERT_EQ(cut.outcome, PlanOutcome::Solved);
    EXPECT_NEAR(straightAtEnd(cut.path), 5.9, 0.01) << "keeps the preferred clearance of 10 cm";
    EXPECT_EQ(cut.notice, "final_straight: only 5.90 of 8.00 m are free");
    // Without a path the straights may be the reason.
    const Polygon across = rectangle(1.0, 60.0, {-6.0, 0.0, 0.0});
    const PlanResult none = planned({across}, start, {goal}, with(&PlannerParameters::finalStraight, 2.0));
    EXPECT_EQ(none.outcome, PlanOutcome::Approximate);
    EXPECT_NE(none.notice.find("try shorter"), std::string::npos) << none.notice;
    EXPECT_EQ(planned({across}, start, {goal}, {}).notice, "");
}

TEST(PathEnds, AStartInContactIsLedOutIfRequired)
{
    const Pose start, goal{-12.0, 6.0, 0.0};
    const std::vector<Polygon> walls{wallAhead(-0.03)};
    EXPECT_EQ(planned(walls, start, {goal}, {}).outcome, PlanOutcome::InvalidStart);
    PlannerParameters parameters;
    parameters.escape = true;
    parameters.finalStraight = 1.0;
    const PlanResult result = planned(walls, start, {goal}, parameters);
    ASSERT_EQ(result.outcome, PlanOutcome::Escaped) << "not Solved";
    ASSERT_TRUE(result.escape);
    EXPECT_NEAR(result.escape->depth, 0.03, 1e-5);
    EXPECT_TRUE(isSamePose(result.path.start, start, 0.0));
    EXPECT_TRUE(isSamePose(result.path.end(), goal, 1e-9));
    EXPECT_GE(straightAtEnd(result.path), 1.0 - 1e-9);
    EXPECT_NE(result.notice.find("3.0 cm deep"), std::string::npos) << result.notice;
    EXPECT_NE(result.notice.find("in reverse"), std::string::npos) << result.notice;
    // The oracle finds the rest of the path free.
    const PolygonOracle oracle(walls, FIELD);
    EXPECT_TRUE(oracle.isPathFree(result.path.rest(std::abs(result.escape->arc.length) + 1e-9), CAR, 0.01));
    EXPECT_FALSE(oracle.isPathFree(result.path, CAR, 0.01));
    // Deeper than allowed, by either side of the boundary.
    for (const double max : {0.0299, 0.0301})
    {
        parameters.maxEscapeDepth = max;
        const PlanResult limited = planned(walls, start, {goal}, parameters);
        EXPECT_EQ(limited.outcome, max < 0.03 ? PlanOutcome::InvalidStart : PlanOutcome::Escaped);
        EXPECT_EQ(limited.reason.find("max_escape_depth") != std::string::npos, max < 0.03) << limited.reason;
    }
    // A free start has no escape; neither has a car that cannot reverse here.
    parameters.maxEscapeDepth = 0.05;
    EXPECT_EQ(planned({wallAhead(0.1)}, start, {goal}, parameters).outcome, PlanOutcome::Solved);
    EXPECT_EQ(planned(walls, start, {goal}, parameters, true).outcome, PlanOutcome::InvalidStart);
    // Without a way to the goal the approximate path begins with the escape, too.
    const PlanResult caged =
        planned({wallAhead(-0.03), rectangle(1.0, 50.0, {-9.0, 0.0, 0.0})}, start, {goal}, parameters);
    EXPECT_EQ(caged.outcome, PlanOutcome::Approximate);
    ASSERT_TRUE(caged.escape);
    EXPECT_TRUE(isSamePose(caged.path.start, start, 0.0));
    // Worlds that cannot measure depths have no escapes.
    DiscCarWorld discs({{-30.0, -30.0}, {3.5, 30.0}});
    PlanRequest request;
    request.starts = {start};
    request.goals = {goal};
    request.car = carInSpace(CAR, 0.0, discs.inside);
    request.parameters = parameters;
    EXPECT_EQ(plan(discs, request).outcome, PlanOutcome::InvalidStart);
}

TEST(PathEnds, ParametersOutOfRangeAreNamed)
{
    constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
    const struct
    {
        double PlannerParameters::*member;
        const char *name;
        double value;
    } CASES[]{{&PlannerParameters::finalStraight, "final_straight", -1.0},
              {&PlannerParameters::finalStraight, "final_straight", NOT_A_NUMBER},
              {&PlannerParameters::initialStraight, "initial_straight", HUGE_VAL},
              {&PlannerParameters::maxEscapeDepth, "max_escape_depth", -0.01},
              {&PlannerParameters::maxEscapeDepth, "max_escape_depth", 0.51},
              {&PlannerParameters::goalTolerance, "goal_tolerance", -1e-9}};
    for (const auto &each : CASES)
        try
        {
            planned({}, {}, {{5.0, 0.0, 0.0}}, with(each.member, each.value));
            ADD_FAILURE() << each.name;
        }
        catch (const Error &error)
        {
            EXPECT_EQ(std::string(error.what()).find(each.name), 0u) << error.what();
        }
}
