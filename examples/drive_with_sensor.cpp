// Driving by what a sensor sees: the car knows nothing of a lot but what its sensor has seen, and a box falls in front
// of it. It continues in motion on another trajectory. A page shows what it sees and plans on the way.
#include "automatic_parking/AutomaticParking.h"
#include "automatic_parking/drawing/DriveAnimation.h"
#include "automatic_parking/perception/SimulatedSensor.h"

#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>

int main()
try
{
    parking::Scenario truth;
    truth.name = "lot with a box";
    truth.vehicle = parking::vehicleByName("vw_golf8");
    truth.start = {0.0, 0.0, 0.0};
    truth.goals = {{30.0, 4.0, 0.0}};
    truth.bounds = {{-8.0, -12.0}, {40.0, 16.0}};
    truth.polygons = {{{14.0, -12.0}, {15.0, -12.0}, {15.0, -3.0}, {14.0, -3.0}}};
    const parking::TimedObstacle box{{{20.0, 0.0}, {21.0, 0.0}, {21.0, 3.5}, {20.0, 3.5}}, 4.0};

    parking::SensorParameters sensor;
    sensor.range = 15.0;
    parking::AutomaticParking parking;
    parking.setPerception(
        std::make_shared<parking::SimulatedSensor>(truth, sensor, std::vector<parking::TimedObstacle>{box}));
    const parking::ParkingResult result = parking.park(truth);

    for (const std::string &event : result.events)
        std::cout << event << '\n';
    std::printf("%.1f m in %.1f s, %zu changes of what is seen\n", result.evaluation.drivenLength,
                result.evaluation.travelTime, result.reactions.size());
    parking::writeDriveAnimation("drive_with_sensor.html", truth, {}, result.trajectory, truth.name,
                                 {"what the car sees and plans on the way", {}, result.history});
    return result.parked() ? 0 : 1;
}
catch (const std::exception &error)
{
    std::cerr << error.what() << std::endl;
    return 1;
}
