#pragma once

#include "automatic_parking/AutomaticParking.h"
#include "automatic_parking/perception/SimulatedSensor.h"
#include "parking_geometry/Scenario.h"

#include <string>

namespace parking
{
    /** \brief The sensor of `RANGE` or `RANGE,RATE`: metres and frames per second.

        Throws parking::Error naming the option or key \e name for anything else. */
    SensorParameters sensorOf(const std::string &name, const std::string &text);

    /** \brief A drive of the whole pipeline in which the car knows only what a simulated sensor has seen.

        Throws what AutomaticParking::park() throws.
        \param stopsToPlan whether the car stops before it plans again; otherwise it plans in motion */
    ParkingResult perceivedDrive(const Scenario &scenario, const SensorParameters &sensor, bool stopsToPlan = false);
}  // namespace parking
