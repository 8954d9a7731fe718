#include "parking_geometry/smoothing/CurvatureProgram.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;

namespace
{
    using Interval = CurvatureProgram::Interval;
    using State = CurvatureProgram::State;

    /** Arcs (curvature, length) cut into intervals of about a decimetre. */
    std::vector<Interval> intervals(const std::vector<std::pair<double, double>> &arcs, double maxRate)
    {
        std::vector<Interval> result;
        for (const auto &[curvature, length] : arcs)
        {
            const int count = static_cast<int>(std::ceil(length / 0.1));
            for (int i = 0; i < count; ++i)
                result.push_back({length / count, curvature, maxRate});
        }
        return result;
    }

    CurvatureProgram::Settings settings(double maxRate)
    {
        CurvatureProgram::Settings result;
        result.maxCurvature = 0.3;
        result.softRate = maxRate;
        return result;
    }

    void expectWithinLimits(const CurvatureProgram &program, const std::vector<Interval> &given)
    {
        const std::vector<State> &states = program.states();
        ASSERT_EQ(states.size(), given.size() + 1);
        for (const State &state : states)
            EXPECT_LE(std::abs(state[2]), 0.3);
        for (std::size_t i = 0; i < given.size(); ++i)
            EXPECT_LE(std::abs(states[i + 1][2] - states[i][2]), given[i].maxRate * given[i].length * (1.0 + 1e-9));
        EXPECT_EQ(states.front()[0], 0.0);
        EXPECT_EQ(states.front()[1], 0.0);
        EXPECT_NEAR(states.back()[0], 0.0, 1e-5);
        EXPECT_NEAR(states.back()[1], 0.0, 1e-5);
    }
}  // namespace

TEST(CurvatureProgram, FindsAProfileWithinTheLimits)
{
    for (const double rate : {0.15, 0.4, 1.0, 4.0})
        for (const auto &arcs :
             std::vector<std::vector<std::pair<double, double>>>{{{0.29, 2.0}, {0.0, 4.0}},
                                                                 {{0.0, 3.0}, {-0.29, 3.0}, {0.0, 3.0}},
                                                                 {{0.2, 2.0}, {-0.2, 2.0}, {0.0, 3.0}}})
        {
            const std::vector<Interval> given = intervals(arcs, rate);
            CurvatureProgram program;
            program.reset(settings(rate), given, {});
            ASSERT_TRUE(program.solve()) << rate;
            expectWithinLimits(program, given);
        }
}

TEST(CurvatureProgram, SaysWhenThereIsNone)
{
    // From full lock to full lock there is no other way to the same end.
    const std::vector<Interval> given = intervals({{0.3, 1.5}, {-0.3, 1.5}}, 0.5);
    CurvatureProgram program;
    program.reset(settings(0.5), given, {});
    EXPECT_FALSE(program.solve());
    // A corridor that leaves no room for the transition.
    const std::vector<Interval> corner = intervals({{0.0, 3.0}, {0.25, 3.0}, {0.0, 3.0}}, 0.15);
    std::vector<CurvatureProgram::Corridor> corridors(corner.size() + 1);
    program.reset(settings(0.15), corner, corridors);
    EXPECT_TRUE(program.solve());
    for (CurvatureProgram::Corridor &corridor : corridors)
        corridor = {-1e-4, 1e-4};
    program.reset(settings(0.15), corner, corridors);
    EXPECT_FALSE(program.solve());
}

TEST(CurvatureProgram, KeepsCorridorsOnEitherSide)
{
    const std::vector<Interval> given = intervals({{0.0, 3.0}, {0.2, 4.0}, {0.0, 3.0}}, 0.3);
    CurvatureProgram program;
    program.reset(settings(0.3), given, {});
    ASSERT_TRUE(program.solve());
    double low = 0.0, high = 0.0;
    for (const State &state : program.states())
    {
        low = std::min(low, state[0]);
        high = std::max(high, state[0]);
    }
    ASSERT_LT(low, -1.5e-3);
    ASSERT_GT(high, 1.5e-3);
    // A short body: a long one that must not swing out needs a long way back to the reference.
    CurvatureProgram::Settings values = settings(0.3);
    values.front = 0.5;
    values.rear = 0.4;
    for (const bool upper : {false, true})
    {
        // Almost nothing on one side, plenty on the other.
        std::vector<CurvatureProgram::Corridor> corridors(given.size() + 1);
        for (CurvatureProgram::Corridor &corridor : corridors)
            corridor = upper ? CurvatureProgram::Corridor{-0.5, 1e-3} : CurvatureProgram::Corridor{-1e-3, 0.5};
        program.reset(values, given, corridors);
        ASSERT_TRUE(program.solve()) << upper;
        expectWithinLimits(program, given);
        const std::vector<State> &states = program.states();
        for (std::size_t i = 1; i + 1 < states.size(); ++i)
            for (const double arm : {values.front, -values.rear})
            {
                const double end = states[i][0] + arm * states[i][1];
                EXPECT_GE(end, corridors[i].low);
                EXPECT_LE(end, corridors[i].high);
            }
    }
}

TEST(CurvatureProgram, SensitivityIsThatOfTheModel)
{
    const std::vector<Interval> given = intervals({{0.1, 2.0}, {-0.2, 3.0}}, 0.5);
    CurvatureProgram program;
    program.reset(settings(0.5), given, {});
    ASSERT_TRUE(program.solve());
    std::vector<Eigen::Vector2d> sensitivity;
    program.endSensitivity(sensitivity);
    // The first-order model, y' = psi and psi' = k - kRef - kRef^2 y, in small steps with linear curvature.
    const auto end = [&](const std::vector<double> &k)
    {
        Eigen::Vector2d x(0.0, 0.0);
        for (std::size_t i = 0; i < given.size(); ++i)
            for (int step = 0; step < 200; ++step)
            {
                const double h = given[i].length / 200, share = (step + 0.5) / 200, reference = given[i].curvature;
                const double curvature = k[i] + share * (k[i + 1] - k[i]);
                const double turn = curvature - reference - reference * reference * x[0];
                x += h * Eigen::Vector2d(x[1] + 0.5 * h * turn, turn);
            }
        return x;
    };
    std::vector<double> k;
    for (const State &state : program.states())
        k.push_back(state[2]);
    const Eigen::Vector2d base = end(k);
    for (std::size_t i = 0; i < k.size(); i += 7)
    {
        std::vector<double> changed = k;
        changed[i] += 1e-3;
        EXPECT_LT(((end(changed) - base) / 1e-3 - sensitivity[i]).norm(), 2e-3 * (1.0 + sensitivity[i].norm())) << i;
    }
}
