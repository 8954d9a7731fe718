#include "ompl_improved_astar/search/planning/Restarts.h"

#include <algorithm>
#include <cmath>

namespace parking::search
{
    namespace
    {
        /** The multiples of these three, without their whole parts, fill the unit cube evenly (after M. Roberts, "The
            unreasonable effectiveness of quasirandom sequences", 2018). */
        constexpr double STEPS[3]{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};

        double fraction(std::uint64_t number, std::size_t dimension)
        {
            return std::fmod(0.5 + STEPS[dimension] * static_cast<double>(number), 1.0);
        }

        double between(double least, double most, double fraction)
        {
            return least + (most - least) * fraction;
        }
    }  // namespace

    void Restarts::begin(MotionEnvironment &environment, const SearchParameters &parameters)
    {
        environment_ = &environment;
        parameters_ = parameters;
        starts_.clear();
        goals_.clear();
        side_.forget();
        searches_ = 0;
    }

    bool Restarts::beginNext(const StopFunction &stop, double mostCost)
    {
        const SearchTuning &tuning = parameters_.tuning;
        SearchParameters parameters = besideKnownWay(parameters_);
        // Nor need another way be found at any cost.
        parameters.tuning.greedyDetours = false;
        const std::uint64_t number = searches_ + 1;
        const double longer = between(1.0 - tuning.otherMotions, 1.0 + tuning.otherMotions, fraction(number, 0));
        parameters.tuning.coarsestStep *= longer;
        parameters.tuning.reach *= longer;
        const auto weight = [number](double given)
        {
            return given > 1.0 ? between(1.0, given, fraction(number, 1)) : given;
        };
        parameters.weights.far = weight(parameters_.weights.far);
        parameters.weights.near = weight(parameters_.weights.near);
        weights_ = parameters.weights;
        parameters.spreadOut = parameters_.spreadOut && fraction(number, 2) < 0.5;
        Search &search = side_.begin(*environment_, parameters);
        search.setCostBound(mostCost);
        for (const Pose &start : starts_)
            search.addStart(start);
        for (const Pose &goal : goals_)
        {
            // Each is joined with all starts.
            if (stop && stop())
            {
                side_.end();
                return false;
            }
            search.addGoal(goal);
        }
        most_ = static_cast<std::uint64_t>(
            std::min(tuning.mostOfRestart, tuning.firstRestart * std::pow(tuning.longerRestarts, searches_)));
        ++searches_;
        return true;
    }

    bool Restarts::run(const StopFunction &stop, std::uint64_t mostExpansions, std::uint64_t mostSearches,
                       double mostCost)
    {
        while (expanded() < mostExpansions)
        {
            if (!side_.isUnderWay() && (searches_ >= mostSearches || !beginNext(stop, mostCost)))
                return false;
            Search &search = side_.search();
            search.setCostBound(mostCost);
            const std::uint64_t left = mostExpansions - expanded();
            const SearchOutcome outcome = search.run(stop, std::min(most_, search.expanded() + left));
            if (outcome == SearchOutcome::Improved)
            {
                weights_ = weights_.lowered(parameters_.tuning.weightsOfAfterthought);
                search.setWeights(weights_, stop);
                return true;
            }
            if (outcome == SearchOutcome::Stopped && search.expanded() < most_ && !search.isFull())
                return false;
            side_.end();
        }
        return false;
    }
}  // namespace parking::search
