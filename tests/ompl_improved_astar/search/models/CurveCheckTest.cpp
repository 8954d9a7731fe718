// Whether curves between two poses are free: the quick look at some of their poses, and the whole.

#include "ompl_improved_astar/search/models/CurveCheck.h"

#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

TEST(CurveCheck, theQuickLookRefusesMostOfWhatIsNotFreeAndNothingThatIs)
{
    const ReedsShepp curves(TURNING_RADIUS);
    int free = 0, refused = 0, refusedByTheLook = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed);
        const Pose &from = problem.starts.front(), &to = problem.goals.front();
        std::vector<ReedsSheppCurve> candidates;
        curves.candidates(from, to, candidates, 40.0);
        for (const ReedsSheppCurve &curve : candidates)
        {
            Path path{from, {}};
            for (std::size_t k = 0; k < curve.count; ++k)
                path.append(curve.pieces[k]);
            const double gap = leastGap(problem.world, path);
            const bool looksFree = hasFreePoses(problem.world, from, curve, to);
            if (gap > 1e-3)
            {
                ++free;
                EXPECT_TRUE(looksFree);
                EXPECT_TRUE(isCurveFree(problem.world, from, curve, to, CurveEnd::Start));
            }
            else if (gap <= 0.0)
            {
                ++refused;
                refusedByTheLook += !looksFree;
                EXPECT_FALSE(isCurveFree(problem.world, from, curve, to, CurveEnd::Goal));
            }
        }
    }
    EXPECT_GT(free, 20);
    EXPECT_GT(refused, 200);
    EXPECT_GT(refusedByTheLook, 4 * refused / 5);
}
