// What a search leaves out once it has a solution: nothing that could make it cheaper, and most of it unasked.

#include "ompl_improved_astar/search/Heuristic.h"
#include "ompl_improved_astar/search/MotionModel.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
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
    /** The car with another bound of what lies ahead: so many times its own. */
    class CarWithOtherBound final : public MotionModel
    {
    public:
        explicit CarWithOtherBound(double factor) : factor_(factor)
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
            return factor_ * car_->leastDistance(from, to);
        }
        const ReedsShepp *curves() const override
        {
            return car_->curves();
        }

    private:
        double factor_;
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
            ++asked;
            return lowerBound(pose);
        }
        double lowerBound(const Pose &pose) override
        {
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

    /** Up to so many expansions. */
    Searched searchIn(CarProblem problem, const std::string &model, std::uint64_t expansions)
    {
        SearchParameters parameters = parametersIn(problem);
        parameters.motionModel = model;
        parameters.heuristic = "counted";
        CountedEstimates::asked = 0;
        Search search;
        problem.begin(search, parameters);
        Searched searched{};
        while (search.run({}, expansions) == SearchOutcome::Improved)
            searched.costs.push_back(search.bestCost());
        searched.expanded = search.statistics().expanded;
        searched.generated = search.statistics().generated;
        searched.estimates = CountedEstimates::asked;
        return searched;
    }
}  // namespace

TEST(SearchPruning, aBoundOfWhatLiesAheadSparesEstimatesAndChangesNothing)
{
    heuristics().add("counted", newPart<CountedEstimates>);
    for (const auto &[name, factor] : {std::pair{"unbounded", 0.0}, {"bounded", 1.0}, {"overbounded", 4.0}})
        motionModels().add(name, [factor = factor] { return std::make_unique<CarWithOtherBound>(factor); });
    int solved = 0, changedByTooMuch = 0;
    std::uint64_t estimates = 0, estimatesWithout = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        const CarProblem problem = randomProblem(seed);
        const Searched own = searchIn(problem, "car", 300), bounded = searchIn(problem, "bounded", 300),
                       unbounded = searchIn(problem, "unbounded", 300),
                       overbounded = searchIn(problem, "overbounded", 300);
        ASSERT_EQ(bounded.costs, unbounded.costs);
        ASSERT_EQ(bounded.expanded, unbounded.expanded);
        ASSERT_EQ(bounded.generated, unbounded.generated);
        ASSERT_EQ(bounded.estimates, own.estimates);
        solved += !bounded.costs.empty();
        changedByTooMuch += overbounded.costs != unbounded.costs;
        estimates += bounded.estimates;
        estimatesWithout += unbounded.estimates;
    }
    EXPECT_GT(solved, 40);
    EXPECT_GT(changedByTooMuch, 20) << "what is no bound is noticed";
    EXPECT_LT(estimates, 2 * estimatesWithout / 3);
}
