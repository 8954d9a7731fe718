#include "path_tracking/trajectory/program/Separation.h"

#include "benchmarks/worlds/Random.h"
#include "tests/path_tracking/trajectory/TrajectoryWorlds.h"

#include <gtest/gtest.h>

#include <vector>

namespace parking
{
    namespace
    {
        /** A drive straight ahead past many boxes. */
        struct Drive
        {
            std::vector<ConvexPiece> body = partsOf(Body({}, 0.0));
            std::vector<ConvexPiece> pieces;
            std::vector<GuessedCheckpoint> checkpoints;

            Drive()
            {
                parking_test::Random random(3);
                for (int i = 0; i < 200; ++i)
                {
                    const double x = random.between(-5.0, 25.0), y = random.between(1.6, 4.0);
                    pieces.emplace_back(test::box(x, random.chance(0.5) ? y : -y, 0.5, 0.5, random.between(-PI, PI)));
                }
                for (std::size_t k = 0; k <= 40; ++k)
                    checkpoints.push_back({k, 1.0, poseAt(k, 1.0), k == 0 || k == 40});
            }

            static Pose poseAt(std::size_t interval, double fraction)
            {
                return {0.5 * (static_cast<double>(interval) + fraction), 0.0, 0.0};
            }
        };

        TEST(Separation, RowsHoldWhereTheGuessIsFree)
        {
            const Drive drive;
            const SeparationPlan plan(drive.pieces, drive.body, {}, drive.checkpoints, Drive::poseAt);
            EXPECT_TRUE(plan.isComplete());
            MotionProblem problem;
            plan.write(problem);
            EXPECT_GT(problem.rows.size(), problem.checkpoints.size());
            for (const MotionCheckpoint &point : problem.checkpoints)
            {
                const Pose pose = Drive::poseAt(point.interval, point.fraction);
                for (std::size_t r = point.firstRow; r < point.lastRow; ++r)
                    EXPECT_GT(problem.rows[r].value(pose.x, pose.y, 1.0, 0.0), -0.02);
            }
        }
    }  // namespace
}  // namespace parking
