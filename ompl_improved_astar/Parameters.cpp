#include "ompl_improved_astar/Parameters.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"

#include <tuple>

namespace parking
{
    namespace
    {
        /** The paper's best set: every improvement but the neighbourhood expansion (section "Discussion"). */
        PlannerParameters improvedGrid()
        {
            PlannerParameters set;
            set.motionModel = MotionModel::Grid8;
            set.weights = {1.5, 0.9, 5.0, 1e-3};
            return set;
        }

        PlannerParameters basicGrid()
        {
            PlannerParameters set;
            set.motionModel = MotionModel::Grid8;
            set.weights = {1.0, 1.0, 0.0, 0.0};
            set.openList = search::OpenListKind::Linear;
            set.bidirectional = false;
            set.searchFromGoal = false;
            set.eagerObstacles = true;
            set.bsplineSmoothing = false;
            set.approximate = false;
            return set;
        }

        auto members(const PlannerParameters &p)
        {
            return std::tie(p.motionModel, p.turningRadius, p.xyResolution, p.headingBins, p.steeringAngles,
                            p.weights.far, p.weights.near, p.weights.nearDistance, p.weights.tieBreak, p.openList,
                            p.bidirectional, p.searchFromGoal, p.adaptiveResolution, p.obstacleHeuristic,
                            p.eagerObstacles, p.bsplineSmoothing, p.shortening, p.approximate, p.reversePenalty,
                            p.gearChangePenalty, p.steeringChangePenalty, p.clearanceWeight, p.analyticExpansion,
                            p.anytime);
        }
    }  // namespace

    bool operator==(const PlannerParameters &a, const PlannerParameters &b)
    {
        return members(a) == members(b);
    }

    std::vector<std::string> parameterSetNames()
    {
        return {"default",      "basic_astar",  "experiment_1", "experiment_2",   "experiment_3",
                "experiment_4", "experiment_5", "experiment_6", "improved_astar", "hybrid_astar"};
    }

    PlannerParameters parameterSet(const std::string &name, const PlannerParameters &current)
    {
        PlannerParameters set;
        if (name == "default")
        {
        }
        else if (name == "basic_astar")
            set = basicGrid();
        else if (name == "improved_astar")
            set = improvedGrid();
        else if (name == "experiment_1")  // without the weighted heuristic
        {
            set = improvedGrid();
            set.weights = {1.0, 1.0, 0.0, 0.0};
        }
        else if (name == "experiment_2")  // without dynamic obstacle loading
        {
            set = improvedGrid();
            set.eagerObstacles = true;
        }
        else if (name == "experiment_3")  // without bidirectional search and binary heap
        {
            set = improvedGrid();
            set.bidirectional = false;
            set.searchFromGoal = false;
            set.openList = search::OpenListKind::Linear;
        }
        else if (name == "experiment_4")  // with neighbourhood expansion
        {
            set = improvedGrid();
            set.motionModel = MotionModel::Grid16;
        }
        else if (name == "experiment_5")  // without smoothing
        {
            set = improvedGrid();
            set.bsplineSmoothing = false;
        }
        else if (name == "experiment_6")  // without smoothing, bidirectional search and binary heap
        {
            set = improvedGrid();
            set.bsplineSmoothing = false;
            set.bidirectional = false;
            set.searchFromGoal = false;
            set.openList = search::OpenListKind::Linear;
        }
        else if (name == "hybrid_astar")  // the car model without what this project adds to it
        {
            set.bidirectional = false;
            set.searchFromGoal = false;
            set.adaptiveResolution = false;
            set.shortening = false;
        }
        else
            throw Error(unknownName("parameter set", name, parameterSetNames()));
        set.turningRadius = current.turningRadius;
        set.xyResolution = current.xyResolution;
        set.headingBins = current.headingBins;
        return set;
    }
}  // namespace parking
