#include "path_tracking/control/Mpc.h"

#include "path_tracking/control/MpcCost.h"
#include "path_tracking/control/MpcWorkingSet.h"
#include "path_tracking/simulation/BicycleModel.h"
#include "tests/path_tracking/control/MpcProblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace parking::test
{
    namespace
    {
        HorizonLimits limitsOf(const MpcProblem &problem, const MpcParameters &mpc, const Vehicle &vehicle)
        {
            HorizonLimits limits;
            limits[0] = {0.0, vehicle.maxSpeed, vehicle.maxAcceleration * mpc.step,
                         problem.direction * (problem.speed + problem.driveLag * problem.acceleration)};
            limits[1] = {-vehicle.maxSteeringAngle, vehicle.maxSteeringAngle, vehicle.maxSteeringRate * mpc.step,
                         problem.last.steering};
            return limits;
        }

        /** Commanded speeds and angles of an answer. */
        Eigen::VectorXd unknownsOf(const MpcProblem &problem, const MpcSolution &solution, const MpcParameters &mpc)
        {
            Eigen::VectorXd unknowns(2 * static_cast<Eigen::Index>(solution.controls.size()));
            double speed = problem.speed + problem.driveLag * problem.acceleration;
            for (std::size_t k = 0; k < solution.controls.size(); ++k)
            {
                speed += solution.controls[k].acceleration * mpc.step;
                unknowns[static_cast<Eigen::Index>(2 * k)] = problem.direction * speed;
                unknowns[static_cast<Eigen::Index>(2 * k + 1)] = solution.controls[k].steering;
            }
            return unknowns;
        }

        /** Where a car without lags is after each step of an answer. */
        std::vector<Pose> posesOf(const MpcProblem &problem, const MpcSolution &solution, const MpcParameters &mpc)
        {
            std::vector<Pose> poses;
            Pose pose = problem.pose;
            double speed = problem.speed, wheels = problem.wheels;
            for (const MpcControl &control : solution.controls)
            {
                const BicycleStep<double> moved = bicycleStep(pose.yaw, speed, control.acceleration, wheels,
                                                              control.steering, mpc.step, Vehicle().wheelbase);
                pose = {pose.x + moved.dx, pose.y + moved.dy, pose.yaw + moved.dyaw};
                poses.push_back(pose);
                speed += control.acceleration * mpc.step;
                wheels = control.steering;
            }
            return poses;
        }

        TEST(Mpc, ItsAnswerObeysAllLimits)
        {
            const Vehicle vehicle;
            const MpcParameters mpc;
            for (std::uint64_t seed = 0; seed < 200; ++seed)
            {
                const MpcProblem problem = randomProblem(seed, mpc);
                Mpc controller(vehicle, mpc);
                const MpcSolution solution = controller.solve(problem);
                ASSERT_TRUE(solution.usable) << solution.message;
                ASSERT_EQ(solution.controls.size(), mpc.horizon);
                EXPECT_LE(solution.iterations, mpc.maxIterations);
                double steering = problem.last.steering;
                const Eigen::VectorXd unknowns = unknownsOf(problem, solution, mpc);
                for (std::size_t k = 0; k < mpc.horizon; ++k)
                {
                    const MpcControl &control = solution.controls[k];
                    EXPECT_LE(std::abs(control.acceleration), vehicle.maxAcceleration + 1e-9);
                    EXPECT_LE(std::abs(control.steering), vehicle.maxSteeringAngle + 1e-9);
                    EXPECT_LE(std::abs(control.steering - steering), vehicle.maxSteeringRate * mpc.step + 1e-9);
                    steering = control.steering;
                    const double along = unknowns[static_cast<Eigen::Index>(2 * k)];
                    // A car that is too fast slows down as fast as it can.
                    const double reachable = limitsOf(problem, mpc, vehicle)[0].last -
                                             static_cast<double>(k + 1) * vehicle.maxAcceleration * mpc.step;
                    EXPECT_LE(along, std::max(vehicle.maxSpeed, reachable) + 1e-9);
                    EXPECT_GE(along, -1e-9);
                }
            }
        }

        TEST(Mpc, ItsAnswerIsAMinimum)
        {
            // No feasible change of the controls, small or large, in any of many directions, does noticeably better.
            // Seeds 155 and 176 need a trust region that grows again: it stopped a fifth and a quarter above these.
            // Figures of more problems: docs/trajectories-and-tracking.md.
            const Vehicle vehicle;
            MpcParameters mpc;
            mpc.maxIterations = 30;
            std::vector<std::uint64_t> seeds{155, 176};
            for (std::uint64_t seed = 0; seed < 60; ++seed)
                seeds.push_back(seed);
            for (const std::uint64_t seed : seeds)
            {
                double least = std::numeric_limits<double>::infinity();
                const MpcProblem problem = randomProblem(seed, mpc);
                Mpc controller(vehicle, mpc);
                const MpcSolution solution = controller.solve(problem);
                ASSERT_TRUE(solution.usable);
                const HorizonLimits limits = limitsOf(problem, mpc, vehicle);
                MpcCost cost(vehicle, mpc);
                cost.setProblem(problem);
                Eigen::VectorXd best = unknownsOf(problem, solution, mpc), residuals;
                MpcCost::Jacobian jacobian;
                cost.evaluate(best, residuals, &jacobian);
                const double value = residuals.squaredNorm();
                const Eigen::VectorXd gradient = jacobian.transpose() * residuals;
                Random random(seed);
                for (int i = 0; i < 400; ++i)
                {
                    Eigen::VectorXd other = best;
                    const double size = std::pow(10.0, random.between(-4.0, -1.0));
                    if (i % 4 == 0)
                        other -= size * gradient / gradient.norm();
                    for (Eigen::Index k = 0; k < other.size() && i % 4 != 0; ++k)
                        other[k] += size * random.between(-1.0, 1.0);
                    cutToLimits(limits, other);
                    cost.evaluate(other, residuals, nullptr);
                    least = std::min(least, residuals.squaredNorm());
                }
                EXPECT_GE(least, value * (1.0 - 5e-3) - 1e-6) << seed;
            }
        }

        TEST(Mpc, OnThePathItAnswersWithThePathsControls)
        {
            const MpcParameters mpc;
            for (std::uint64_t seed = 0; seed < 10; ++seed)
            {
                const TimedReference reference = referenceOf(randomSmooth(seed, 15.0));
                const MpcProblem problem = problemOn(reference, 0, 0.4 * reference.legs()[0].duration, mpc);
                Mpc controller(Vehicle(), mpc);
                const MpcSolution solution = controller.solve(problem);
                ASSERT_TRUE(solution.usable);
                const std::vector<Pose> poses = posesOf(problem, solution, mpc);
                for (std::size_t k = 0; k < 5; ++k)
                {
                    EXPECT_NEAR(solution.controls[k].steering, problem.reference[k].steering, 0.02) << seed;
                    EXPECT_LT(positionDistance(problem.reference[k].pose, poses[k]), 0.02) << seed;
                }
            }
        }

        TEST(Mpc, IsDeterministicAndForgetsOnReset)
        {
            const MpcParameters mpc;
            Mpc used(Vehicle(), mpc);
            for (std::uint64_t seed = 0; seed < 10; ++seed)
                used.solve(randomProblem(seed, mpc));
            used.reset();
            Mpc fresh(Vehicle(), mpc);
            const MpcProblem problem = randomProblem(42, mpc);
            const MpcSolution a = used.solve(problem), b = fresh.solve(problem);
            EXPECT_EQ(a.cost, b.cost);
            ASSERT_EQ(a.controls.size(), b.controls.size());
            for (std::size_t k = 0; k < a.controls.size(); ++k)
            {
                EXPECT_EQ(a.controls[k].acceleration, b.controls[k].acceleration);
                EXPECT_EQ(a.controls[k].steering, b.controls[k].steering);
            }
        }

        TEST(Mpc, TheHeadingWeightActsNearTheGoalOnly)
        {
            MpcParameters mpc;
            mpc.farHeadingWeight = 0.0;
            mpc.headingWeight = 1e4;
            MpcProblem problem = problemOn(referenceOf(arcs({}, {{0.0, 20.0}})), 0, 4.0, mpc, {0.0, 0.1, 0.1});
            const auto turned = [&](bool align)
            {
                problem.align = align;
                Mpc controller(Vehicle(), mpc);
                return std::abs(posesOf(problem, controller.solve(problem), mpc)[8].yaw);
            };
            EXPECT_LT(turned(true), 0.5 * turned(false));
        }

        TEST(Mpc, WorksWithOneStepAndWithMany)
        {
            for (const std::size_t horizon : {1u, 2u, 3u, 60u, 200u})
            {
                MpcParameters mpc;
                mpc.horizon = horizon;
                Mpc controller(Vehicle(), mpc);
                EXPECT_TRUE(controller.solve(randomProblem(4, mpc)).usable) << horizon;
            }
        }

        TEST(Mpc, LooksAheadBeyondAFullTurn)
        {
            MpcParameters mpc;
            mpc.horizon = 150;
            const MpcProblem problem = problemOn(referenceOf(arcs({}, {{1.0, 40.0}})), 0, 1.0, mpc);
            Mpc controller(Vehicle(), mpc);
            const MpcSolution solution = controller.solve(problem);
            ASSERT_TRUE(solution.usable);
            const std::vector<Pose> poses = posesOf(problem, solution, mpc);
            for (std::size_t k = 0; k < 100; ++k)
            {
                EXPECT_LT(positionDistance(problem.reference[k].pose, poses[k]), 0.05) << k;
            }
        }

        TEST(Mpc, AnswersNonsenseWithoutAPlanAndPrintsNothing)
        {
            testing::internal::CaptureStderr();
            testing::internal::CaptureStdout();
            const MpcParameters mpc;
            Mpc controller(Vehicle(), mpc);
            MpcProblem problem = randomProblem(1, mpc);
            problem.reference.pop_back();
            MpcSolution solution = controller.solve(problem);
            EXPECT_FALSE(solution.usable);
            EXPECT_NE(solution.message.find("19 points"), std::string::npos);
            for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()})
            {
                problem = randomProblem(1, mpc);
                problem.speed = value;
                EXPECT_FALSE(controller.solve(problem).usable);
                problem = randomProblem(1, mpc);
                problem.reference[7].pose.y = value;
                EXPECT_FALSE(controller.solve(problem).usable);
            }
            // Numbers so large that their squares, or they themselves times a weight, overflow.
            for (const double value : {1e200, 1e308})
            {
                problem = randomProblem(1, mpc);
                for (MpcReference &point : problem.reference)
                    point.pose.x = value;
                solution = controller.solve(problem);
                EXPECT_FALSE(solution.usable);
                EXPECT_FALSE(solution.message.empty());
                EXPECT_TRUE(solution.controls.empty());
            }
            // And it is none the worse for it.
            EXPECT_TRUE(controller.solve(randomProblem(1, mpc)).usable);
            EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
            EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
        }

        TEST(Mpc, AnyWeightMayBeZero)
        {
            for (double MpcParameters::*weight :
                 {&MpcParameters::accelerationWeight, &MpcParameters::steeringWeight,
                  &MpcParameters::accelerationChangeWeight, &MpcParameters::steeringChangeWeight,
                  &MpcParameters::alongWeight, &MpcParameters::acrossWeight, &MpcParameters::headingWeight,
                  &MpcParameters::farHeadingWeight, &MpcParameters::alignDistance})
            {
                MpcParameters mpc;
                mpc.*weight = 0.0;
                EXPECT_TRUE(Mpc(Vehicle(), mpc).solve(randomProblem(1, mpc)).usable);
            }
        }
    }  // namespace
}  // namespace parking::test
