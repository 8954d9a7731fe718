#pragma once

#include "parking_geometry/Scenario.h"
#include "parking_geometry/manoeuvres/SlotSurroundings.h"

#include <algorithm>
#include <string>
#include <vector>

namespace parking_test
{
    /** A free slot in a row of parked cars, its mouth on y = 0 and the aisle, \e aisle metres wide, beyond. */
    inline parking::Scenario rowOfSlots(double aisle = 6.0, double width = 2.6)
    {
        parking::Scenario scenario;
        scenario.name = "row of slots";
        scenario.vehicle = parking::vehicleByName("vw_golf8");
        parking::ParkingSlot slot;
        slot.pose = {0.0, -2.5, 0.5 * parking::PI};
        slot.length = 5.0;
        slot.width = width;
        slot.side = parking::SlotSide::Right;
        scenario.slot = slot;
        scenario.goals = slot.goals(scenario.vehicle);
        scenario.start = {-9.0, 0.4 * aisle, 0.0};
        scenario.polygons = parking::slotSurroundings(slot, slot.side, aisle);
        scenario.bounds = {{-20.0, -6.0}, {20.0, aisle + 1.0}};
        return scenario;
    }

    /** Open ground, the goal \e distance metres straight ahead. */
    inline parking::Scenario openGround(double distance = 15.0)
    {
        parking::Scenario scenario;
        scenario.name = "open ground";
        scenario.start = {0.0, 0.0, 0.0};
        scenario.goals = {{distance, 0.0, 0.0}};
        scenario.bounds = {{-15.0, -15.0}, {distance + 15.0, 15.0}};
        return scenario;
    }

    /** An upright box. */
    inline parking::Polygon box(double minX, double minY, double maxX, double maxY)
    {
        return {{minX, minY}, {maxX, minY}, {maxX, maxY}, {minX, maxY}};
    }

    inline std::string bundledFile(const std::string &name)
    {
        return std::string(PARKING_SOURCE_DIR) + "/benchmarks/scenarios/" + name + ".yaml";
    }
}  // namespace parking_test
