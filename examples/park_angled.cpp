// A Corolla drives forwards into a slot at 60 degrees. The output compares the aisle widths for forward and reverse
// entry.

#include "examples/StreetScene.h"
#include "parking_geometry/Error.h"

#include <cmath>
#include <iostream>

using namespace parking;
using parking_examples::inMetres;

int main(int argc, char **argv)
{
    const std::string file = argc > 1 ? argv[1] : "park_angled.svg";
    try
    {
        // Stalls at 60 degrees on a one-way aisle, as in the code of Portsmouth, Virginia: 9 feet wide, 18 feet of
        // aisle.
        const Vehicle car = vehicleByName("toyota_corolla");
        ParkingSlot slot;
        slot.kind = SlotKind::Angled;
        slot.angle = PI / 3.0;
        slot.pose = {0.0, 0.0, slot.angle};  // +x out of the slot; the aisle runs along the x axis
        slot.length = 5.486;
        slot.width = 2.743;
        slot.side = SlotSide::Right;
        slot.entry = SlotEntry::Forward;
        const double aisle = 5.486;
        const double mouth = std::sin(slot.angle) * 0.5 * slot.length + std::cos(slot.angle) * 0.5 * slot.width;
        // For forward entry the car comes from the right, the side to which the stalls lean.
        const Pose start{10.0, mouth + 0.5 * aisle, PI};

        parking_examples::StreetScene scene(car, slot, start);
        const double pitch = slot.width / std::sin(slot.angle);
        const char *neighbours[] = {"vw_golf8", "bmw_3_g20", "toyota_yaris"};
        for (int k = -3; k <= 3; ++k)
        {
            ParkingSlot other = slot;
            other.pose.x = k * pitch;
            if (k != 0)
                scene.addParkedCar(other, neighbours[(k + 3) % 3]);
        }
        scene.addWall(-14.0, -mouth - 0.4, 14.0, -mouth - 0.1);
        scene.addWall(-14.0, mouth + aisle, 14.0, mouth + aisle + 0.4);

        const PlanningParameters parameters = PlanningParameters::intoTightSlots(aisle);
        const ParkingPlan plan = ParkingPlanner(parameters).plan(scene.problem());
        if (!plan.found)
        {
            std::cerr << plan.message << '\n';
            return 1;
        }
        ParkingSlot reverse = slot;
        reverse.entry = SlotEntry::Reverse;
        std::cout << "minimum aisle: " << inMetres(plan.manoeuvre.neededAisleWidth) << " forwards, "
                  << inMetres(ReverseParking(car, parameters.sweep).plan(reverse).neededAisleWidth) << " in reverse; "
                  << plan.arcs.stretches().size() << " stretches, " << inMetres(plan.smooth.path.length())
                  << " in total\n";
        scene.draw(plan, "Angled parking, nose first", "Toyota Corolla into a stall at 60 degrees", file);
        return plan.smooth.free ? 0 : 1;
    }
    catch (const Error &error)
    {
        std::cerr << "park_angled: " << error.what() << '\n';
        return 2;
    }
}
