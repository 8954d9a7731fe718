#include "automatic_parking/StopSupervisor.h"

#include "state_validity/sweeps/PathSweep.h"

namespace parking
{
    StopSupervisor::StopSupervisor(const ParkingWorld &world, double gap)
      : world_(world),
        enlarged_(world.enlarged(gap))
    {
    }

    bool StopSupervisor::allows(const Path &stoppingWay) const
    {
        if (enlarged_ && enlarged_->isFree(stoppingWay.start))
            return isPathFree(*enlarged_, stoppingWay);
        return !world_.footprint().isFree(stoppingWay.start) || world_.isFree(stoppingWay);
    }
}  // namespace parking
