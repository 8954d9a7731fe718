#include "benchmarks/worlds/Random.h"
#include "parking_geometry/text/NearestName.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

using namespace parking;

TEST(NearestName, FindsWhatWasMeant)
{
    const std::vector<std::string> planners = {"prm", "rrt", "rrtstar", "rrtconnect", "bitstar", "improved_astar"};
    EXPECT_EQ(nearestName("rrtstr", planners), "rrtstar");
    EXPECT_EQ(nearestName("BITSTAR", planners), "bitstar");
    EXPECT_EQ(nearestName("improvedastar", planners), "improved_astar");
    EXPECT_EQ(nearestName("connect", planners), "rrtconnect");
    EXPECT_EQ(nearestName("pmr", planners), "prm");
    EXPECT_EQ(nearestName("x", {}), "");
    EXPECT_EQ(nearestName("ab", {"bb", "aa"}), "bb");  // the first of equally near ones
    EXPECT_EQ(unknownName("planner", "rrtstr", {"prm", "rrtstar"}),
              "unknown planner 'rrtstr'; did you mean 'rrtstar'? Known: prm, rrtstar");
    EXPECT_EQ(unknownName("planner", "a\nb\xC3", {}), "unknown planner 'a?b?'");
}

TEST(NearestName, SuggestsNothingForWhatResemblesNone)
{
    const std::vector<std::string> models = {"car", "grid8", "grid16"};
    for (const char *name : {"frobnicate", "x", "", "boat", "hybrid", "%%%%%", "grob"})
    {
        EXPECT_EQ(nearestName(name, models), "") << name;
        EXPECT_EQ(unknownName("model", name, models),
                  "unknown model " + inQuotes(name) + "; known: car, grid8, grid16");
    }
    EXPECT_EQ(nearestName(std::string(100000, 'q'), models), "");
    // On both sides of the limit of a third: two of five letters may be wrong, three of six may not.
    EXPECT_EQ(nearestName("gryd9", models), "grid8");
    EXPECT_EQ(nearestName("xxyd16", models), "");
    // Letters that have changed places are one mistake.
    EXPECT_EQ(nearestName("acr", models), "car");
    // Half of the letters may be missing, not more.
    EXPECT_EQ(nearestName("glf8", {"tpcap", "vw_golf8"}), "vw_golf8");
    EXPECT_EQ(nearestName("gf8", {"tpcap", "vw_golf8"}), "");
}

TEST(NearestName, ListsEightNamesAndSuggestsThreeOfMore)
{
    std::vector<std::string> names = {"car", "grid8", "grid16", "grid32", "e", "f", "g", "h"};
    EXPECT_EQ(unknownName("model", "grid64", names),
              "unknown model 'grid64'; did you mean 'grid8'? Known: car, grid8, grid16, grid32, e, f, g, h");
    names.emplace_back("i");
    EXPECT_EQ(unknownName("model", "grid", names), "unknown model 'grid'; did you mean 'grid8', 'grid16' or 'grid32'?");
    EXPECT_EQ(unknownName("model", "frobnicate", names),
              "unknown model 'frobnicate'; the nearest of 9 are 'car', 'grid8' and 'grid16'");
}

TEST(NearestName, TellsAMisspeltNameFromAnotherOne)
{
    const std::vector<std::string> keys = {"image", "negate", "free_thresh"};
    EXPECT_TRUE(isMisspelt("negat", keys));
    EXPECT_TRUE(isMisspelt("free_tresh", keys));
    EXPECT_TRUE(isMisspelt("Image", keys));
    EXPECT_FALSE(isMisspelt("negate", keys));
    EXPECT_FALSE(isMisspelt("frame_id", keys));
    EXPECT_TRUE(isMisspelt("imgae", keys));
    EXPECT_FALSE(isMisspelt("page", keys));
    EXPECT_FALSE(isMisspelt("images", keys));
}

TEST(Text, NumbersAreReadStrictly)
{
    double value = 7.0;
    for (const auto &[text, expected] :
         {std::pair{"1", 1.0}, {"-1.5", -1.5}, {"+2", 2.0}, {"1e3", 1000.0}, {".5", 0.5}, {"5.", 5.0}, {"-0", 0.0}})
    {
        EXPECT_TRUE(parseNumber(text, value)) << text;
        EXPECT_EQ(value, expected) << text;
    }
    value = 7.0;
    for (const char *text :
         {"", " 1", "1 ", "1,5", "nan", "inf", "-inf", "1e999", "0x10", "+-1", "++1", "1f", "--1", "e5", "+"})
        EXPECT_FALSE(parseNumber(text, value)) << text;
    EXPECT_EQ(value, 7.0);
    std::size_t count = 0;
    EXPECT_TRUE(parseCount("12", count));
    EXPECT_EQ(count, 12u);
    for (const char *text : {"", "-1", "+1", "1.0", "1e3", "99999999999999999999"})
        EXPECT_FALSE(parseCount(text, count)) << text;
}

TEST(Text, AnErrorIsOneLineWhateverTheNamesInIt)
{
    EXPECT_STREQ(Error(std::string("a\nb\r\x7F\0c.yaml: cannot be opened", 30)).what(),
                 "a?b???c.yaml: cannot be opened");
    EXPECT_STREQ(Error("Tür.yaml: cannot be opened").what(), "Tür.yaml: cannot be opened");
}

TEST(Text, NumbersAreWrittenWithSoManyDecimals)
{
    EXPECT_EQ(formatNumber(0.0, 0), "0");
    EXPECT_EQ(formatNumber(1.996, 2), "2.00");
    EXPECT_EQ(formatNumber(-0.25, 1), "-0.2");  // to even, as it is exact
    EXPECT_EQ(formatNumber(-0.004, 2), "0.00");
    EXPECT_EQ(formatNumber(-0.006, 2), "-0.01");
    EXPECT_EQ(formatNumber(std::numeric_limits<double>::quiet_NaN(), 3), "nan");
    EXPECT_EQ(formatNumber(-std::numeric_limits<double>::infinity(), 3), "-inf");
    const std::string greatest = formatNumber(-std::numeric_limits<double>::max(), 9);
    EXPECT_EQ(greatest.size(), 1u + 309u + 1u + 9u);
}

TEST(Text, NumbersAreWrittenSoThatTheyReadBack)
{
    EXPECT_EQ(formatNumber(0.0), "0");
    EXPECT_EQ(formatNumber(100000.0), "100000");
    EXPECT_EQ(formatNumber(-0.25), "-0.25");
    EXPECT_EQ(formatNumber(0.1), "0.1");
    EXPECT_EQ(formatNumber(std::numeric_limits<double>::quiet_NaN()), "nan");
    EXPECT_EQ(formatNumber(-std::numeric_limits<double>::infinity()), "-inf");
    parking_test::Random random(3);
    for (int i = 0; i < 20000; ++i)
    {
        const double number = std::ldexp(static_cast<double>(random.bits()) - 9e18, random.below(1200) - 700);
        double value = 0.0;
        ASSERT_TRUE(parseNumber(formatNumber(number), value)) << formatNumber(number);
        EXPECT_EQ(value, number);
    }
}

TEST(Text, QuotesStayOnOneLine)
{
    EXPECT_EQ(inQuotes("plain text"), "'plain text'");
    EXPECT_EQ(inQuotes("a\nb\tc\x7F"), "'a?b?c?'");
    EXPECT_EQ(inQuotes(std::string(61, 'a')), "'" + std::string(60, 'a') + "...'");
    EXPECT_EQ(trimmed(" \r\n a b\t"), "a b");
    EXPECT_EQ(trimmed(" \n"), "");
}
