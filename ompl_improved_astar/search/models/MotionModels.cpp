// The motion models: a line each.

#include "ompl_improved_astar/search/MotionModel.h"
#include "ompl_improved_astar/search/models/CarModel.h"
#include "ompl_improved_astar/search/models/Grid16.h"
#include "ompl_improved_astar/search/models/Grid32.h"
#include "ompl_improved_astar/search/models/Grid8.h"

namespace parking::search
{
    namespace
    {
        template <std::vector<GridStep> (*steps)()>
        std::unique_ptr<MotionModel> newGrid()
        {
            return std::make_unique<GridModel>(steps());
        }
    }  // namespace

    Registry<MotionModel> &motionModels()
    {
        static Registry<MotionModel> registry("motion_model", {
                                                                  {"car", newPart<CarModel>},
                                                                  {"grid8", newGrid<grid8Steps>},
                                                                  {"grid16", newGrid<grid16Steps>},
                                                                  {"grid32", newGrid<grid32Steps>},
                                                              });
        return registry;
    }

    bool turnsOnTheSpot(const std::string &motionModel)
    {
        return motionModels().make(motionModel)->traits().turnsOnTheSpot;
    }
}  // namespace parking::search
