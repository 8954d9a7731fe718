// Planning and driving: a car plans a path into a free slot between two others. A model predictive controller then
// drives it there, in a simulation with steering lag, a noisy pose and an odometry error.
//
// usage: drive_into_slot [SCENARIO.yaml]   writes drive_into_slot.svg and drive_into_slot.html
#include "automatic_parking/AutomaticParking.h"
#include "automatic_parking/drawing/DriveAnimation.h"
#include "automatic_parking/drawing/DriveFigure.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/manoeuvres/SlotSurroundings.h"

#include <cstdio>
#include <exception>
#include <iostream>
#include <string>

namespace
{
    /** A row of slots along an aisle of 6 m; the middle one is free. */
    parking::Scenario rowOfSlots()
    {
        parking::Scenario scenario;
        scenario.name = "row of slots";
        scenario.vehicle = parking::vehicleByName("vw_golf8");
        parking::ParkingSlot slot;
        slot.pose = {0.0, -2.5, 0.5 * parking::PI};  // the slot's mouth lies on y = 0 and the aisle at y > 0
        slot.length = 5.0;
        slot.width = 2.6;
        slot.side = parking::SlotSide::Right;
        scenario.slot = slot;
        scenario.goals = slot.goals(scenario.vehicle);
        scenario.start = {-9.0, 2.2, 0.0};
        scenario.polygons = parking::slotSurroundings(slot, slot.side, 6.0);
        scenario.bounds = {{-14.0, -6.0}, {14.0, 7.0}};
        return scenario;
    }
}  // namespace

int main(int argc, char **argv)
try
{
    const parking::Scenario scenario = argc > 1 ? parking::readScenario(argv[1]) : rowOfSlots();

    parking::ParkingParameters parameters;
    parameters.drive.disturbances = parking::Disturbances::everyday(1);
    const parking::ParkingResult result = parking::AutomaticParking(parameters).park(scenario);

    for (const std::string &event : result.events)
        std::cout << event << '\n';
    const parking::Evaluation &figures = result.evaluation;
    char text[200];
    std::snprintf(
        text, sizeof text,
        "%.1f m in %.1f s; mean acceleration %.2f m/s\xC2\xB2, mean steering angle %.1f degrees; ends %.1f cm and "
        "%.2f degrees from the goal",
        figures.drivenLength, figures.travelTime, figures.meanAbsAcceleration,
        figures.meanAbsSteering * 180.0 / parking::PI, 100.0 * figures.finalPositionError,
        figures.finalYawError * 180.0 / parking::PI);
    std::cout << text << std::endl;
    if (!result.parked())
        return 1;

    const std::string title = "Driving into a slot: " + scenario.name;
    const parking::Path &planned = result.legs.back().plan.path;
    parking::driveFigure(scenario, planned, result.trajectory, title, text).write("drive_into_slot.svg");
    parking::writeDriveAnimation("drive_into_slot.html", scenario, planned, result.trajectory, title, {text, {}, {}});
    return 0;
}
catch (const std::exception &error)
{
    std::cerr << "drive_into_slot: " << error.what() << std::endl;
    return 2;
}
