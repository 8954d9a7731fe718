// The heuristics: a line each.

#include "ompl_improved_astar/search/Heuristic.h"
#include "ompl_improved_astar/search/heuristics/CurveHeuristic.h"
#include "ompl_improved_astar/search/heuristics/ManhattanHeuristic.h"
#include "ompl_improved_astar/search/heuristics/OctileHeuristic.h"
#include "ompl_improved_astar/search/heuristics/StraightHeuristic.h"

namespace parking::search
{
    Registry<Heuristic> &heuristics()
    {
        static Registry<Heuristic> registry("heuristic", {
                                                             {"curves", newPart<CurveHeuristic>},
                                                             {"straight", newPart<StraightHeuristic>},
                                                             {"octile", newPart<OctileHeuristic>},
                                                             {"manhattan", newPart<ManhattanHeuristic>},
                                                         });
        return registry;
    }
}  // namespace parking::search
