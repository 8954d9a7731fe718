#include "state_validity/fcl/FclContactTest.h"

#include "state_validity/fcl/FclWorld.h"

#include <memory>
#include <utility>

namespace parking
{
    ContactTestMaker fclContactTest()
    {
        return [](const ObstacleSet &obstacles, double halfLength, double halfWidth) -> ContactTest
        {
            return [world = std::make_shared<const FclWorld>(obstacles, halfLength, halfWidth)](const OrientedBox &body)
            {
                return world->collides(body);
            };
        };
    }

    PlainFclChecker::PlainFclChecker(ObstacleSet obstacles, const Vehicle &vehicle, double margin)
      : obstacles_(std::move(obstacles)),
        centreOffset_(vehicle.centreOffset()),
        halfLength_(0.5 * vehicle.length() + margin),
        halfWidth_(0.5 * vehicle.width + margin)
    {
        vehicle.validate();
        touches_ = fclContactTest()(obstacles_, halfLength_, halfWidth_);
    }

    bool PlainFclChecker::isFree(const Pose &pose) const
    {
        return isFinite(pose) && !touches_(bodyAt(obstacles_.toLocal(pose), centreOffset_, halfLength_, halfWidth_));
    }
}  // namespace parking
