// The heuristics: a line each.

#include "ompl_improved_astar/search/Heuristic.h"
#include "ompl_improved_astar/search/heuristics/CurveHeuristic.h"
#include "ompl_improved_astar/search/heuristics/OctileHeuristic.h"
#include "ompl_improved_astar/search/heuristics/StraightHeuristic.h"

namespace parking::search
{
    Registry<Heuristic> &heuristics()
    {
        static Registry<Heuristic> registry("heuristic",
                                            {{"curves", [] { return std::make_unique<CurveHeuristic>(); }},
                                             {"straight", [] { return std::make_unique<StraightHeuristic>(); }},
                                             {"octile", [] { return std::make_unique<OctileHeuristic>(); }}});
        return registry;
    }
}  // namespace parking::search
