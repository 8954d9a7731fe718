#include "parking_geometry/manoeuvres/MultiStretchParking.h"

#include "parking_geometry/Error.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Tolerance of the ends of a planner's path, metres and radians. */
        constexpr double SAME_POSE = 1e-6;

        /** Exits beyond the slot's mouth, metres along the aisle. */
        constexpr double ALONG_AISLE[] = {0.0, 1.0, 2.0, 4.0, -1.0, -2.0};

        /** Gap in metres between the body and the slots' mouths at an exit into an aisle of unknown width. */
        constexpr double BESIDE_SLOTS = 0.5;
    }  // namespace

    SlotExitTask slotExitTask(const ReverseParking &parking, const ParkingSlot &slot, SlotEntry entry, SlotSide side)
    {
        const Vehicle &vehicle = parking.vehicle();
        const double aisle = parking.options().aisleWidth, half = 0.5 * vehicle.width;
        SlotExitTask task;
        task.entry = entry;
        task.side = side;
        ParkingSlot entered = slot;
        entered.entry = entry;
        task.parked = entered.goals(vehicle).front();

        // Computed in the frame of a slot on the right, then mirrored.
        const double mirror = side == SlotSide::Left ? -1.0 : 1.0;
        const bool parallel = slot.kind == SlotKind::Parallel;
        const double angle = slot.aisleAngle();
        const bool backwards = entry == SlotEntry::Forward;
        const double height = std::isfinite(aisle) ? 0.5 * aisle : half + BESIDE_SLOTS;
        const Pose mouth = parallel ? Pose{(backwards ? -0.5 : 0.5) * slot.length, 0.5 * slot.width, 0.0}
                                    : Pose{0.5 * slot.length + slot.width * std::cos(angle) / std::sin(angle),
                                           -0.5 * slot.width, -angle};
        // A car that leaves in reverse then drives along the aisle in reverse. It leaves a parallel slot towards its
        // rear.
        const double yaw = backwards && !parallel ? PI : 0.0, along = backwards && parallel ? -1.0 : 1.0;
        const Eigen::Vector2d parked(task.parked.x, task.parked.y);
        task.bounds = {parked, parked};
        const auto include = [&](const Pose &pose)
        {
            for (const Eigen::Vector2d &corner : vehicle.footprint(pose))
                task.bounds.include(corner);
        };
        include(task.parked);
        for (const double distance : ALONG_AISLE)
        {
            Pose local = compose(mouth, {along * distance, height, yaw});
            local.y *= mirror;
            local.yaw *= mirror;
            task.exits.push_back(compose(slot.pose, local));
            include(task.exits.back());
        }
        // A margin of the car's length on every side for swings and changes of direction.
        task.bounds.min.array() -= vehicle.length();
        task.bounds.max.array() += vehicle.length();
        return task;
    }

    ReverseParkingResult planInStretches(const ReverseParking &parking, const ParkingSlot &slot,
                                         const FootprintQueries &world, const SlotExitPlanner &planner)
    {
        ReverseParkingResult best = parking.plan(slot, world);
        if (best.fits())
            return best;
        for (const ReverseParkingResult &refused : parking.planAll(slot, world))
        {
            const SlotExitTask task = slotExitTask(parking, slot, refused.entry, refused.side);
            const Path out = planner(task);
            if (out.pieces.empty())
                continue;
            const Pose end = out.end();
            if (!isSamePose(out.start, task.parked, SAME_POSE))
                throw Error("multi-stretch parking: the planner's path does not begin at the parked pose");
            if (std::none_of(task.exits.begin(), task.exits.end(),
                             [&](const Pose &exit) { return isSamePose(exit, end, SAME_POSE); }))
                throw Error("multi-stretch parking: the planner's path does not end at one of the exits");
            if (!isPathFree(world, parking.vehicle(), out))
                throw Error("multi-stretch parking: the planner's path is not free");
            const bool fewer = out.cusps() < best.path.cusps();
            const bool shorter = out.cusps() == best.path.cusps() && out.length() < best.path.length();
            if (best.fits() && !fewer && !shorter)
                continue;
            best = refused;
            best.status = ReverseParkingStatus::Fits;
            best.message.clear();
            best.path = out.reversed();
        }
        return best;
    }
}  // namespace parking
