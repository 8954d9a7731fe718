// What a search leaves out once it has a solution: nothing that could make it cheaper, and most of it unasked.

#include "ompl_improved_astar/search/Heuristic.h"
#include "ompl_improved_astar/search/MotionModel.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"
#include "tests/ompl_improved_astar/search/ClearanceWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    using Bound = std::function<double(const MotionModel &car, const Pose &from, const Pose &to)>;

    /** The car with another bound of what lies ahead. */
    class CarWithOtherBound final : public MotionModel
    {
    public:
        explicit CarWithOtherBound(Bound bound) : bound_(std::move(bound))
        {
        }

        void begin(MotionEnvironment &environment, const SearchParameters &parameters) override
        {
            car_->begin(environment, parameters);
        }
        ModelTraits traits() const override
        {
            return car_->traits();
        }
        std::string heuristic() const override
        {
            return car_->heuristic();
        }
        std::uint64_t cell(const Pose &pose, std::size_t level) const override
        {
            return car_->cell(pose, level);
        }
        double worthKeeping(std::size_t level) const override
        {
            return car_->worthKeeping(level);
        }
        double mobility(const Pose &root) override
        {
            return car_->mobility(root);
        }
        void expand(Side side, NodeIndex index, const Node &node, std::size_t level, bool first,
                    Expansion &expansion) override
        {
            car_->expand(side, index, node, level, first, expansion);
        }
        bool join(const Node &fromStart, const Node &fromGoal, Side sweptFrom, double bound,
                  const Offer &offer) override
        {
            return car_->join(fromStart, fromGoal, sweptFrom, bound, offer);
        }
        void moveTowards(Side side, const Pose &from, const Pose &to, std::vector<Successor> &motions) override
        {
            car_->moveTowards(side, from, to, motions);
        }
        double distance(const Pose &from, const Pose &to) const override
        {
            return car_->distance(from, to);
        }
        double leastDistance(const Pose &from, const Pose &to) const override
        {
            return bound_(*car_, from, to);
        }
        const ReedsShepp *curves() const override
        {
            return car_->curves();
        }

    private:
        Bound bound_;
        std::unique_ptr<MotionModel> car_ = motionModels().make("car");
    };

    /** The length of the shortest curve, untabulated. */
    class CountedEstimates final : public Heuristic
    {
    public:
        void begin(const HeuristicQuery &query) override
        {
            targets_ = query.targets;
        }
        double estimate(const Pose &pose) override
        {
            return lowerBound(pose);
        }
        double lowerBound(const Pose &pose) override
        {
            ++asked;
            double least = std::numeric_limits<double>::infinity();
            for (const Pose &target : targets_)
                least = std::min(least, curves_.distance(pose, target));
            return least;
        }

        static inline std::uint64_t asked = 0;

    private:
        ReedsShepp curves_{TURNING_RADIUS};
        std::vector<Pose> targets_;
    };

    struct Searched
    {
        std::vector<double> costs;  // of one solution after the other
        std::uint64_t expanded, generated, estimates;
    };

    bool operator==(const Searched &a, const Searched &b)
    {
        return a.costs == b.costs && a.expanded == b.expanded && a.generated == b.generated;
    }

    struct Preferences
    {
        double clearance;  // metres that are preferred
        double weight;     // of the heuristic
    };

    /** Up to so many expansions. */
    Searched searchIn(const CarProblem &problem, const std::string &model, const Preferences &preferences)
    {
        SearchParameters parameters = parametersIn(problem);
        parameters.motionModel = model;
        parameters.heuristic = "counted";
        parameters.cost.preferredClearance = preferences.clearance;
        parameters.cost.clearanceCost = 1.0;
        parameters.weights.far = parameters.weights.near = preferences.weight;
        CountedEstimates::asked = 0;
        ClearanceWorld world(problem.world);
        Search search;
        search.begin(world, parameters);
        for (const Pose &start : problem.starts)
            search.addStart(start);
        for (const Pose &goal : problem.goals)
            search.addGoal(goal);
        Searched searched{};
        while (search.run({}, 300) == SearchOutcome::Improved)
            searched.costs.push_back(search.bestCost());
        searched.expanded = search.statistics().expanded;
        searched.generated = search.statistics().generated;
        searched.estimates = CountedEstimates::asked;
        return searched;
    }
}  // namespace

/** One goal and two, with room preferred and without, in search of some way and of the cheapest. */
TEST(SearchPruning, aBoundOfWhatLiesAheadSparesEstimatesAndChangesNothing)
{
    heuristics().add("counted", newPart<CountedEstimates>);
    const std::vector<std::pair<std::string, Bound>> bounds{
        {"unbounded",
         [](const MotionModel &, const Pose &, const Pose &)
         {
             return 0.0;
         }},
        {"straight",
         [](const MotionModel &, const Pose &from, const Pose &to)
         {
             return positionDistance(from, to);
         }},
        {"overbounded", [](const MotionModel &car, const Pose &from, const Pose &to)
         {
             return 4.0 * car.leastDistance(from, to);
         }}};
    for (const auto &[name, bound] : bounds)
        motionModels().add(name, [bound = bound] { return std::make_unique<CarWithOtherBound>(bound); });
    for (const Preferences &preferences : {Preferences{0.0, 2.0}, {0.5, 2.0}, {0.0, 1.0}, {0.5, 1.0}})
    {
        SCOPED_TRACE(testing::Message() << preferences.clearance << " m, weight " << preferences.weight);
        int solved = 0, changedByTooMuch = 0;
        std::uint64_t own = 0, straight = 0, without = 0;
        for (std::uint64_t seed = 0; seed < 40; ++seed)
        {
            SCOPED_TRACE(seed);
            CarProblem problem = randomProblem(seed);
            if (seed % 2 == 1)
                problem.goals.push_back(randomProblem(seed + 500).goals.front());
            if (!(problem.world.gap(problem.goals.back()) > 0.0))
                continue;
            const Searched car = searchIn(problem, "car", preferences),
                           unbounded = searchIn(problem, "unbounded", preferences),
                           straightOnly = searchIn(problem, "straight", preferences);
            ASSERT_TRUE(car == unbounded);
            ASSERT_TRUE(straightOnly == unbounded);
            solved += !car.costs.empty();
            changedByTooMuch += !(searchIn(problem, "overbounded", preferences) == unbounded);
            own += car.estimates;
            straight += straightOnly.estimates;
            without += unbounded.estimates;
        }
        EXPECT_GT(solved, 20);
        EXPECT_GT(changedByTooMuch, 10) << "what is no bound is noticed";
        EXPECT_LT(straight, without);
        EXPECT_LT(own, straight) << "the turn that is still to be made counts, too";
        EXPECT_LT(own, 2 * without / 3);
    }
}
