#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace parking::search
{
    /** \brief What whole paths cost, by one model. How near they come to obstacles takes long to find out, so that it
       is remembered of the paths that were asked about last. */
    class PathPrices
    {
    public:
        /** \brief Forgets all paths. \param environment must outlive it */
        void begin(MotionEnvironment &environment, const CostModel &model);

        /** \brief What paths are priced by. */
        const CostModel &model() const
        {
            return model_;
        }

        /** \brief What the path costs for being near to obstacles; none when it is not known and \e stop, or the
            environment, says that it is time to stop. */
        std::optional<double> closeness(const Path &path, const StopFunction &stop);

        /** \brief What it costs; none likewise. */
        std::optional<double> cost(const Path &path, const StopFunction &stop);

        /** \brief Takes over what somebody else has found out by the same model. */
        void remember(const PricedPath &priced);

    private:
        static constexpr std::size_t REMEMBERED = 4;  // the best one and those that it is compared with

        struct Priced
        {
            Path path;
            double closeness;
        };

        void remember(Priced priced);

        MotionEnvironment *environment_{nullptr};
        CostModel model_;
        std::vector<Priced> priced_;  // what was asked about last comes first
    };
}  // namespace parking::search
