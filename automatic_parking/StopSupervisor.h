#pragma once

#include "automatic_parking/ParkingWorld.h"
#include "parking_geometry/curves/Path.h"

#include <memory>

namespace parking
{
    /** \brief Knows whether a car can still stop before what stands in its world.

        Asked with the way that the car would need to come to rest, before every command. As long as it has allowed
        every command, the car can stop without touching anything: with the brake in reserve, after the delay that
        commands were seen to have, with wheels that follow as they were seen to, or do not. Obstacles that were not
        there before are another matter: then the best is to stop at once, which is what is done. */
    class StopSupervisor
    {
    public:
        /** \param gap metres that the body should keep on the way to a stop */
        StopSupervisor(const ParkingWorld &world, double gap);

        /** \brief May the car do what needs \e stoppingWay, from where it is now to its rest?

            Where it is nearer than the gap already, which errors of measurement and control may cause, the gap does not
            count; where it is believed to touch something, nothing is forbidden: it must be able to leave. */
        bool allows(const Path &stoppingWay) const;

    private:
        ParkingWorld world_;
        std::shared_ptr<const FootprintChecker> enlarged_;
    };
}  // namespace parking
