#include "path_tracking/trajectory/program/DrivenStretch.h"
#include "path_tracking/trajectory/program/MotionOutline.h"
#include "path_tracking/trajectory/program/SolvedMotion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace parking
{
    namespace
    {
        /** Forwards, back, and forwards again, with bends. */
        Path threeStretches()
        {
            return {{1.0, -2.0, 0.4}, {{0.1, 6.0}, {0.0, 3.0}, {-0.15, -1.0}, {0.1, -0.5}, {0.2, 4.0}, {-0.1, 5.0}}};
        }

        MotionProblem problemAlong(const Path &path, double step = 0.3)
        {
            MotionProblem problem;
            MotionOutline(path, problem.vehicle, step, 0.0, 0.0).write(problem);
            return problem;
        }

        double widestStep(const DrivenStretch &stretch)
        {
            double widest = 0.0;
            for (std::size_t i = 1; i < stretch.points.size(); ++i)
                widest = std::max(widest, positionDistance(stretch.points[i - 1].pose, stretch.points[i].pose));
            return widest;
        }

        TEST(DrivenStretch, AreThoseOfThePathThatTheNodesAreOn)
        {
            const Path path = threeStretches();
            const std::vector<DrivenStretch> stretches = stretchesOf(problemAlong(path));
            ASSERT_EQ(stretches.size(), 3U);
            const std::vector<int> directions{1, -1, 1};
            const std::vector<double> lengths{9.0, 1.5, 9.0};
            for (std::size_t i = 0; i < 3; ++i)
            {
                EXPECT_EQ(stretches[i].direction, directions[i]) << i;
                EXPECT_NEAR(stretches[i].length, lengths[i], 0.02 * lengths[i]) << i;
                EXPECT_LT(widestStep(stretches[i]), 0.1) << i;
                if (i > 0)
                {
                    EXPECT_TRUE(
                        isSamePose(stretches[i - 1].points.back().pose, stretches[i].points.front().pose, 1e-9));
                }
            }
            EXPECT_TRUE(isSamePose(stretches.front().points.front().pose, path.start, 1e-9));
            EXPECT_TRUE(isSamePose(stretches.back().points.back().pose, path.end(), 1e-9));
        }

        TEST(DrivenStretch, WithoutOneTheRestStillLeadsFromBeginToEndInSmallSteps)
        {
            const Path path = threeStretches();
            const std::vector<DrivenStretch> stretches = stretchesOf(problemAlong(path));
            for (std::size_t removed = 0; removed < 3; ++removed)
            {
                const std::vector<DrivenStretch> rest = withoutStretch(stretches, removed);
                ASSERT_EQ(rest.size(), removed == 1 ? 1U : 2U);
                EXPECT_TRUE(isSamePose(rest.front().points.front().pose, path.start, 1e-9)) << removed;
                EXPECT_TRUE(isSamePose(rest.back().points.back().pose, path.end(), 1e-9)) << removed;
                for (std::size_t i = 0; i < rest.size(); ++i)
                {
                    if (i > 0)
                    {
                        EXPECT_EQ(rest[i].direction, -rest[i - 1].direction) << removed;
                    }
                    if (removed == 1)
                    {
                        EXPECT_LT(widestStep(rest[i]), 0.3);
                    }
                }
            }
            EXPECT_TRUE(withoutStretch(withoutStretch(stretches, 1), 0).empty());
        }

        TEST(SolvedMotion, CorrectionsAreWhatCollocationMissesAndFallWithTheStep)
        {
            const auto largest = [](double step)
            {
                MotionProblem problem = problemAlong({{}, {{0.02, 10.0}, {0.05, 5.0}, {-0.02, 10.0}}}, step);
                correctIntervals(problem);
                EXPECT_EQ(problem.corrections.size(), problem.directions.size());
                double most = 0.0;
                for (std::size_t k = 0; k < problem.directions.size(); ++k)
                {
                    const double missed = problem.corrections[k].lpNorm<Eigen::Infinity>();
                    most = std::max(most, missed);
                    EXPECT_TRUE(problem.directions[k] != 0 || missed == 0.0) << k;
                }
                return most;
            };
            const double coarse = largest(0.8), fine = largest(0.2);
            EXPECT_GT(coarse, 1e-8);
            EXPECT_LT(fine, 1e-2);
            EXPECT_LT(fine, 0.2 * coarse);
        }
    }  // namespace
}  // namespace parking
