#pragma once

#include "ompl_improved_astar/search/Search.h"
#include "ompl_improved_astar/search/planning/PathEnds.h"
#include "ompl_improved_astar/search/planning/PathImprover.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace parking::search
{
    /** \brief Receives every improvement: path and cost. Returns true to end planning. */
    using ImprovementFunction = std::function<bool(const Path &, double)>;

    /** \brief Plans paths: alternates between search and improvement of the path until stopped.

        Independent of OMPL. One object may serve many queries and keeps its memory. */
    class PathPlanner
    {
    public:
        /** \brief Why solve() returned. */
        enum class Outcome
        {
            Solved,     ///< a solution that will not be improved further
            Exhausted,  ///< no solution: see Search::exhaustion()
            Stopped     ///< stopped, with or without a solution
        };

        /** \brief Begins a new query in \e environment, which must outlive it. */
        void begin(MotionEnvironment &environment, const PlannerParameters &parameters, const CarInSpace &car);

        /** \brief Adds a start, which must be free, also between calls of solve(). */
        void addStart(const Pose &pose);

        /** \brief Adds a start in contact by its escapes, if the parameter escape is on.

            \return whether there is one */
        bool addEscapes(const Pose &pose);

        /** \brief The same as addStart() for a goal. */
        void addGoal(const Pose &pose);

        /** \brief Plans; call it again to resume after Stopped or after adding roots. */
        Outcome solve(const StopFunction &stop, const ImprovementFunction &improved);

        /** \brief Improves a path of another planner for the same query, and takes it if it is the cheapest. */
        void offer(const Path &path, const StopFunction &stop, const ImprovementFunction &improved);

        /** \brief Finds a path that ends as near to \e target as possible, by distance between the rear axles.

            Runs a separate search from the start. If no time or memory is left, or the start's side is exhausted,
            uses the nearest node of the frontiers instead. \return false if there is no start */
        bool approximate(const Pose &target, const StopFunction &stop, Path &path);

        /** \brief Whether a path from a start to a goal is known. */
        bool hasSolution() const
        {
            return best_.cost < std::numeric_limits<double>::infinity();
        }

        /** \brief The cheapest path; without pieces if there is none or the start is at a goal. */
        const Path &bestPath() const
        {
            return whole_.path;
        }

        /** \brief The escape with which the path of solve() or approximate() begins, if any. */
        const std::optional<Escape> &escape() const
        {
            return first_.escape;
        }

        /** \brief One line on an escape, and on straights that are shorter than the parameters require or may prevent a
            solution; empty otherwise. */
        std::string notice() const;

        /** \brief Cost of bestPath() in metres and penalties (see CostModel); infinite without a path. */
        double bestCost() const
        {
            return whole_.cost;
        }

        /** \brief Part of bestCost() for closeness to obstacles. */
        double proximityOfBest() const
        {
            return whole_.totalProximity();
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

        /** \brief Work of search and improvement in this query. */
        SearchStatistics statistics() const;

    private:
        bool isStopped() const
        {
            return stop_ && stop_();
        }
        void endCall();
        bool isAtGoal(const Pose &start) const;
        bool takeStay();
        PricedPath withEnds(const PricedPath &path) const;
        void planFirst();
        Outcome planAnytime();
        bool approach(const Pose &target, const StopFunction &stop, Path &path);
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
        PathEnds starts_, goals_;
        PricedPath best_;         // of the search
        PricedPath whole_;        // the same with the motions at its ends
        EndMotion first_, last_;  // these motions
        StopFunction stop_;
        ImprovementFunction improved_;
        bool isGoodEnough_{false};
        std::uint64_t passes_{0};  // of improveBest()
    };
}  // namespace parking::search
