#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/SearchParameters.h"

#include <string>
#include <vector>

namespace parking
{
    /** \brief How the planner moves. */
    enum class MotionModel
    {
        Car,    ///< arcs and straight lines, forwards and in reverse
        Grid8,  ///< the paper's eight neighbours on a grid of positions
        Grid16  ///< sixteen neighbours
    };

    /** \brief All parameters of ompl::geometric::ImprovedAStar; the setters there tell what each means. */
    struct PlannerParameters
    {
        MotionModel motionModel{MotionModel::Car};
        double turningRadius{3.0};
        double xyResolution{0.0};
        unsigned int headingBins{72};
        unsigned int steeringAngles{3};
        search::HeuristicWeights weights;
        search::OpenListKind openList{search::OpenListKind::BinaryHeap};
        bool bidirectional{true};
        bool searchFromGoal{true};
        bool adaptiveResolution{true};
        bool obstacleHeuristic{true};
        bool eagerObstacles{false};
        bool bsplineSmoothing{true};
        bool shortening{true};
        bool approximate{true};
        double reversePenalty{0.0};
        double gearChangePenalty{0.5};
        double steeringChangePenalty{0.1};
        double clearanceWeight{0.0};
        bool analyticExpansion{true};
        bool anytime{false};
    };

    bool operator==(const PlannerParameters &a, const PlannerParameters &b);
    inline bool operator!=(const PlannerParameters &a, const PlannerParameters &b)
    {
        return !(a == b);
    }

    /** \brief Names of the parameter sets: `default`, the paper's `basic_astar`, `experiment_1` to `experiment_6` and
        `improved_astar` (its ablation, on the grid model), and `hybrid_astar` (the car model with the improvements
       off). */
    std::vector<std::string> parameterSetNames();

    /** \brief The parameters of a named set; turning radius and resolution are kept from \e current.

        Throws parking::Error listing the known names otherwise. */
    PlannerParameters parameterSet(const std::string &name, const PlannerParameters &current);
}  // namespace parking
