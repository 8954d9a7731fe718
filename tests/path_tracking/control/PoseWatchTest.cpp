#include "path_tracking/control/PoseWatch.h"

#include "path_tracking/control/TrackingController.h"
#include "path_tracking/simulation/ClosedLoop.h"
#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace parking::test
{
    namespace
    {
        using Verdict = PoseWatch::Verdict;

        TEST(PoseWatch, BridgesAFewPeriodsAndWaitsForAsManyGoodOnes)
        {
            PoseWatch watch(3, 1.0, 0.1);
            EXPECT_TRUE(watch.isMissing()) << "never seen";
            watch.note(true);
            EXPECT_FALSE(watch.isMissing());
            for (int i = 0; i < 3; ++i)
            {
                watch.note(false);
                EXPECT_FALSE(watch.isMissing());
            }
            EXPECT_FALSE(watch.wasLost());
            watch.note(false);
            EXPECT_TRUE(watch.isMissing());
            EXPECT_TRUE(watch.wasLost());
            // A pose that flickers is none.
            for (const bool usable : {true, true, false, true, true, true})
            {
                watch.note(usable);
                EXPECT_EQ(watch.stand(), Verdict::Wait);
            }
            watch.note(true);
            EXPECT_EQ(watch.stand(), Verdict::Back);
            EXPECT_TRUE(watch.wasLost());
        }

        TEST(PoseWatch, HasPatienceAndNoMore)
        {
            for (const double patience : {0.0, 0.25, 3.0})
            {
                PoseWatch watch(3, patience, 0.1);
                watch.note(false);
                int periods = 1;
                for (; periods < 100 && watch.stand() == Verdict::Wait; ++periods)
                    watch.note(false);
                EXPECT_NEAR(0.1 * periods, patience, 0.1 + 1e-9);
            }
        }

        /** The drive along a path of which \e span goes without a pose. */
        DriveResult driveBlind(const TimeSpan &span, double posePatience)
        {
            ClosedLoopParameters parameters;
            parameters.disturbances.blind = {span};
            parameters.tracking.posePatience = posePatience;
            return ClosedLoop(Vehicle(), parameters).drive(arcs({1.0, 2.0, 0.5}, {{0.0, 3.0}, {1.0, 4.0}, {0.0, 3.0}}));
        }

        TEST(PoseWatch, ACarThatHasLostItsPoseStandsUntilItIsBack)
        {
            const DriveResult result = driveBlind({3.0, 9.0}, 10.0);
            EXPECT_FALSE(result.arrived);
            EXPECT_TRUE(std::any_of(result.log.begin(), result.log.end(),
                                    [](const DriveRecord &record) { return record.control.poseIsBack; }));
            EXPECT_EQ(result.message, "the pose is back");
            EXPECT_GT(result.trajectory.back().t, 9.0);
            EXPECT_LT(result.trajectory.back().t, 10.0);
            // It goes by speed and wheels until it stands, and knows where it is afterwards.
            EXPECT_LT(result.evaluation.maxPositionError, 0.02);
            EXPECT_LT(positionDistance(result.log.back().control.estimate, result.log.back().car.pose), 0.01);
            double stands = 0.0;
            for (const DriveRecord &record : result.log)
                if (record.control.mode == TrackingMode::Waiting)
                {
                    EXPECT_EQ(record.car.speed, 0.0);
                    stands += 0.1;
                }
            EXPECT_GT(stands, 3.0);
        }

        TEST(PoseWatch, AndNoLongerThanItsPatience)
        {
            const DriveResult result = driveBlind({3.0, 1e9}, 5.0);
            EXPECT_FALSE(result.arrived);
            EXPECT_EQ(result.message, "safe stop: the pose was lost, and not back after 5 s");
            EXPECT_EQ(result.trajectory.back().v, 0.0);
            EXPECT_GT(result.trajectory.back().t, 8.0);
            EXPECT_LT(result.trajectory.back().t, 12.0);
        }
    }  // namespace
}  // namespace parking::test
