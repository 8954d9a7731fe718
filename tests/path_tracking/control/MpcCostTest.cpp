#include "path_tracking/control/MpcCost.h"

#include "path_tracking/simulation/BicycleModel.h"
#include "tests/path_tracking/control/MpcProblems.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parking::test
{
    namespace
    {
        Eigen::VectorXd randomUnknowns(Random &random, const MpcProblem &problem, const MpcParameters &mpc)
        {
            Eigen::VectorXd unknowns(2 * static_cast<Eigen::Index>(mpc.horizon));
            double speed = problem.direction * problem.speed, steering = problem.last.steering;
            for (Eigen::Index k = 0; 2 * k < unknowns.size(); ++k)
            {
                speed += random.between(-0.1, 0.1);
                steering += random.between(-0.05, 0.05);
                unknowns[2 * k] = speed;
                unknowns[2 * k + 1] = steering;
            }
            return unknowns;
        }

        /** The paper's sum, step by step in world coordinates. */
        double plainCost(const MpcProblem &problem, const MpcParameters &mpc, const Vehicle &vehicle,
                         const Eigen::VectorXd &unknowns)
        {
            const double h = mpc.step;
            double cost = 0.0;
            Pose car = problem.pose;
            double speed = problem.speed, commanded = speed + problem.driveLag * problem.acceleration;
            double wheels = problem.wheels, steering = problem.last.steering, acceleration = problem.last.acceleration;
            double wantedBefore = problem.steeringNow, speedBefore = problem.speedNow;
            double speedingUpBefore = mpc.relativeAcceleration ? problem.accelerationNow : 0.0;
            for (std::size_t k = 0; k < mpc.horizon; ++k)
            {
                const auto i = static_cast<Eigen::Index>(2 * k);
                const double nextCommand = problem.direction * unknowns[i], nextSteering = unknowns[i + 1];
                const double nextAcceleration = (nextCommand - commanded) / h;
                // The lags, integrated in small steps.
                double nextSpeed = speed, nextWheels = wheels;
                constexpr int N = 4000;
                for (int n = 0; n < N; ++n)
                {
                    const double part = (n + 0.5) / N;
                    const double c = commanded + part * (nextCommand - commanded);
                    const double d = steering + part * (nextSteering - steering);
                    nextSpeed =
                        problem.driveLag > 0.0 ? nextSpeed + (c - nextSpeed) * h / N / problem.driveLag : nextCommand;
                    nextWheels = problem.steeringLag > 0.0 ? nextWheels + (d - nextWheels) * h / N / problem.steeringLag
                                                           : nextSteering;
                }
                const auto step =
                    bicycleStep(car.yaw, speed, (nextSpeed - speed) / h, wheels, nextWheels, h, vehicle.wheelbase);
                car = {car.x + step.dx, car.y + step.dy, car.yaw + step.dyaw};
                const MpcReference &wanted = problem.reference[k];
                const double relative = mpc.relativeSteering ? 1.0 : 0.0;
                const double change = nextSteering - steering - relative * (wanted.steering - wantedBefore);
                const double speedingUp = mpc.relativeAcceleration ? (wanted.speed - speedBefore) / h : 0.0;
                cost += mpc.accelerationWeight * std::pow(nextAcceleration - speedingUp, 2);
                cost += mpc.steeringWeight * std::pow(nextSteering - relative * wanted.steering, 2);
                const double jerk = nextAcceleration - acceleration - (speedingUp - speedingUpBefore);
                cost += mpc.accelerationChangeWeight * jerk * jerk;
                cost += mpc.steeringChangeWeight * change * change;
                const Pose off = relativeTo(wanted.pose, car);
                cost += mpc.alongWeight * off.x * off.x + mpc.acrossWeight * off.y * off.y;
                cost += (problem.align ? mpc.headingWeight : mpc.farHeadingWeight) *
                        std::pow(wrapAngle(car.yaw - wanted.pose.yaw), 2);
                commanded = nextCommand;
                speed = nextSpeed;
                steering = nextSteering;
                wheels = nextWheels;
                acceleration = nextAcceleration;
                wantedBefore = wanted.steering;
                speedBefore = wanted.speed;
                speedingUpBefore = speedingUp;
            }
            return cost;
        }

        TEST(MpcCost, IsThePapersSumUpToAConstant)
        {
            for (const bool relative : {false, true})
                for (std::uint64_t seed = 0; seed < 12; ++seed)
                {
                    MpcParameters mpc;
                    mpc.relativeSteering = relative;
                    mpc.relativeAcceleration = relative == (seed % 2 == 0);
                    mpc.headingWeight = 70.0;
                    mpc.alongWeight = 40.0;
                    const MpcProblem problem = randomProblem(seed, mpc);
                    const Vehicle vehicle;
                    MpcCost cost(vehicle, mpc);
                    cost.setProblem(problem);
                    Random random(seed + 50);
                    double constant = 0.0;
                    for (int i = 0; i < 4; ++i)
                    {
                        const Eigen::VectorXd unknowns = randomUnknowns(random, problem, mpc);
                        Eigen::VectorXd residuals;
                        cost.evaluate(unknowns, residuals, nullptr);
                        const double plain = plainCost(problem, mpc, vehicle, unknowns);
                        const double difference = plain - residuals.squaredNorm();
                        if (i == 0)
                            constant = difference;
                        EXPECT_NEAR(difference, constant, 2e-4 * plain) << seed;
                    }
                }
        }

        TEST(MpcCost, ItsJacobianIsThatOfDifferences)
        {
            for (std::uint64_t seed = 0; seed < 30; ++seed)
            {
                const MpcParameters mpc;
                const MpcProblem problem = randomProblem(seed, mpc);
                MpcCost cost(Vehicle(), mpc);
                cost.setProblem(problem);
                Random random(seed + 70);
                const Eigen::VectorXd unknowns = randomUnknowns(random, problem, mpc);
                Eigen::VectorXd residuals, plus, minus;
                MpcCost::Jacobian jacobian;
                cost.evaluate(unknowns, residuals, &jacobian);
                ASSERT_EQ(jacobian.rows(), cost.residuals());
                ASSERT_EQ(jacobian.cols(), cost.unknowns());
                for (Eigen::Index i = 0; i < unknowns.size(); ++i)
                {
                    constexpr double H = 1e-6;
                    Eigen::VectorXd moved = unknowns;
                    moved[i] += H;
                    cost.evaluate(moved, plus, nullptr);
                    moved[i] -= 2.0 * H;
                    cost.evaluate(moved, minus, nullptr);
                    EXPECT_LT((jacobian.col(i) - (plus - minus) / (2.0 * H)).norm(), 1e-6) << seed << " " << i;
                }
            }
        }
    }  // namespace
}  // namespace parking::test
