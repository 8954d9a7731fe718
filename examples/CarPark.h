#pragma once

#include <ompl_improved_astar/ImprovedAStar.h>
#include <parking_geometry/Vehicle.h>
#include <state_validity/ompl/FclFootprintChecker.h>
#include <state_validity/ompl/SweptMotionValidator.h>

#include <memory>
#include <vector>

#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>

namespace parking_examples
{
    /** \brief A Reeds-Shepp space of 30 m by 30 m about the origin with the turning radius of \e car. */
    inline std::shared_ptr<ompl::base::ReedsSheppStateSpace> spaceFor(const parking::Vehicle &car)
    {
        auto space = std::make_shared<ompl::base::ReedsSheppStateSpace>(car.minTurningRadius());
        ompl::base::RealVectorBounds bounds(2);
        bounds.setLow(-15.0);
        bounds.setHigh(15.0);
        space->setBounds(bounds);
        return space;
    }

    /** \brief Sets the state validity checker and the motion validator for \e car among \e obstacles. */
    inline void setObstacles(const ompl::base::SpaceInformationPtr &si, const parking::ObstacleSet &obstacles,
                             const parking::Vehicle &car)
    {
        si->setStateValidityChecker(std::make_shared<parking::FclFootprintChecker>(si, obstacles, car));
        si->setMotionValidator(std::make_shared<parking::SweptMotionValidator>(si));
        si->setup();
    }

    /** \brief A state of \e space: x and y in metres, yaw in radians counter-clockwise from +x. */
    inline ompl::base::ScopedState<ompl::base::SE2StateSpace> state(const ompl::base::StateSpacePtr &space, double x,
                                                                    double y, double yaw)
    {
        ompl::base::ScopedState<ompl::base::SE2StateSpace> result(space);
        result->setXY(x, y);
        result->setYaw(yaw);
        return result;
    }
}  // namespace parking_examples
