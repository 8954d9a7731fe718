// A slot that is 30 cm wider than the car, on an aisle of 4.5 m. A single sweep does not fit, several stretches do.

#include "automatic_parking/SlotQuestions.h"
#include "examples/StreetScene.h"
#include "parking_geometry/Error.h"

#include <iostream>

using namespace parking;
using parking_examples::inMetres;

int main(int argc, char **argv)
{
    const std::string file = argc > 1 ? argv[1] : "park_narrow.svg";
    try
    {
        const Vehicle car = vehicleByName("tesla_model3");
        ParkingSlot slot;
        slot.kind = SlotKind::Perpendicular;
        slot.pose = {0.0, 0.0, 0.5 * PI};
        slot.length = 5.0;
        slot.width = car.width + 0.3;
        slot.side = SlotSide::Right;
        const double aisle = 4.5;
        const Pose start{-8.5, 4.6, 0.0};

        parking_examples::StreetScene scene(car, slot, start);
        scene.addWall(-14.0, -2.8, -0.5 * slot.width, 2.5);  // a garage with walls on both sides
        scene.addWall(0.5 * slot.width, -2.8, 14.0, 2.5);
        scene.addWall(-0.5 * slot.width, -2.8, 0.5 * slot.width, -2.5);
        scene.addWall(-14.0, 2.5 + aisle, 14.0, 2.9 + aisle);

        PlanningParameters parameters = PlanningParameters::intoTightSlots(aisle);
        std::cout << "one sweep: " << ReverseParking(car, parameters.sweep).plan(slot).message << '\n';
        const ParkingPlan plan = ParkingPlanner(parameters).plan(scene.problem());
        if (!plan.found)
        {
            std::cerr << plan.message << '\n';
            return 1;
        }
        parameters.expansionsPerGap = 4000;  // sufficient for the narrowest slot
        const ParkingPlanner quick(parameters);
        std::cout << "several: " << plan.manoeuvre.path.stretches().size() << " stretches at the slot, "
                  << plan.arcs.stretches().size() << " and " << inMetres(plan.smooth.path.length())
                  << " in total; narrowest slot: " << inMetres(smallestSlot(quick, car, slot, 0.05)) << "\n";
        scene.draw(plan, "A narrow slot in several stretches",
                   "Tesla Model 3, 15 cm to the walls on either side, aisle of 4.5 m", file);
        return plan.smooth.free && plan.manoeuvre.path.stretches().size() > 1 ? 0 : 1;
    }
    catch (const Error &error)
    {
        std::cerr << "park_narrow: " << error.what() << '\n';
        return 2;
    }
}
