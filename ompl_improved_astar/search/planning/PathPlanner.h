#pragma once

#include "ompl_improved_astar/search/Search.h"
#include "ompl_improved_astar/search/planning/PathPrices.h"
#include "ompl_improved_astar/search/planning/PathReplanner.h"
#include "ompl_improved_astar/search/planning/PathShortener.h"
#include "ompl_improved_astar/search/planning/Restarts.h"
#include "ompl_improved_astar/search/planning/SideSearch.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace parking::search
{
    /** \brief Parameters of PathPlanner. */
    struct PathPlannerParameters
    {
        SearchParameters search;  ///< of the search
        bool shorten{true};       ///< replace parts by cheaper curves, move poses, turn round elsewhere; needs curves
        bool anytime{false};      ///< keep improving until stopped
    };

    /** \brief Told of every improvement: path and cost. Returns true when that is good enough and planning shall
        end. */
    using ImprovementFunction = std::function<bool(const Path &, double)>;

    /** \brief Plans paths: the search, the shortening of what it finds, and the improvement until stopped.

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
        void begin(MotionEnvironment &environment, const PathPlannerParameters &parameters);

        /** \brief Adds a start, which must be free. May be called between calls of solve(). */
        void addStart(const Pose &pose)
        {
            starts_.push_back(pose);
            search_.addStart(pose);
            restarts_.addStart(pose);
        }

        /** \brief The same for a goal. */
        void addGoal(const Pose &pose)
        {
            search_.addGoal(pose);
            restarts_.addGoal(pose);
        }

        /** \brief Plans; may be called again to go on after Stopped or when roots were added. */
        Outcome solve(const StopFunction &stop, const ImprovementFunction &improved);

        /** \brief A path towards \e target that ends as near to it as the car comes, by distance between the rear
            axles.

            Spends what is left of the time on a search of its own, unless there is none left, or no memory, or
            everything has been seen from the start: then what the frontiers have seen has to do. \return false when
            there is no start */
        bool approximate(const Pose &target, const StopFunction &stop, Path &path);

        /** \brief Is there a path from a start to a goal? */
        bool hasSolution() const
        {
            return bestCost_ < std::numeric_limits<double>::infinity();
        }

        /** \brief The cheapest one, shortened; without pieces when there is none. */
        const Path &bestPath() const
        {
            return bestPath_;
        }

        /** \brief What it costs, in metres and penalties (see CostModel); infinite without one. */
        double bestCost() const
        {
            return bestCost_;
        }

        /** \brief What bestPath() costs for being near to obstacles; see CostModel. Where there is no time to look at
            the whole of it, what those have reckoned who found its parts. */
        double closenessOfBest();

        /** \brief Best cost over Search::lowerBound(), at least 1; infinite without a solution. */
        double suboptimalityBound()
        {
            return suboptimalityBound(bestCost_);
        }

        /** \brief The same for a path that was the best once and cost that much. */
        double suboptimalityBound(double cost);

        /** \brief The search, to be changed: its bounds and weights. */
        Search &search()
        {
            return search_;
        }

        /** \brief The search. */
        const Search &search() const
        {
            return search_;
        }

        /** \brief Nodes expanded in this query: statistics().expanded, for those who ask at every step. */
        std::uint64_t expanded() const
        {
            return search_.expanded() + restarts_.expanded() + replanner_.expanded() + approach_.expanded();
        }

        /** \brief What search and shortening did in this query. */
        SearchStatistics statistics() const;

    private:
        bool isTimeUp() const
        {
            return stop_ && stop_();
        }

        /** Bytes of what all may take that the search leaves to others. */
        std::size_t memoryLeft() const
        {
            const std::size_t most = parameters_.search.maxMemory;
            return most - std::min(most, search_.memory());
        }

        /** May a path give way to quite another one for the sake of room? */
        enum class OtherWay
        {
            Allowed,
            Excluded
        };

        /** Is what a search finds led past obstacles, too? */
        enum class Room
        {
            Sought,
            AsItIs
        };

        Outcome goOnSolving();
        bool take(const Path &path, double cost);
        /** Does \e path still cost less than the best one where both are looked at more closely? Not if there is no
            time for that. */
        bool isCheaperAtACloserLook(const Path &path);
        /** Is it known that no obstacle nearby makes the path cost more? */
        bool isKnownToBeClear(const Path &path);
        void takeFirst();
        /** Searches on, for so many expansions, for what is cheaper than the best path. */
        void goOn(std::uint64_t expansions);
        void thinkAgain(double expected);
        bool shorten(PathPrices &prices, Path &path, double &cost, double spacing, double offset, double widest,
                     CurveChoice choice);
        bool shortenWhole(Path &path, double &cost, double coarsest);
        bool shortenByOtherKnots(PathPrices &prices, Path &path, double &cost, double coarsest);
        void shortenTwice(Path &path, double &cost);
        bool shortenBest(double spacing, double offset);
        /** Drives parts of a path with cusps the other way round, if that makes it cheaper. */
        bool turnRound(Path &path, double &cost);
        /** Moves the poses between the pieces of a path by a step, in turning radii, and replaces what lies around them
            up to so many cusps away. */
        bool relax(Path &path, double &cost, double step, std::size_t cusps);
        /** The same by falling steps, each time a cusp farther; then shortens what has become cheaper. */
        void relaxAndShorten(Path &path, double &cost);
        /** Relaxes a first path not at all, once or several times. \param dearness its cost over what it promised */
        void relaxFirst(Path &path, double &cost, double dearness);
        /** One pass over the best path, by the next one of the steps, until none of them makes it cheaper any more. */
        bool relaxBest();
        std::size_t mostCuspsOf(const Path &path) const;
        /** Takes \e other instead of a path if it costs no more than \e most. */
        bool takeForRoom(const Path &other, double most, Path &path, double &cost);
        /** Leads the path past what it comes too near to. Does it keep what is preferred then? */
        bool widen(Path &path, double &cost);
        /** The same; then looks for another way, where it may, and plans parts anew that still come too near to
            something. */
        void findRoom(Path &best, double &cost, OtherWay otherWay);
        /** Looks for another way that keeps what is preferred, if the path passes closely. Is it cheaper? */
        bool findWayWithRoom(Path &path, double &cost);
        /** Is much of what a path costs for being near to obstacles, and not only where it begins and ends? */
        bool passesClosely(const Path &path, double cost);
        /** What part of the cost of a path is for being near to obstacles. */
        double closenessShare(const Path &path, double cost) const;
        /** Metres that the way is expected to be long at least. */
        double expectedLength();
        bool isShortestPossible(const Path &path, double cost);
        /** Looks for something cheaper by searches that begin anew, by no more of either than so many. */
        bool searchAnew(std::uint64_t expansions, std::uint64_t searches, Room room);
        Outcome improve();

        MotionEnvironment *environment_{nullptr};
        PathPlannerParameters parameters_;
        Search search_;
        Restarts restarts_;
        SideSearch approach_;  // for the place nearest to a goal that cannot be reached
        PathReplanner replanner_;
        std::vector<Pose> starts_;
        PathPrices prices_;        // by the model of the search
        PathPrices closerPrices_;  // by one that looks more closely
        Path bestPath_;
        double bestCost_{std::numeric_limits<double>::infinity()};
        double costWhenTurned_{std::numeric_limits<double>::infinity()};  // of the path that turnRound() tried last
        std::size_t relaxations_{0};  // passes of relaxBest() since it began with the first step,
        double costWhenRelaxed_{std::numeric_limits<double>::infinity()};  // and what the best path cost then
        std::uint64_t shortenerConnections_{0};
        StopFunction stop_;
        ImprovementFunction improved_;
        bool goodEnough_{false};
        std::uint64_t round_{0};
        HeuristicWeights weights_;
    };
}  // namespace parking::search
