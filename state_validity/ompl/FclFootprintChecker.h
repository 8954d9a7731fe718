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
        \brief State validity checker for the car's body in any SE2, Dubins or Reeds-Shepp space; OMPL's interface
        to FootprintChecker.

        A valid state lies within the bounds of the state space. Its body, enlarged by the safety margin, touches no
        obstacle and lies inside of the world. The result is that of FCL, but the class calls FCL only if no bound
        decides; see FootprintChecker for the tiers.

        The clearance is a lower bound of the distance between the enlarged body and the obstacles (specs:
        BOUNDED_APPROXIMATE). It is 0 for invalid states. The class does not compute nearby valid states.

        Const calls from several threads are safe, as OMPL requires. */
    class FclFootprintChecker : public ompl::base::StateValidityChecker
    {
    public:
        /** \brief Uses \e footprint, which may be shared with other objects.

            Throws ompl::Exception if \e footprint is empty or the space of \e si is neither an SE2 space nor derived
            from one. */
        FclFootprintChecker(const ompl::base::SpaceInformationPtr &si,
                            std::shared_ptr<const FootprintChecker> footprint);

        /** \brief Creates a FootprintChecker.

            \param margin metres by which the body is enlarged on each side, not negative
            Throws ompl::Exception naming the invalid value. */
        FclFootprintChecker(const ompl::base::SpaceInformationPtr &si, ObstacleSet obstacles, const Vehicle &vehicle,
                            double margin = 0.0);

        /** \brief Creates a FootprintChecker for the obstacles and the car of a scenario. States are in its local
            coordinates.

            \param margin metres by which the body is enlarged on each side, not negative
            Throws ompl::Exception naming the invalid value. */
        FclFootprintChecker(const ompl::base::SpaceInformationPtr &si, const Scenario &scenario, double margin = 0.0);

        using ompl::base::StateValidityChecker::isValid;

        /** \brief Whether the state lies within the bounds of the space and the enlarged body touches no obstacle. */
        bool isValid(const ompl::base::State *state) const override;

        /** \brief Lower bound of the distance between the enlarged body and the obstacles in metres, from
            FootprintChecker::clearance(); 0 outside of the bounds of the space. */
        double clearance(const ompl::base::State *state) const override;

        /** \brief Lower bound of the distance in metres like clearance(state). Sets \e validStateAvailable to false and
            does not change \e validState. */
        double clearance(const ompl::base::State *state, ompl::base::State *validState,
                         bool &validStateAvailable) const override;

        /** \brief The footprint checker, valid as long as this object. */
        const FootprintChecker &footprint() const
        {
            return *footprint_;
        }

        /** \brief The footprint checker for sharing with a motion validator. */
        const std::shared_ptr<const FootprintChecker> &sharedFootprint() const
        {
            return footprint_;
        }

        /** \brief Number of states that each tier has decided since construction or resetCounts(), without those
            outside of the space's bounds. */
        CheckCounts counts() const
        {
            return counters_.sum();
        }

        /** \brief Resets counts() to zero. */
        void resetCounts()
        {
            counters_.reset();
        }

    private:
        std::shared_ptr<const FootprintChecker> footprint_;
        mutable TierCounters counters_;
    };
}  // namespace parking
