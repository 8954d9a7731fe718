// A Tesla reverses into a parallel slot in one sweep of two arcs, which is legal because R_min <= R_max. If
// necessary, the program lengthens the slot.

#include "examples/StreetScene.h"
#include "parking_geometry/Error.h"

#include <iostream>

using namespace parking;
using parking_examples::inMetres;

int main(int argc, char **argv)
{
    const std::string file = argc > 1 ? argv[1] : "park_parallel.svg";
    try
    {
        const Vehicle car = vehicleByName("tesla_model3");
        ParkingSlot slot;
        slot.kind = SlotKind::Parallel;
        slot.length = 6.5;  // as in the German guideline EAR 05
        slot.width = 2.3;
        slot.depth = 0.4;  // metres behind the parked car; the remaining length is in front of it
        slot.side = SlotSide::Right;
        const Pose start{-9.0, 3.2, 0.0};

        const PlanningParameters parameters = PlanningParameters::intoTightSlots(4.0);
        const ReverseParking oneSweep(car, parameters.sweep);
        const ReverseParkingResult verdict = oneSweep.plan(slot);
        std::cout << (verdict.fits() ? "fits" : verdict.message) << '\n';
        if (!verdict.fits())
        {
            // The rear end of the slot keeps its position.
            slot.pose.x += 0.5 * (verdict.neededSlotLength + 0.1 - slot.length);
            slot.length = verdict.neededSlotLength + 0.1;
        }

        parking_examples::StreetScene scene(car, slot, start);
        ParkingSlot other = slot;
        other.length = 5.4;
        other.depth.reset();
        other.pose.x = slot.pose.x - 0.5 * (slot.length + other.length);
        scene.addParkedCar(other, "bmw_3_g20");
        other.pose.x -= other.length;
        scene.addParkedCar(other, "toyota_yaris");
        other.pose.x = slot.pose.x + 0.5 * (slot.length + other.length);
        scene.addParkedCar(other, "vw_vanagon");
        scene.addWall(-18.0, -1.6, 18.0, -0.5 * slot.width);                         // kerb
        scene.addWall(-18.0, 0.5 * slot.width + 4.0, 18.0, 0.5 * slot.width + 4.4);  // the other side of the lane

        const ParkingPlan plan = ParkingPlanner(parameters).plan(scene.problem());
        if (!plan.found)
        {
            std::cerr << plan.message << '\n';
            return 1;
        }
        std::cout << "a slot of " << inMetres(slot.length) << ": R_min " << inMetres(plan.manoeuvre.minRadius)
                  << ", R_max " << inMetres(plan.manoeuvre.maxRadius) << "; " << plan.arcs.stretches().size()
                  << " stretches, " << inMetres(plan.smooth.path.length()) << " in total\n";
        scene.draw(plan, "Parallel parking in reverse", "Tesla Model 3 in one sweep: two arcs, joined by clothoids",
                   file);
        return plan.smooth.free && plan.manoeuvre.path.stretches().size() == 1 ? 0 : 1;
    }
    catch (const Error &error)
    {
        std::cerr << "park_parallel: " << error.what() << '\n';
        return 2;
    }
}
