// The world as any checker knows it: once the time is up, the checker is hardly asked any more.

#include "ompl_improved_astar/StateSpaceEnvironment.h"
#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

using namespace parking_test;

TEST(StateSpaceEnvironment, AsksNoMoreWhenTheTimeIsUp)
{
    const ob::SpaceInformationPtr si = PlanningProblem(Space::ReedsShepp, square({}, 10.0)).si;
    const auto checker = std::make_shared<CountingChecker>(si, [](const Pose &) { return 0.5; });
    si->setStateValidityChecker(checker);
    si->setup();
    parking::StateSpaceEnvironment environment(si, 0.1, {}, false);
    const Pose left{-9.0, 0.0, 0.0};
    // With the answer as long as there is time.
    const std::pair<std::function<double()>, double> QUERIES[] = {
        {[&] { return environment.isFree(left); }, 1.0},
        {[&] { return environment.freeLength(left, {0.0, 18.0}); }, 18.0},
        {[&] { return environment.keeps(left, 0.5) && !environment.keeps(left, 0.51); }, 1.0},
        {[&] {
             return environment.acceptPath({left, {{0.0, 6.0}, {0.1, 6.0}, {0.0, 2.0}}});
         },
         1.0},
    };
    for (const auto &[ask, answer] : QUERIES)
        for (const bool isTimeUp : {false, true})
        {
            SCOPED_TRACE(testing::Message() << answer << ' ' << isTimeUp);
            environment.setStop([isTimeUp] { return isTimeUp; });
            const std::uint64_t before = checker->states + checker->clearances;
            int answered = 0;
            for (int i = 0; i < 100; ++i)
                answered += ask() == answer;
            const std::uint64_t asked = checker->states + checker->clearances - before;
            EXPECT_EQ(answered == 100, !isTimeUp);
            EXPECT_EQ(asked >= 100, !isTimeUp);
            EXPECT_LE(isTimeUp ? asked : 0, 8);
            EXPECT_LE(answered, static_cast<int>(asked)) << "not asked, it says no";
            EXPECT_EQ(environment.wasInterrupted(), isTimeUp);
        }
    environment.setStop(nullptr);
    EXPECT_FALSE(environment.isFree({11.0, 0.0, 0.0})) << "out of bounds";
}
