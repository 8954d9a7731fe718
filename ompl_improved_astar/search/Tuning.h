#pragma once

#include <cstddef>
#include <cstdint>

/** \brief The constants of the planner. None of them affects which motions are free.

    Lengths are in turning radii unless another unit is given, so they hold for cars of any size. */
namespace parking::search::tuning
{
    // Motions of the car
    constexpr double MAX_MOTION = 4.0 / 3.0;     ///< longest motion: larger crosses open ground in fewer steps
    constexpr double COARSEST_STEP = 2.0 / 3.0;  ///< step of the coarsest level, halved per level
    constexpr double MIN_MOTION = 0.004;         ///< shorter motions are dropped: smaller lets the car creep to contact
    constexpr double CELL_SIDE = 0.1;            ///< of a cell for steps of a third: smaller keeps more nodes

    // Frontiers and levels
    constexpr double LEVEL_TURN_RATIO = 8.0;         ///< turns of a level to those of the next finer one
    constexpr std::uint64_t OTHER_SIDE_PERIOD = 6;   ///< one expansion in that many goes to the less confined side
    constexpr std::uint64_t STALL_LIMIT = 3000;      ///< expansions without progress that end a hopeless search
    constexpr std::uint64_t STALL_LIMIT_NEAR = 400;  ///< stall limit once the car is within NEAR_TARGET
    constexpr double NEAR_TARGET = 1.0 / 3.0;        ///< beyond the nearest position of the inscribed disc

    // Route round the obstacles (see RouteHeuristic)
    constexpr double ROUTE_CELL = 1.0 / 6.0;            ///< side of a cell: smaller sees narrower gaps, and costs more
    constexpr double MIN_ROUTE_CELL = 0.35;             ///< radii of the largest disc within the car, at least
    constexpr double ROUTE_CELL_LONG = 1.0 / 120.0;     ///< side as a share of the distance on long routes
    constexpr double ROUTE_CELL_RATIO = 2.5;            ///< largest factor on the side for long routes
    constexpr std::uint64_t MAX_ROUTE_CELLS = 4000000;  ///< settled: bounds memory in a world without walls
    constexpr std::uint64_t MAX_DETOUR_CELLS = 400000;  ///< settled by the route of a wider disc

    // Looking ahead along the route
    constexpr double LOOKAHEAD = 3.0;            ///< along the route to the place that is driven to
    constexpr double LOOKAHEAD_HEADING = 1.5;    ///< along the route to either side over which its heading is taken
    constexpr double MAX_LOOKAHEAD_RATIO = 1.3;  ///< length of the curve there to the straight line

    // Spreading out until there is a solution
    constexpr double DENSITY_PENALTY = 0.5;    ///< cost of an open node per expansion in its region
    constexpr std::uint32_t MAX_DENSITY = 20;  ///< largest number of expansions that count
    constexpr double DENSITY_CELL = 2.0;       ///< side of a place: larger spreads the search farther
    constexpr double MIN_DEFERRAL = 4.0;       ///< growth of the penalty from which a node waits again

    // Detours when the search is stuck
    constexpr std::uint64_t MIN_EXPANSIONS = 60;      ///< before a search counts as stuck
    constexpr std::uint64_t STALL_EXPANSIONS = 20;    ///< of the confined side without progress, likewise
    constexpr std::uint64_t DETOUR_EXPANSIONS = 150;  ///< before the next detour is added

    /** \brief A wider disc, whose route leads where a car can turn. */
    struct DetourDisc
    {
        double wider;       ///< radius beyond that of the inscribed disc, turning radii
        double lanes;       ///< smallest width over that of the lane covered at full lock
        double costFactor;  ///< of a metre where it does not fit, but the inscribed disc does
    };

    /** The first two keep to where a car can turn, the first unless that is far; the last to where it can drive. */
    constexpr DetourDisc DETOURS[]{{0.45, 0.67, 10.0}, {0.3, 1.0, 60.0}, {0.17, 0.43, 600.0}};

    // Proof that there is no path
    constexpr std::uint64_t PROOF_EXPANSIONS = 400;    ///< with detours before the proof begins
    constexpr std::uint64_t PROOF_PACE = 10;           ///< expansions that make it one column of cells a step quicker
    constexpr std::size_t MAX_PROOF_COLUMNS = 500000;  ///< at each end: bounds its memory
    constexpr double PROOF_CELL = 0.5;                 ///< side in radii of the largest disc within the car
    constexpr int PROOF_HEADINGS = 32;                 ///< parts of the circle: more close narrower gaps

    // Searching on after a solution
    constexpr double POST_SEARCH_SHARE = 0.5;        ///< expansions after the first solution to those before,
    constexpr double POST_SEARCH_PER_EXCESS = 60.0;  ///< further expansions per relative or absolute excess of the path
    constexpr double MAX_EXCESS = 8.0;               ///< largest excess that counts
    constexpr double WEIGHT_DECAY = 0.7;             ///< factor on the weights whenever the search goes on
    constexpr double NEAR_OPTIMAL = 1.1;             ///< cost over expected cost up to which a path is not improved
    constexpr double NEAR_OPTIMAL_EXCESS = 1.0;      ///< cost beyond expected cost up to which it is not improved
    constexpr std::uint64_t ROUND_EXPANSIONS = 200;  ///< of a round of anytime

    // Improving a path
    constexpr double KNOT_SPACING = 0.5;   ///< between the knots of a path: smaller finds more, and costs its square
    constexpr double MAX_KNOTS = 20.0;     ///< on long paths
    constexpr double MIN_GAIN = 0.01;      ///< of cost that a curve must save: smaller finds more, and takes longer
    constexpr double COSTLY_RATIO = 1.15;  ///< cost to expected cost from which poses are moved and the car is turned
    constexpr double TURN_REACH = 4.0;     ///< within which, and for which, the car turns round
    constexpr double MOVE_STEP = 0.2;      ///< by which poses are moved first; then by a quarter of it
    constexpr int MAX_MOVES = 2;           ///< passes with each of the two: more find little
    constexpr double IMPROVEMENT_EFFORT = 300.0;  ///< pairs of poses joined by curves to improve a first path
    constexpr double IMPROVEMENT_EFFORT_PER_EXPANSION = 12.0;  ///< further pairs per expansion of the search
    constexpr double MOVE_REACH = 3.0;  ///< of the path that a curve to or from a moved pose replaces
}  // namespace parking::search::tuning
