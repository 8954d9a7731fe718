// The motion models: a line each, and the steps of the grids.

#include "ompl_improved_astar/search/MotionModel.h"
#include "ompl_improved_astar/search/models/CarModel.h"
#include "ompl_improved_astar/search/models/GridModel.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace parking::search
{
    namespace
    {
        /** The eight neighbours; with 16 the knight's moves between them, too (paper, "Neighborhood Expansion"); with
           32 also a step of three cells between each two of these, so that headings are 7 to 11 degrees apart. */
        template <std::size_t count>
        std::unique_ptr<MotionModel> newGrid()
        {
            std::vector<GridStep> steps;
            for (const auto &[columns, rows] : {GridStep{1, 0}, {1, 1}, {2, 1}, {1, 2}, {3, 1}, {3, 2}, {2, 3}, {1, 3}})
            {
                const int longest = std::max(columns, rows);
                if (longest > (count == 8 ? 1 : count == 16 ? 2 : 3))
                    continue;
                // The step, turned by quarters of the circle.
                for (const GridStep &step :
                     {GridStep{columns, rows}, {-rows, columns}, {-columns, -rows}, {rows, -columns}})
                    steps.push_back(step);
            }
            return std::make_unique<GridModel>(steps);
        }
    }  // namespace

    Registry<MotionModel> &motionModels()
    {
        static Registry<MotionModel> registry("motion_model", {
                                                                  {"car", newPart<CarModel>},
                                                                  {"grid8", newGrid<8>},
                                                                  {"grid16", newGrid<16>},
                                                                  {"grid32", newGrid<32>},
                                                              });
        return registry;
    }

    bool turnsOnTheSpot(const std::string &motionModel)
    {
        return motionModels().make(motionModel)->traits().turnsOnTheSpot;
    }
}  // namespace parking::search
