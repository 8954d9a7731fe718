// A run's record keeps its path in few numbers, from which the path comes back.

#include "benchmarks/comparison/RunRecord.h"
#include "benchmarks/summary/ComparisonPictures.h"
#include "parking_geometry/curves/Path.h"

#include <gtest/gtest.h>

namespace
{
    using namespace parking;

    /** A record with a path, having gone through text. */
    RunRecord throughText(const PlannedPath &path)
    {
        RunRecord record;
        record.hasPath = true;
        record.exact = true;
        record.path = StoredPath::of(path);
        return RunRecord::fromJson(nlohmann::json::parse(record.toJson().dump()));
    }

    void expectSame(const SampledPath &a, const SampledPath &b)
    {
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
        {
            EXPECT_NEAR(a[i].pose.x, b[i].pose.x, 1e-3);
            EXPECT_NEAR(a[i].pose.y, b[i].pose.y, 1e-3);
            EXPECT_NEAR(wrapAngle(a[i].pose.yaw - b[i].pose.yaw), 0.0, 1e-3);
            EXPECT_EQ(a[i].direction, b[i].direction);
        }
    }

    TEST(RunRecord, ArcsComeBack)
    {
        const Path arcs{{1.0, 2.0, 0.5}, {{0.2, 3.0}, {0.0, -2.5}, {-0.25, 1.25}}};
        PlannedPath path;
        path.states = arcs.sample(0.1);
        const RunRecord record = throughText(path);
        ASSERT_EQ(record.path.arcs.size(), 3U);
        EXPECT_NEAR(record.path.arcs[1].length, -2.5, 1e-4);
        expectSame(record.path.sample(0.1), path.states);
    }

    TEST(RunRecord, CornersComeBack)
    {
        PlannedPath path;
        path.straight = true;
        PathState state;
        for (int i = 0; i <= 10; ++i)
        {
            state.pose = {0.1 * i, 0.0, 0.0};
            state.arcLength = 0.1 * i;
            path.states.push_back(state);
        }
        for (int i = 1; i <= 10; ++i)
        {
            state.pose = {1.0, 0.1 * i, 0.0};
            state.arcLength = 1.0 + 0.1 * i;
            path.states.push_back(state);
        }
        const RunRecord record = throughText(path);
        EXPECT_EQ(record.path.corners.size(), 2U);
        const SampledPath back = record.path.sample(0.1);
        ASSERT_EQ(back.size(), path.states.size());
        for (std::size_t i = 0; i < back.size(); ++i)
        {
            EXPECT_NEAR(back[i].pose.x, path.states[i].pose.x, 1e-4);
            EXPECT_NEAR(back[i].pose.y, path.states[i].pose.y, 1e-4);
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
