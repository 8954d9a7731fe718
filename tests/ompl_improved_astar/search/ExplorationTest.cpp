// The order in which places are explored, against a list that is searched from end to end.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/Exploration.h"
#include "ompl_improved_astar/search/Frontier.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <vector>

using namespace parking;
using namespace parking::search;
using parking_test::Random;

namespace
{
    constexpr double SIDE = 4.0;
    constexpr unsigned int SECTORS = 8;

    struct Oracle
    {
        struct Waiting
        {
            std::uint64_t place;
            Exploration::Candidate candidate;
        };

        Crowds places;  // for the numbers of the places only
        std::map<std::uint64_t, std::uint32_t> expansions;
        std::map<std::uint64_t, NodeIndex> last;
        std::vector<Waiting> waiting;

        Oracle()
        {
            places.begin(SIDE, SECTORS);
        }

        NodeIndex lastAt(const Pose &pose) const
        {
            const auto found = last.find(places.placeOf(pose));
            return found == last.end() ? NO_NODE : found->second;
        }

        Exploration::Candidate pop()
        {
            if (waiting.empty())
                return {};
            std::size_t best = 0;
            for (std::size_t i = 1; i < waiting.size(); ++i)
                if (expansions[waiting[i].place] <= expansions[waiting[best].place])
                    best = i;
            const Exploration::Candidate candidate = waiting[best].candidate;
            waiting.erase(waiting.begin() + static_cast<std::ptrdiff_t>(best));
            return candidate;
        }
    };
}  // namespace

TEST(Exploration, takesTheNewestOfTheLeastExpandedPlaces)
{
    Random random(3);
    Exploration exploration;
    for (int round = 0; round < 3; ++round)
    {
        exploration.begin(SIDE, SECTORS);
        EXPECT_EQ(exploration.pop().node, NO_NODE);
        Oracle oracle;
        NodeIndex number = 0;
        for (int i = 0; i < 3000; ++i)
        {
            const Pose pose{random.between(-9.0, 9.0), random.between(-9.0, 9.0), random.between(-PI, PI)};
            const std::uint64_t place = oracle.places.placeOf(pose);
            ASSERT_EQ(exploration.lastExpandedAt(pose), oracle.lastAt(pose));
            const double what = random.between(0.0, 1.0);
            if (what < 0.5)
            {
                const Exploration::Candidate candidate{number++, static_cast<std::size_t>(i) % 7};
                exploration.push(pose, candidate.level, candidate.node);
                oracle.waiting.push_back({place, candidate});
            }
            else if (what < 0.75)
            {
                exploration.noteExpansion(pose, number);
                ++oracle.expansions[place];
                oracle.last[place] = number++;
            }
            else
            {
                const Exploration::Candidate expected = oracle.pop(), actual = exploration.pop();
                ASSERT_EQ(actual.node, expected.node);
                ASSERT_EQ(actual.level, expected.level);
            }
        }
    }
}

TEST(Exploration, forgetsEverythingAndSaysHowMuchItHolds)
{
    Exploration exploration;
    exploration.begin(SIDE, SECTORS);
    const std::size_t empty = exploration.bytes();
    const Pose pose{1.0, 2.0, 0.5};
    exploration.noteExpansion(pose, 7);
    const std::size_t expanded = exploration.bytes();
    EXPECT_GT(expanded, empty);
    for (NodeIndex i = 0; i < 100; ++i)
        exploration.push(pose, 0, i);
    EXPECT_GE(exploration.bytes(), expanded + 100 * (sizeof(NodeIndex) + sizeof(std::uint64_t)));
    EXPECT_EQ(exploration.lastExpandedAt(pose), 7u);
    exploration.clear();
    EXPECT_EQ(exploration.bytes(), empty);
    EXPECT_EQ(exploration.pop().node, NO_NODE);
    EXPECT_EQ(exploration.lastExpandedAt(pose), NO_NODE);
}

TEST(Frontier, countsThePlacesThatItKeepsAsMemory)
{
    Frontier frontier(Side::Start);
    frontier.begin("binary_heap", 1, 8.0);
    frontier.crowds.begin(SIDE, SECTORS);
    frontier.exploration.begin(SIDE, SECTORS);
    const std::size_t nothing = frontier.bytes();
    frontier.crowds.add({1.0, 2.0, 0.5});
    const std::size_t crowded = frontier.bytes();
    EXPECT_EQ(crowded, nothing + frontier.crowds.bytes());
    frontier.exploration.push({1.0, 2.0, 0.5}, 0, 0);
    EXPECT_EQ(frontier.bytes(), crowded + frontier.exploration.bytes());
    EXPECT_GT(frontier.exploration.bytes(), 0u);
}
