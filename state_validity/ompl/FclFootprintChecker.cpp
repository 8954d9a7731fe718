#include "state_validity/ompl/FclFootprintChecker.h"

#include "parking_geometry/Error.h"
#include "state_validity/fcl/FclContactTest.h"
#include "state_validity/ompl/OmplPose.h"

#include <utility>

#include <ompl/util/Exception.h>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        /** Converts errors for invalid values into OMPL's exception, which users of OMPL expect. */
        template <class Obstacles>
        std::shared_ptr<const FootprintChecker> build(const Obstacles &makeObstacles, const Vehicle &vehicle,
                                                      double margin)
        {
            try
            {
                return std::make_shared<const FootprintChecker>(makeObstacles(), vehicle, margin, fclContactTest());
            }
            catch (const Error &error)
            {
                throw ompl::Exception(error.what());
            }
        }
    }  // namespace

    FclFootprintChecker::FclFootprintChecker(const ob::SpaceInformationPtr &si,
                                             std::shared_ptr<const FootprintChecker> footprint)
      : ob::StateValidityChecker(si),
        footprint_(std::move(footprint))
    {
        if (!footprint_)
            throw ompl::Exception("footprint checker must not be null");
        requirePlanarSpace(*si->getStateSpace());
        specs_.clearanceComputationType = ob::StateValidityCheckerSpecs::BOUNDED_APPROXIMATE;
        specs_.hasValidDirectionComputation = false;
    }

    FclFootprintChecker::FclFootprintChecker(const ob::SpaceInformationPtr &si, ObstacleSet obstacles,
                                             const Vehicle &vehicle, double margin)
      : FclFootprintChecker(si, build([&] { return std::move(obstacles); }, vehicle, margin))
    {
    }

    FclFootprintChecker::FclFootprintChecker(const ob::SpaceInformationPtr &si, const Scenario &scenario, double margin)
      : FclFootprintChecker(si, build([&] { return ObstacleSet::fromScenario(scenario); }, scenario.vehicle, margin))
    {
    }

    bool FclFootprintChecker::isValid(const ob::State *state) const
    {
        if (!si_->satisfiesBounds(state))
            return false;
        CheckCounts counts;
        const bool free = footprint_->isFree(poseOf(state), counts);
        counters_.add(counts);
        return free;
    }

    double FclFootprintChecker::clearance(const ob::State *state) const
    {
        return si_->satisfiesBounds(state) ? footprint_->clearance(poseOf(state)) : 0.0;
    }

    double FclFootprintChecker::clearance(const ob::State *state, ob::State * /*validState*/,
                                          bool &validStateAvailable) const
    {
        validStateAvailable = false;
        return clearance(state);
    }
}  // namespace parking
