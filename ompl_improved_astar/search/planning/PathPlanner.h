#pragma once

#include "ompl_improved_astar/search/Search.h"
#include "ompl_improved_astar/search/planning/PathImprover.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace parking::search
{
    /** \brief Receives every improvement: path and cost. Returns true when that is good enough and planning shall
        end. */
    using ImprovementFunction = std::function<bool(const Path &, double)>;

    /** \brief Plans paths: searches a while, improves the path, and repeats that until stopped.

        Knows nothing of OMPL. One object may serve many queries and keeps its memory. */
    class PathPlanner
    {
    public:
        /** \brief Why solve() came back. */
        enum class Outcome
        {
            Solved,     ///< there is a solution, and it will not be improved further
            Exhausted,  ///< there is none at the finest resolution, or no hope for one: see Search::exhaustion()
            Stopped     ///< stopped; there may be a solution
        };

        /** \brief Begins a new query in \e environment, which must outlive it. */
        void begin(MotionEnvironment &environment, const PlannerParameters &parameters, const CarInSpace &car);

        /** \brief Adds a start, which must be free. May be called between calls of solve(). */
        void addStart(const Pose &pose)
        {
            starts_.push_back(pose);
            search_.addStart(pose);
        }

        /** \brief The same for a goal. */
        void addGoal(const Pose &pose)
        {
            hasGoal_ = true;
            search_.addGoal(pose);
        }

        /** \brief Plans; may be called again to go on after Stopped or when roots were added. */
        Outcome solve(const StopFunction &stop, const ImprovementFunction &improved);

        /** \brief A path towards \e target that ends as near to it as the car comes, by distance between the rear
            axles.

            Spends what is left of the time on a search of its own, unless there is none left, or no memory, or
            everything has been seen from the start: then what the frontiers have seen has to do. \return false if there
            is no start */
        bool approximate(const Pose &target, const StopFunction &stop, Path &path);

        /** \brief Is there a path from a start to a goal? */
        bool hasSolution() const
        {
            return best_.cost < std::numeric_limits<double>::infinity();
        }

        /** \brief The cheapest path; without pieces when there is none. */
        const Path &bestPath() const
        {
            return best_.path;
        }

        /** \brief Its cost, in metres and penalties (see CostModel); infinite without one. */
        double bestCost() const
        {
            return best_.cost;
        }

        /** \brief Part of bestCost() for being nearer to obstacles than preferred. */
        double proximityOfBest() const
        {
            return best_.totalProximity();
        }

        /** \brief \e cost of a path over Search::lowerBound(), at least 1; infinite without a solution. */
        double suboptimalityBound(double cost);

        /** \brief The search. */
        const Search &search() const
        {
            return search_;
        }

        /** \brief Nodes expanded in this query: statistics().expanded. */
        std::uint64_t expanded() const
        {
            return search_.expanded() + (approach_ ? approach_->expanded() : 0);
        }

        /** \brief What search and improvement did in this query. */
        SearchStatistics statistics() const;

    private:
        bool isStopped() const
        {
            return stop_ && stop_();
        }
        void planFirst();
        Outcome planAnytime();
        PricedPath priced(const Path &path, double cost) const;
        bool take(const PricedPath &path);
        bool isCheaperFinelySampled(const Path &path) const;
        bool isShortestPossible(const PricedPath &path) const;
        bool improve(PricedPath &path, const PathImprover::Pass &pass);
        void improveFirst(PricedPath &path, double expected);
        bool improveBest();

        MotionEnvironment *environment_{nullptr};
        PlannerParameters parameters_;
        CarInSpace car_;
        Search search_;
        std::unique_ptr<Search> approach_;  // for the place nearest to a goal that cannot be reached
        std::optional<PathImprover> improver_;
        std::vector<Pose> starts_;
        bool hasGoal_{false};
        PricedPath best_;
        StopFunction stop_;
        ImprovementFunction improved_;
        bool isGoodEnough_{false};
        std::uint64_t passes_{0};  // of improveBest()
    };
}  // namespace parking::search
