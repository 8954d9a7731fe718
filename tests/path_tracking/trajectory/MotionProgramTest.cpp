#include "benchmarks/worlds/Random.h"
#include "path_tracking/trajectory/program/InteriorPoint.h"
#include "path_tracking/trajectory/program/MotionProgram.h"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/Dense>

#include <cmath>
#include <vector>

namespace parking
{
    namespace
    {
        using parking_test::Random;
        using Nodes = std::vector<NodeVector>;

        /** Two stretches with standstills round them, at random, with rows of both kinds at random poses. */
        MotionProblem randomProblem(std::uint64_t seed)
        {
            Random random(seed);
            MotionProblem problem;
            problem.weights = {1.0, 0.3, 0.2, 0.7};
            problem.clearance = 3.0;
            problem.directions = {0, 1, 1, 1, 0, -1, -1, 0};
            for (std::size_t k = 0; k <= problem.directions.size(); ++k)
            {
                NodeVector node;
                node << random.between(-2.0, 2.0), random.between(-2.0, 2.0), random.between(-3.0, 3.0),
                    random.between(0.1, 2.0), random.between(-0.7, 0.7), random.between(0.2, 0.6);
                problem.nodes.push_back(node);
                problem.fixed.push_back(0);
            }
            problem.fixed.front() = 0b00111;
            problem.fixed.back() = 0b110111;
            for (const std::size_t interval : {1U, 2U, 5U})
                for (const double fraction : {0.3, 1.0})
                {
                    const std::size_t first = problem.rows.size();
                    for (int i = 0; i < 3; ++i)
                    {
                        const double angle = random.between(-3.0, 3.0);
                        problem.rows.push_back({random.below(2) == 0,
                                                {std::cos(angle), std::sin(angle)},
                                                {random.between(-4.0, 4.0), random.between(-4.0, 4.0)},
                                                random.between(-1.0, 1.0)});
                    }
                    problem.checkpoints.push_back({interval, fraction, first, problem.rows.size(), 0.4});
                }
            return problem;
        }

        MotionDuals randomDuals(const MotionProgram &program, std::uint64_t seed, double slack)
        {
            Random random(seed);
            MotionDuals duals;
            for (std::size_t k = 0; k < program.intervals(); ++k)
                duals.joints.emplace_back(random.between(-3.0, 3.0), random.between(-3.0, 3.0),
                                          random.between(-3.0, 3.0), random.between(-3.0, 3.0));
            for (std::size_t i = 0; i < program.inequalities(); ++i)
            {
                duals.prices.push_back(random.between(0.1, 2.0));
                duals.slacks.push_back(slack);
            }
            return duals;
        }

        double lagrangian(MotionProgram &program, const Nodes &nodes, const MotionDuals &duals)
        {
            std::vector<Eigen::Vector4d> joints;
            std::vector<double> values;
            double sum = program.evaluate(nodes, joints, values);
            for (std::size_t k = 0; k < joints.size(); ++k)
                sum += duals.joints[k].dot(joints[k]);
            for (std::size_t i = 0; i < values.size(); ++i)
                sum -= duals.prices[i] * values[i];
            return sum;
        }

        void linearizeAt(MotionProgram &program, const Nodes &nodes, const MotionDuals &duals, double softness)
        {
            std::vector<Eigen::Vector4d> joints;
            std::vector<double> values;
            program.evaluate(nodes, joints, values);
            program.linearize(duals, softness);
        }

        TEST(MotionProgram, GradientsAgreeWithDifferences)
        {
            constexpr double STEP = 1e-6;
            for (std::uint64_t seed = 1; seed <= 20; ++seed)
            {
                MotionProgram program(randomProblem(seed));
                const MotionDuals duals = randomDuals(program, seed, 1.0);
                const Nodes nodes = program.problem().nodes;
                linearizeAt(program, nodes, duals, 1.0);
                for (std::size_t k = 0; k < nodes.size(); ++k)
                    for (int e = 0; e < NODE_SIZE; ++e)
                    {
                        if (program.problem().isFixed(k, e))
                            continue;
                        Nodes up = nodes, down = nodes;
                        up[k][e] += STEP;
                        down[k][e] -= STEP;
                        const double slope =
                            (lagrangian(program, up, duals) - lagrangian(program, down, duals)) / (2.0 * STEP);
                        EXPECT_NEAR(program.gradient()[k][e], slope, 1e-6 * (1.0 + std::abs(slope)))
                            << "seed " << seed << ", node " << k << ", entry " << e;
                    }
            }
        }

