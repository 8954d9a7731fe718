#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "path_tracking/trajectory/program/MotionOutline.h"
#include "path_tracking/trajectory/program/MotionProgram.h"
#include "path_tracking/trajectory/program/SolvedMotion.h"
#include "tests/path_tracking/TestPaths.h"
#include "tests/path_tracking/trajectory/TrajectoryReferee.h"
#include "tests/path_tracking/trajectory/TrajectoryWorlds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace parking
{
    namespace
    {
        constexpr double STEP = 0.3;  // seconds between two nodes

        MotionProblem problemAlong(const Path &path)
        {
            MotionProblem problem;
            MotionOutline(path, problem.vehicle, STEP, 0.0, 0.0).write(problem);
            return problem;
        }

        TEST(MotionPhases, IntervalsLastAsLongAsTheNextUnlessAPhaseEnds)
        {
            MotionProblem problem = problemAlong({{}, {{0.0, 4.0}}});
            problem.phaseEnds.clear();
            const auto jointsAndInequalities = [](const MotionProblem &made)
            {
                MotionProgram program(made);
                std::vector<NodeVector> nodes = made.nodes;
                for (std::size_t k = 0; k < nodes.size(); ++k)
                    nodes[k][NODE_DURATION] = 0.1 * static_cast<double>(k);
                std::vector<Eigen::Vector4d> joints;
                std::vector<double> values;
                program.evaluate(nodes, joints, values);
                return std::pair(joints, values.size());
            };
            const auto [joints, inequalities] = jointsAndInequalities(problem);
            problem.phaseEnds.assign(problem.directions.size(), 0);
            problem.phaseEnds[3] = 1;
            const auto [withPhases, more] = jointsAndInequalities(problem);
            for (std::size_t k = 0; k < joints.size(); ++k)
            {
                const bool within = k > 0 && k + 2 < joints.size();
                EXPECT_NEAR(joints[k][3], within ? 0.1 : 0.0, 1e-12) << k;
                EXPECT_NEAR(withPhases[k][3], within && k != 3 ? 0.1 : 0.0, 1e-12) << k;
            }
            // Each phase has a least duration of its own.
            EXPECT_EQ(more, inequalities + 1);
        }

        TEST(MotionPhases, OfAGuessEndWhereItIsFastest)
        {
            const Vehicle car;
            const double toFullSpeed = car.maxSpeed / car.maxAcceleration;
            const double longWay = car.maxSpeed * (toFullSpeed + 4.0);
            for (const double length : {0.5, 3.0, longWay})
            {
                const bool isLong = length == longWay;
                const MotionProblem problem = problemAlong({{}, {{0.0, -length}}});
                std::size_t ends = 0;
                double time = 0.0;
                for (std::size_t k = 0; k < problem.directions.size(); ++k)
                {
                    time += problem.directions[k] != 0 ? problem.nodes[k][NODE_DURATION] : 0.0;
                    if (problem.phaseEnds[k] == 0 || problem.directions[k + 1] == 0)
                        continue;
                    ++ends;
                    const double fastest = isLong ? car.maxSpeed : std::sqrt(length * car.maxAcceleration);
                    EXPECT_NEAR(problem.nodes[k + 1][NODE_SPEED], fastest, 0.02) << length;
                    const double when = fastest / car.maxAcceleration + (ends == 2 ? 4.0 : 0.0);
                    EXPECT_NEAR(time, when, 0.03) << length;
                }
                EXPECT_EQ(ends, isLong ? 2U : 1U) << length;
            }
        }

        TEST(MotionPhases, EndBesideTheIntervalInWhichALimitIsLeftForAnother)
        {
            // Speeds up and brakes fully, with the change at a share of the third of six intervals.
            for (const double share : {0.2, 0.8})
                for (const int entry : {NODE_SPEED, NODE_STEERING})
                {
                    MotionProblem problem;
                    problem.directions = {0, 1, 1, 1, 1, 1, 1, 0};
                    const double rate =
                        entry == NODE_SPEED ? problem.vehicle.maxAcceleration : problem.vehicle.maxSteeringRate;
                    double value = 0.0;
                    for (std::size_t k = 0; k <= problem.directions.size(); ++k)
                    {
                        problem.nodes.emplace_back(NodeVector::Zero());
                        problem.nodes[k][NODE_DURATION] = STEP;
                        problem.nodes[k][entry] = value;
                        if (k > 0 && k < 7)
                            value += rate * STEP * (k < 3 ? 1.0 : k > 3 ? -1.0 : 2.0 * share - 1.0);
                    }
                    endPhasesAtChanges(problem);
                    for (std::size_t k = 0; k < problem.directions.size(); ++k)
                        EXPECT_EQ(problem.phaseEnds[k] != 0, k == (share < 0.5 ? 2U : 3U))
                            << k << ", " << share << ", " << entry;
                }
        }

        TEST(MotionPhases, AStraightLineLosesNothingWhereverItsPeakIs)
        {
            const Vehicle car;
            const FootprintChecker checker = test::checkerOf({});
            for (double length = 0.6; length < 25.0; length *= 1.17)
            {
                const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize({{}, {{0.0, length}}});
                const double bound = test::bangBang(length, car);
                EXPECT_GE(found.motion.duration(), bound - 1e-6) << length;
                EXPECT_LE(found.motion.duration(), bound * 1.0005) << length;
            }
        }

        TEST(MotionPhases, CoarseStepsTakeHardlyLongerThanFineOnes)
        {
            const FootprintChecker checker = test::checkerOf({});
            TrajectoryOptions fine;
            fine.step = 0.1;
            double coarseSum = 0.0, fineSum = 0.0;
            for (std::uint64_t seed = 1; seed <= 20; ++seed)
            {
                const Path path = test::randomReedsShepp(seed, 10.0);
                coarseSum += TrajectoryOptimizer(checker).optimize(path).motion.duration();
                fineSum += TrajectoryOptimizer(checker, fine).optimize(path).motion.duration();
            }
            EXPECT_LT(coarseSum, 1.0005 * fineSum);
        }
    }  // namespace
}  // namespace parking
