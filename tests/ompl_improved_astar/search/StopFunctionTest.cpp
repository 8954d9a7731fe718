// How long somebody goes on without asking whether to stop.

#include "ompl_improved_astar/search/StopFunction.h"

#include <gtest/gtest.h>

using parking::search::Patience;
using parking::search::StopFunction;

TEST(Patience, asksAfterSoMuchWork)
{
    int questions = 0;
    const StopFunction never = [&questions]
    {
        ++questions;
        return false;
    };
    Patience patience(never, 10);
    for (int work = 0; work < 10; ++work)
        EXPECT_FALSE(patience.isOver());
    EXPECT_EQ(questions, 0);
    EXPECT_FALSE(patience.isOver(4));
    EXPECT_EQ(questions, 1);
    EXPECT_FALSE(patience.isOver(6));
    EXPECT_EQ(questions, 1) << "4 and 6 are 10";
    EXPECT_FALSE(patience.isOver(25));
    EXPECT_EQ(questions, 2);
    EXPECT_FALSE(patience.isOver(25));
    EXPECT_EQ(questions, 3);
    EXPECT_FALSE(patience.wasOver());
    const StopFunction nobody;
    Patience endless(nobody, 0);
    EXPECT_FALSE(endless.isOver(1000));
}

TEST(Patience, onceOverItIsOver)
{
    int questions = 0;
    const StopFunction once = [&questions]
    {
        return ++questions == 2;
    };
    Patience patience(once, 1);
    EXPECT_FALSE(patience.isOver(2));
    EXPECT_FALSE(patience.wasOver());
    EXPECT_TRUE(patience.isOver(2));
    EXPECT_TRUE(patience.isOver(2));
    EXPECT_TRUE(patience.wasOver());
    EXPECT_EQ(questions, 2);
}
