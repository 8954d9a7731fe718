#include "path_tracking/control/MpcWorkingSet.h"

#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace parking::test
{
    namespace
    {
        constexpr Eigen::Index STEPS = 6;

        HorizonLimits limitsAfter(double lastSpeed, double lastSteering)
        {
            HorizonLimits result;
            result[0] = {0.0, 2.5, 0.1, lastSpeed};
            result[1] = {-0.75, 0.75, 0.05, lastSteering};
            return result;
        }

        HorizonLimits randomLimits(Random &random)
        {
            const double speed = random.between(0.0, 2.5);
            return limitsAfter(speed, random.between(-0.75, 0.75));
        }

        bool feasible(const HorizonLimits &bounds, const Eigen::VectorXd &unknowns)
        {
            for (std::size_t channel = 0; channel < 2; ++channel)
            {
                double before = bounds[channel].last;
                for (auto i = static_cast<Eigen::Index>(channel); i < unknowns.size(); i += 2)
                {
                    if (unknowns[i] < bounds[channel].low - 1e-12 || unknowns[i] > bounds[channel].high + 1e-12 ||
                        std::abs(unknowns[i] - before) > bounds[channel].change + 1e-12)
                        return false;
                    before = unknowns[i];
                }
            }
            return true;
        }

        Eigen::VectorXd randomPoint(Random &random, const HorizonLimits &bounds, double size)
        {
            Eigen::VectorXd point(2 * STEPS);
            for (Eigen::Index i = 0; i < point.size(); ++i)
                point[i] = bounds[static_cast<std::size_t>(i % 2)].last + random.between(-size, size);
            return point;
        }

        /** Minimises a convex quadratic with the working set, the way the controller does. */
        Eigen::VectorXd minimise(const HorizonLimits &bounds, const Eigen::MatrixXd &hessian,
                                 const Eigen::VectorXd &linear, Eigen::VectorXd point)
        {
            const auto cost = [&](const Eigen::VectorXd &x)
            {
                return 0.5 * x.dot(hessian * x) + linear.dot(x);
            };
            for (int round = 0; round < 200; ++round)
            {
                const Eigen::VectorXd gradient = hessian * point + linear;
                const WorkingSet active(bounds, point, gradient);
                const Eigen::Index n = active.freedom();
                if (n == 0)
                    break;
                // Columns of the free directions.
                Eigen::MatrixXd directions(point.size(), n);
                for (Eigen::Index i = 0; i < n; ++i)
                {
                    Eigen::VectorXd unit = Eigen::VectorXd::Zero(n);
                    unit[i] = 1.0;
                    directions.col(i) = active.expand(Eigen::VectorXd::Zero(point.size()), unit.data());
                }
                // More damping until the step goes down, as the trust region does.
                const Eigen::MatrixXd reduced = directions.transpose() * hessian * directions;
                bool lower = false;
                for (double damping = 0.0; damping < 1e9 && !lower; damping = 4.0 * damping + 1e-3)
                {
                    const Eigen::VectorXd step = (reduced + damping * Eigen::MatrixXd::Identity(n, n))
                                                     .llt()
                                                     .solve(-directions.transpose() * gradient);
                    Eigen::VectorXd next = active.expand(point, step.data());
                    cutToLimits(bounds, next);
                    lower = cost(next) < cost(point) - 1e-15;
                    if (lower)
                        point = next;
                }
                if (!lower)
                    break;
            }
            return point;
        }

        TEST(MpcWorkingSet, LeadsToTheMinimumOfConvexProblems)
        {
            // At the minimum no feasible direction goes down: checked against many random feasible points, all of which
            // must lie above the tangent plane.
            for (std::uint64_t seed = 0; seed < 300; ++seed)
            {
                Random random(seed);
                const HorizonLimits bounds = randomLimits(random);
                Eigen::MatrixXd root(2 * STEPS, 2 * STEPS);
                for (Eigen::Index i = 0; i < root.size(); ++i)
                    root.data()[i] = random.between(-1.0, 1.0);
                const Eigen::MatrixXd hessian =
                    root * root.transpose() + 0.3 * Eigen::MatrixXd::Identity(2 * STEPS, 2 * STEPS);
                const Eigen::VectorXd linear = -hessian * randomPoint(random, bounds, 0.6);
                Eigen::VectorXd start = randomPoint(random, bounds, 0.1);
                cutToLimits(bounds, start);
                const Eigen::VectorXd best = minimise(bounds, hessian, linear, start);
                EXPECT_TRUE(feasible(bounds, best));
                const Eigen::VectorXd gradient = hessian * best + linear;
                for (int i = 0; i < 2000; ++i)
                {
                    Eigen::VectorXd other = randomPoint(random, bounds, i % 2 == 0 ? 0.6 : 0.05);
                    if (i % 3 == 0)
                        other = best + 0.02 * (other - best);
                    cutToLimits(bounds, other);
                    EXPECT_GE(gradient.dot(other - best), -1e-4 * (1.0 + gradient.norm())) << seed;
                }
            }
        }
    }  // namespace
}  // namespace parking::test
