// Quantiles and confidence intervals against values worked out by hand, published ones, and simulation.

#include "benchmarks/summary/Statistics.h"
#include "benchmarks/worlds/Random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
    using namespace parking;

    const double INFINITE = std::numeric_limits<double>::infinity();

    TEST(Statistics, QuantilesLieLinearlyBetweenValues)
    {
        EXPECT_DOUBLE_EQ(quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
        EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 2.0, 3.0}, 0.5), 2.5);
        EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 2.0, 3.0}, 0.25), 1.75);
        EXPECT_DOUBLE_EQ(quantile({4.0, 1.0}, 0.0), 1.0);
        EXPECT_DOUBLE_EQ(quantile({4.0, 1.0}, 1.0), 4.0);
        EXPECT_DOUBLE_EQ(quantile({7.0}, 0.3), 7.0);
        EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
    }

    TEST(Statistics, InfiniteValuesCountAsTheLargest)
    {
        EXPECT_DOUBLE_EQ(quantile({INFINITE, 1.0, 2.0}, 0.5), 2.0);
        EXPECT_EQ(quantile({INFINITE, INFINITE, 2.0}, 0.5), INFINITE);
        EXPECT_EQ(quantile({INFINITE, 2.0}, 0.5), INFINITE);  // half way to infinity
        EXPECT_EQ(quantile({INFINITE, INFINITE}, 0.5), INFINITE);
    }

    TEST(Statistics, MedianIntervalHasThePublishedRanks)
    {
        // Ranks for 95 % (Conover, table; e.g. n = 10: 2 and 9 with 97.9 %, n = 20: 6 and 15 with 95.9 %).
        const auto numbers = [](int count)
        {
            std::vector<double> values;
            for (int i = count; i >= 1; --i)
                values.push_back(i);
            return values;
        };
        struct Row
        {
            int count;
            double low, high, level;
        };
        for (const Row &row : {Row{6, 1.0, 6.0, 1.0 - 2.0 / 64.0}, {10, 2.0, 9.0, 0.9785}, {20, 6.0, 15.0, 0.9586}})
        {
            const ConfidenceInterval interval = medianInterval(numbers(row.count));
            EXPECT_EQ(interval.low, row.low) << row.count;
            EXPECT_EQ(interval.high, row.high) << row.count;
            EXPECT_NEAR(interval.level, row.level, 1e-4) << row.count;
        }
    }

    TEST(Statistics, FewValuesGiveNoCertainty)
    {
        const ConfidenceInterval five = medianInterval({5.0, 1.0, 2.0, 3.0, 4.0});
        EXPECT_EQ(five.low, 1.0);
        EXPECT_EQ(five.high, 5.0);
        EXPECT_EQ(five.level, 0.0);
        EXPECT_EQ(medianInterval({}).level, 0.0);
        EXPECT_TRUE(std::isnan(medianInterval({}).low));
    }

    TEST(Statistics, MedianIntervalWithTimeOuts)
    {
        const ConfidenceInterval interval = medianInterval({1.0, 2.0, 3.0, 4.0, INFINITE, INFINITE, INFINITE});
        EXPECT_EQ(interval.low, 1.0);
        EXPECT_EQ(interval.high, INFINITE);
    }

    TEST(Statistics, MedianIntervalCoversTheMedianAsOftenAsItSays)
    {
        parking_test::Random random(1);
        constexpr int TRIALS = 20000;
        int covered = 0;
        double level = 0.0;
        for (int trial = 0; trial < TRIALS; ++trial)
        {
            std::vector<double> values;
            for (int i = 0; i < 15; ++i)
                values.push_back(random.between(0.0, 1.0) / random.between(0.0, 1.0));  // median 1, long tails
            const ConfidenceInterval interval = medianInterval(values);
            covered += interval.low <= 1.0 && 1.0 <= interval.high ? 1 : 0;
            level = interval.level;
        }
        EXPECT_NEAR(static_cast<double>(covered) / TRIALS, level, 0.005);
        EXPECT_GE(level, 0.95);
    }
}  // namespace
