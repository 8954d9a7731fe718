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
        isUnderWay_ = false;
        count_ = 0;
        ended_ = {};
    }

    void Restarts::end()
    {
        if (isUnderWay_)
            ended_ += search_->statistics();
        isUnderWay_ = false;
    }

    void Restarts::beginNext(double mostCost)
    {
        if (!search_)
            search_ = std::make_unique<Search>();
        const SearchTuning &tuning = parameters_.tuning;
        SearchParameters parameters = parameters_;
        parameters.eagerObstacles = false;
        ++count_;
        const double longer = between(1.0 - tuning.otherMotions, 1.0 + tuning.otherMotions, fraction(count_, 0));
        parameters.tuning.coarsestStep *= longer;
        parameters.tuning.reach *= longer;
        const auto weight = [this](double given)
        {
            return given > 1.0 ? between(1.0, given, fraction(count_, 1)) : given;
        };
        parameters.weights.far = weight(parameters_.weights.far);
        parameters.weights.near = weight(parameters_.weights.near);
        weights_ = parameters.weights;
        parameters.spreadOut = parameters_.spreadOut && fraction(count_, 2) < 0.5;
        search_->begin(*environment_, parameters);
        search_->setCostBound(mostCost);
        for (const Pose &start : starts_)
            search_->addStart(start);
        for (const Pose &goal : goals_)
            search_->addGoal(goal);
        most_ = static_cast<std::uint64_t>(
            std::min(tuning.mostOfRestart, tuning.firstRestart * std::pow(tuning.longerRestarts, count_ - 1.0)));
        isUnderWay_ = true;
    }

    bool Restarts::run(const StopFunction &stop, std::uint64_t mostExpansions, double mostCost)
    {
        // Searches that hardly get anywhere must not keep the others waiting.
        for (std::size_t k = 0; k < parameters_.tuning.restartsPerRound && expanded() < mostExpansions; ++k)
        {
            if (!isUnderWay_)
                beginNext(mostCost);
            search_->setCostBound(mostCost);
            const std::uint64_t left = mostExpansions - expanded();
            const SearchOutcome outcome = search_->run(stop, std::min(most_, search_->expanded() + left));
            if (outcome == SearchOutcome::Improved)
            {
                weights_ = weights_.lowered(parameters_.tuning.weightsOfAfterthought);
                search_->setWeights(weights_);
                return true;
            }
            if (outcome == SearchOutcome::Stopped && search_->expanded() < most_ && !search_->isFull())
                return false;
            end();
        }
        return false;
    }

    SearchStatistics Restarts::statistics() const
    {
        SearchStatistics sum = ended_;
        if (isUnderWay_)
            sum += search_->statistics();
        return sum;
    }
}  // namespace parking::search
