// A run's record keeps its path in exact pieces, from which the path comes back.

#include "benchmarks/comparison/RunRecord.h"
#include "benchmarks/summary/ComparisonPictures.h"
#include "parking_geometry/curves/Path.h"

#include <gtest/gtest.h>

namespace
{
    using namespace parking;

    TEST(RunRecord, KeepsItsPathExactly)
    {
        Path path{{1.0 / 3.0, 2.0, 0.5}, {{0.2, 3.0}, {0.0, -2.5}, {-0.25, 1.25, 0.1}}};
        path.append(PathPiece::turnOnTheSpot(0.7));
        path.append({0.0, 1e-5});
        RunRecord record;
        record.hasPath = true;
        record.exact = true;
        record.path = path;
        const RunRecord back = RunRecord::fromJson(nlohmann::json::parse(record.toJson().dump()));
        EXPECT_TRUE(back.hasPath);
        EXPECT_TRUE(back.exact);
        EXPECT_EQ(back.path.start.x, path.start.x);
        EXPECT_EQ(back.path.start.yaw, path.start.yaw);
        ASSERT_EQ(back.path.pieces.size(), path.pieces.size());
        for (std::size_t i = 0; i < path.pieces.size(); ++i)
        {
            EXPECT_EQ(back.path.pieces[i].curvature, path.pieces[i].curvature);
            EXPECT_EQ(back.path.pieces[i].length, path.pieces[i].length);
            EXPECT_EQ(back.path.pieces[i].sharpness, path.pieces[i].sharpness);
            EXPECT_EQ(back.path.pieces[i].turn, path.pieces[i].turn);
        }
        EXPECT_FALSE(RunRecord::fromJson(nlohmann::json::parse(RunRecord().toJson().dump())).hasPath);
    }

    TEST(RunRecord, APieceThatIsNoneIsRefused)
    {
        RunRecord record;
        record.hasPath = true;
        record.path = {{}, {{0.0, 1.0}}};
        for (const char *piece : {"[]", "[1, 2, 3, 4]", "7", "[\"a\"]"})
        {
            nlohmann::json text = record.toJson();
            text["path"]["pieces"].push_back(nlohmann::json::parse(piece));
            EXPECT_ANY_THROW(RunRecord::fromJson(text)) << piece;
        }
    }

    TEST(RunRecord, TheBestRunIsTheShortestThatIsSolved)
    {
        const auto run = [](bool success, bool exact, double length)
        {
            RunRecord record;
            record.hasPath = true;
            record.exact = exact;
            record.success = success;
            record.pathLength = length;
            return record;
        };
        const RunRecord near = run(false, false, 1.0), invalid = run(false, true, 2.0), longer = run(true, true, 9.0),
                        shorter = run(true, true, 8.0);
        RunRecord nothing;
        EXPECT_EQ(bestRun({&near, &longer, &invalid, &nothing, &shorter}), &shorter);
        EXPECT_EQ(bestRun({&near, &invalid}), &invalid);
        EXPECT_EQ(bestRun({&nothing, &near}), &near);
        EXPECT_EQ(bestRun({&nothing}), nullptr);
    }
}  // namespace
