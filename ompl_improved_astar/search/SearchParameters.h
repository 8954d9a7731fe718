#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/Node.h"
#include "ompl_improved_astar/search/SearchTuning.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "parking_geometry/Box.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace parking::search
{
    /** \brief The weighting of the heuristic: f = g + (w + p) h (paper, section "Heuristic Function Optimization"). */
    struct HeuristicWeights
    {
        double far{2.5};           ///< w where the target is farther than nearGoalDistance
        double near{2.5};          ///< w nearer than that
        double nearDistance{5.0};  ///< metres, straight
        double tieBreak{1e-3};     ///< p

        /** \brief w + p at so many metres from the target. */
        double at(double distance) const
        {
            return (distance > nearDistance ? far : near) + tieBreak;
        }

        /** \brief Both times \e factor, but weights above 1 no lower than 1, and others as they are. */
        HeuristicWeights lowered(double factor) const
        {
            const auto lower = [factor](double weight)
            {
                return weight > 1.0 ? std::max(1.0, factor * weight) : weight;
            };
            return {lower(far), lower(near), nearDistance, tieBreak};
        }
    };

    /** \brief What a search goes by. The names are those of the parts' registries. */
    struct SearchParameters
    {
        std::string motionModel{"car"};       ///< see motionModels()
        std::string heuristic{"default"};     ///< see heuristics(); `default`: the one that suits the motion model
        std::string openList{"binary_heap"};  ///< see openLists()
        double turningRadius{1.0};            ///< metres, of the rear axle
        bool forwardOnly{false};              ///< never drive in reverse (Dubins)
        std::uint8_t mostCusps{ANY_CUSPS};    ///< changes of direction of what is found
        unsigned int steeringAngles{3};       ///< odd: straight and as many to the left as to the right
        double xyResolution{0.0};             ///< metres, side of a cell; 0: the motion model chooses
        unsigned int headingBins{72};         ///< cells of heading for steps of one metre
        double inscribedRadius{0.0};          ///< metres: no obstacle can be nearer to the rear axle than this
        double bodyRadius{0.0};               ///< metres, of the largest disc within the car; at least the one above
        double turningLane{0.0};              ///< metres, width of what the car covers at full lock; 0: unknown
        Box bounds;                           ///< what the grids search, and eagerObstacles looks at beforehand
        HeuristicWeights weights;             ///< how much estimates count
        bool bidirectional{true};             ///< search from the goal and the start; otherwise from one side only
        bool searchFromGoal{true};            ///< the side, when not bidirectional
        bool adaptiveResolution{true};        ///< refine where coarse steps do not get through
        bool analyticExpansion{true};         ///< join the two sides by curves
        bool obstacleHeuristic{true};         ///< guide round obstacles by ObstacleHeuristic
        bool lookAhead{true};                 ///< drive on along the way round obstacles while there is room
        bool spreadOut{true};                 ///< let nodes in places that are crowded wait
        bool detours{true};                   ///< try other ways round obstacles when stuck
        bool eagerObstacles{false};           ///< find out what is free before the search instead of during it
        std::size_t maxMemory{std::size_t{512} << 20};  ///< bytes of nodes, cells and lists; the search stops there
        CostModel cost;                                 ///< what motions cost
        SearchTuning tuning;                            ///< constants behind it all
    };

    /** \brief What a search did. */
    struct SearchStatistics
    {
        std::uint64_t expanded{0};             ///< nodes whose motions were tried
        std::uint64_t generated{0};            ///< motions tried
        std::uint64_t connections{0};          ///< analytic connections tried
        std::uint64_t heuristicCells{0};       ///< cells expanded by the obstacle-aware heuristic
        std::uint64_t openListOperations{0};   ///< entries pushed to, and popped from, the open lists
        std::uint64_t openListComparisons{0};  ///< of their entries with each other, for that

        /** \brief Adds what another search did. */
        SearchStatistics &operator+=(const SearchStatistics &other)
        {
            expanded += other.expanded;
            generated += other.generated;
            connections += other.connections;
            heuristicCells += other.heuristicCells;
            openListOperations += other.openListOperations;
            openListComparisons += other.openListComparisons;
            return *this;
        }
    };
}  // namespace parking::search