        TEST(MotionProgram, SecondDerivativesAgreeWithDifferences)
        {
            // With soft joints and wide slacks the system is the Hessian of the Lagrangian alone.
            constexpr double STEP = 1e-6, WIDE = 1e12;
            for (std::uint64_t seed = 1; seed <= 20; ++seed)
            {
                MotionProgram program(randomProblem(seed)), other(randomProblem(seed));
                const MotionDuals duals = randomDuals(program, seed, WIDE);
                const Nodes nodes = program.problem().nodes;
                linearizeAt(program, nodes, duals, WIDE);
                for (std::size_t k = 0; k < nodes.size(); ++k)
                    for (int e = 0; e < NODE_SIZE; ++e)
                    {
                        if (program.problem().isFixed(k, e))
                            continue;
                        Nodes up = nodes, down = nodes;
                        up[k][e] += STEP;
                        down[k][e] -= STEP;
                        linearizeAt(other, up, duals, WIDE);
                        const Nodes above = other.gradient();
                        linearizeAt(other, down, duals, WIDE);
                        const Nodes below = other.gradient();
                        for (int f = 0; f < NODE_SIZE; ++f)
                        {
                            const double own = (above[k][f] - below[k][f]) / (2.0 * STEP);
                            EXPECT_NEAR(program.system().diagonal[k](f, e), program.problem().isFixed(k, f) ? 0.0 : own,
                                        1e-5 * (1.0 + std::abs(own)))
                                << "seed " << seed << ", node " << k << ", entries " << e << ", " << f;
                            if (k + 1 == nodes.size())
                                continue;
                            const double next = (above[k + 1][f] - below[k + 1][f]) / (2.0 * STEP);
                            EXPECT_NEAR(program.system().below[k](f, e), next, 1e-5 * (1.0 + std::abs(next)))
                                << "seed " << seed << ", node " << k << ", entries " << e << ", " << f;
                        }
                    }
            }
        }

        TEST(MotionProgram, StepsOfJointsAndInequalitiesAgreeWithDifferences)
        {
            constexpr double STEP = 1e-6;
            for (std::uint64_t seed = 1; seed <= 20; ++seed)
            {
                MotionProgram program(randomProblem(seed));
                const Nodes nodes = program.problem().nodes;
                linearizeAt(program, nodes, randomDuals(program, seed, 1.0), 1.0);
                Random random(100 + seed);
                Nodes step = nodes, up = nodes, down = nodes;
                for (std::size_t k = 0; k < nodes.size(); ++k)
                {
                    for (int e = 0; e < NODE_SIZE; ++e)
                        step[k][e] = program.problem().isFixed(k, e) ? 0.0 : random.between(-1.0, 1.0);
                    up[k] += STEP * step[k];
                    down[k] -= STEP * step[k];
                }
                std::vector<Eigen::Vector4d> joints, jointsUp, jointsDown;
                std::vector<double> values, valuesUp, valuesDown;
                program.apply(step, joints, values);
                program.evaluate(up, jointsUp, valuesUp);
                program.evaluate(down, jointsDown, valuesDown);
                for (std::size_t k = 0; k < joints.size(); ++k)
                    EXPECT_LT((joints[k] - (jointsUp[k] - jointsDown[k]) / (2.0 * STEP)).norm(), 1e-6) << k;
                for (std::size_t i = 0; i < values.size(); ++i)
                    EXPECT_NEAR(values[i], (valuesUp[i] - valuesDown[i]) / (2.0 * STEP), 1e-6) << i;
            }
        }

