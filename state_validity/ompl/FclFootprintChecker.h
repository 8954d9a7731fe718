#pragma once

#include "parking_geometry/Scenario.h"
#include "parking_geometry/Vehicle.h"
#include "state_validity/FootprintChecker.h"
#include "state_validity/ObstacleSet.h"
#include "state_validity/ompl/TierCounters.h"

#include <memory>

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

namespace parking
{
    /** \anchor FclFootprintChecker
        \brief OMPL's view of FootprintChecker: is the car's rectangle free of obstacles, in any SE2, Dubins or
        Reeds-Shepp space?

        A state is valid when it lies within the bounds of the state space and the body, enlarged by the safety margin,
        touches no obstacle and stays inside of the world. The answer is that of FCL, reached without asking FCL
        wherever a bound decides; see FootprintChecker for the tiers.

        The clearance is a lower bound of the distance between the enlarged body and the obstacles (specs:
        BOUNDED_APPROXIMATE); 0 for states that are not valid. No valid direction is computed.

        All const members may be called from several threads at once, as OMPL demands. */
    class FclFootprintChecker : public ompl::base::StateValidityChecker
    {
    public:
        /** \brief Uses \e footprint, which may be shared with others.

            Throws ompl::Exception when \e footprint is empty or when the space of \e si is no SE2 space (nor derived
            from one). */
        FclFootprintChecker(const ompl::base::SpaceInformationPtr &si,
                            std::shared_ptr<const FootprintChecker> footprint);

        /** \brief Builds its own FootprintChecker. \param margin metres round the body, not negative

            Throws ompl::Exception naming the value that is wrong. */
        FclFootprintChecker(const ompl::base::SpaceInformationPtr &si, ObstacleSet obstacles, const Vehicle &vehicle,
                            double margin = 0.0);

        /** \brief The same for the obstacles and the car of a scenario; states are in its local coordinates. */
        FclFootprintChecker(const ompl::base::SpaceInformationPtr &si, const Scenario &scenario, double margin = 0.0);

        using ompl::base::StateValidityChecker::isValid;

        /** \brief Does the state lie within the bounds of the space, with the enlarged body free? */
        bool isValid(const ompl::base::State *state) const override;

        /** \brief A lower bound of the distance between the enlarged body and the obstacles in metres, as of
            FootprintChecker::clearance(); 0 out of the bounds of the space. */
        double clearance(const ompl::base::State *state) const override;

        /** \brief The same; \e validStateAvailable becomes false and \e validState stays as it is. */
        double clearance(const ompl::base::State *state, ompl::base::State *validState,
                         bool &validStateAvailable) const override;

        /** \brief What decides; it lives as long as this object. */
        const FootprintChecker &footprint() const
        {
            return *footprint_;
        }

        /** \brief The footprint checker, to share it with a motion validator. */
        const std::shared_ptr<const FootprintChecker> &sharedFootprint() const
        {
            return footprint_;
        }

        /** \brief Which tier decided how many of the states asked about since construction or resetCounts(). States
            outside of the space's bounds are not among them. */
        CheckCounts counts() const
        {
            return counters_.sum();
        }

        /** \brief Starts counts() from zero. */
        void resetCounts()
        {
            counters_.reset();
        }

    private:
        std::shared_ptr<const FootprintChecker> footprint_;
        mutable TierCounters counters_;
    };
}  // namespace parking
