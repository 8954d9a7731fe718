#include "benchmarks/studies/reliability/SoakFigures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace parking
{
    namespace
    {
        constexpr double SHORTEST = 1e-7;  // seconds
        constexpr double RATIO = 1.05;     // of one class to the next
    }                                      // namespace

    void LatencyCounts::add(double time)
    {
        const double place = std::log(std::max(time, SHORTEST) / SHORTEST) / std::log(RATIO);
        ++counts_[std::min(static_cast<std::size_t>(place), CLASSES - 1)];
    }

    LatencyCounts &LatencyCounts::operator+=(const LatencyCounts &other)
    {
        for (std::size_t i = 0; i < CLASSES; ++i)
            counts_[i] += other.counts_[i];
        return *this;
    }

    std::uint64_t LatencyCounts::count() const
    {
        return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t(0));
    }

    double LatencyCounts::quantile(double share) const
    {
        const double wanted = share * static_cast<double>(count());
        double seen = 0.0;
        for (std::size_t i = 0; i < CLASSES; ++i)
        {
            seen += static_cast<double>(counts_[i]);
            if (counts_[i] > 0 && seen >= wanted)
                return SHORTEST * std::pow(RATIO, static_cast<double>(i + 1));
        }
        return 0.0;
    }

    void SoakFigures::disagree(const std::string &what)
    {
        constexpr std::size_t MOST = 100;
        ++disagreed;
        if (disagreements.size() < MOST)
            disagreements.push_back(what);
    }

    SoakFigures &SoakFigures::operator+=(const SoakFigures &other)
    {
        worlds += other.worlds;
        queries += other.queries;
        solved += other.solved;
        replanned += other.replanned;
        repeated += other.repeated;
        seenByOracle += other.seenByOracle;
        byOthers += other.byOthers;
        refusedOfOthers += other.refusedOfOthers;
        planning += other.planning;
        disagreed += other.disagreed;
        disagreements.insert(disagreements.end(), other.disagreements.begin(), other.disagreements.end());
        return *this;
    }
}  // namespace parking