        TEST(MotionProgram, TheRightSideIsWhatNewtonsStepsOfPricesAndJointsLeave)
        {
            // With inequalities and joints eliminated: the gradient with the prices and joints of a step of no length.
            constexpr double BARRIER = 0.3, SOFTNESS = 0.2, SLACK = 0.7;
            for (std::uint64_t seed = 1; seed <= 20; ++seed)
            {
                MotionProgram program(randomProblem(seed)), other(randomProblem(seed));
                const Nodes nodes = program.problem().nodes;
                MotionDuals duals = randomDuals(program, seed, SLACK);
                linearizeAt(program, nodes, duals, SOFTNESS);
                std::vector<Eigen::Vector4d> joints;
                std::vector<double> values;
                other.evaluate(nodes, joints, values);
                for (std::size_t k = 0; k < joints.size(); ++k)
                    duals.joints[k] += joints[k] / SOFTNESS;
                for (std::size_t i = 0; i < values.size(); ++i)
                    duals.prices[i] = (BARRIER - duals.prices[i] * (values[i] - SLACK)) / SLACK;
                other.linearize(duals, SOFTNESS);
                const Nodes right = program.right(BARRIER);
                for (std::size_t k = 0; k < nodes.size(); ++k)
                    EXPECT_LT((right[k] + other.gradient()[k]).norm(), 1e-9) << seed << ", node " << k;
            }
        }

        TEST(InteriorPoint, AsksInEveryIterationAndStopsWhenItIsTold)
        {
            MotionProgram program(randomProblem(1));
            for (const std::size_t limit : {0U, 1U, 4U})
            {
                std::size_t asked = 0;
                const InteriorPointResult result = solveMotion(program, {}, [&] { return asked++ == limit; });
                EXPECT_EQ(result.status, InteriorPointStatus::Interrupted);
                EXPECT_EQ(result.iterations, limit);
                EXPECT_EQ(asked, limit + 1);
            }
        }

        TEST(BlockTridiagonal, SolvesLikeADenseMatrix)
        {
            Random random(5);
            constexpr std::size_t N = 7;
            BlockTridiagonal matrix;
            matrix.reset(N);
            const auto entry = [&random]
            {
                return random.between(-1.0, 1.0);
            };
            Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(N * NODE_SIZE, N * NODE_SIZE);
            Eigen::VectorXd right(N * NODE_SIZE);
            std::vector<NodeVector> vector(N);
            for (std::size_t k = 0; k < N; ++k)
            {
                const auto at = static_cast<Eigen::Index>(k * NODE_SIZE);
                const NodeMatrix half = NodeMatrix::NullaryExpr(entry);
                matrix.diagonal[k] = half * half.transpose() + 12.0 * NodeMatrix::Identity();
                dense.block<NODE_SIZE, NODE_SIZE>(at, at) = matrix.diagonal[k];
                vector[k] = NodeVector::NullaryExpr(entry);
                right.segment<NODE_SIZE>(at) = vector[k];
                if (k + 1 == N)
                    continue;
                matrix.below[k] = NodeMatrix::NullaryExpr(entry);
                dense.block<NODE_SIZE, NODE_SIZE>(at + NODE_SIZE, at) = matrix.below[k];
                dense.block<NODE_SIZE, NODE_SIZE>(at, at + NODE_SIZE) = matrix.below[k].transpose();
            }
            const Eigen::VectorXd expected =
                (dense + 0.5 * Eigen::MatrixXd::Identity(dense.rows(), dense.cols())).llt().solve(right);
            ASSERT_TRUE(matrix.factorize(0.5));
            matrix.solve(vector);
            for (std::size_t k = 0; k < N; ++k)
                EXPECT_LT((vector[k] - expected.segment<NODE_SIZE>(static_cast<Eigen::Index>(k * NODE_SIZE))).norm(),
                          1e-12);
            EXPECT_FALSE(matrix.factorize(-60.0));
        }
    }  // namespace
}  // namespace parking
