// The motion models: a line each.

#include "ompl_improved_astar/search/MotionModel.h"
#include "ompl_improved_astar/search/models/CarModel.h"
#include "ompl_improved_astar/search/models/Grid16.h"
#include "ompl_improved_astar/search/models/Grid32.h"
#include "ompl_improved_astar/search/models/Grid8.h"

namespace parking::search
{
    Registry<MotionModel> &motionModels()
    {
        static Registry<MotionModel> registry("motion_model", {{"car",
                                                                []
                                                                {
                                                                    return std::make_unique<CarModel>();
                                                                }},
                                                               {"grid8",
                                                                []
                                                                {
                                                                    return std::make_unique<GridModel>(grid8Steps());
                                                                }},
                                                               {"grid16",
                                                                []
                                                                {
                                                                    return std::make_unique<GridModel>(grid16Steps());
                                                                }},
                                                               {"grid32", []
                                                                {
                                                                    return std::make_unique<GridModel>(grid32Steps());
                                                                }}});
        return registry;
    }

    bool turnsOnTheSpot(const std::string &motionModel)
    {
        return motionModels().make(motionModel)->traits().turnsOnTheSpot;
    }
}  // namespace parking::search
