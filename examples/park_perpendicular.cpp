// A Golf reverses into a perpendicular slot between two cars. The program describes the slot and computes the
// manoeuvre.

#include "examples/StreetScene.h"
#include "parking_geometry/Error.h"

#include <iostream>

using namespace parking;
using parking_examples::inMetres;

int main(int argc, char **argv)
{
    const std::string file = argc > 1 ? argv[1] : "park_perpendicular.svg";
    try
    {
        // A slot as in the German guideline EAR 05, with an aisle of 6 m above it. The car comes from the left.
        const Vehicle car = vehicleByName("vw_golf8");
        ParkingSlot slot;
        slot.kind = SlotKind::Perpendicular;
        slot.pose = {0.0, 0.0, 0.5 * PI};  // the middle of the slot, +x out of it
        slot.length = 5.0;
        slot.width = 2.5;
        slot.side = SlotSide::Right;
        const Pose start{-9.0, 5.0, 0.0};

        parking_examples::StreetScene scene(car, slot, start);
        const char *neighbours[] = {"bmw_3_g20", "toyota_yaris", "tesla_model3", "toyota_corolla", "vw_vanagon"};
        for (int k = -4; k <= 4; ++k)
        {
            ParkingSlot here = slot, across = slot;
            here.pose.x = across.pose.x = k * slot.width;
            across.pose.y = slot.length + 6.0;
            across.pose.yaw = -0.5 * PI;
            if (k != 0)
                scene.addParkedCar(here, neighbours[(k + 5) % 5]);
            scene.addParkedCar(across, neighbours[(2 * k + 9) % 5]);
        }
        scene.addWall(-12.0, -2.8, 12.0, -2.5);

        const PlanningParameters parameters = PlanningParameters::intoTightSlots(6.0);
        const ParkingPlan plan = ParkingPlanner(parameters).plan(scene.problem());
        if (!plan.found)
        {
            std::cerr << plan.message << '\n';
            return 1;
        }
        std::cout << "one sweep at a radius of " << inMetres(plan.manoeuvre.firstRadius) << ", "
                  << inMetres(plan.manoeuvre.neededAisleWidth) << " of aisle required; " << plan.arcs.stretches().size()
                  << " stretches, " << inMetres(plan.smooth.path.length()) << " in total\n";
        scene.draw(plan, "Perpendicular parking in reverse",
                   "VW Golf 8 into a slot of 2.5 m x 5 m from an aisle of 6 m", file);
        return plan.smooth.free && plan.smooth.stops.empty() ? 0 : 1;
    }
    catch (const Error &error)
    {
        std::cerr << "park_perpendicular: " << error.what() << '\n';
        return 2;
    }
}
