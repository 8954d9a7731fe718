#pragma once

#include "benchmarks/worlds/PolygonOracle.h"
#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Polygon.h"
#include "parking_geometry/Scenario.h"
#include "path_tracking/simulation/Plant.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <optional>
#include <vector>

namespace parking
{
    /** \brief Minimum distance in metres of an avoidable obstacle from a stop: controllers measure poses to a
        centimetre. */
    constexpr double SPARE_AT_STOP = 0.05;

    /** \brief First contact of a drive. */
    struct Touch
    {
        double time{0.0};    ///< seconds
        double speed{0.0};   ///< m/s, not negative
        double driven{0.0};  ///< metres driven before it
    };

    /** \brief The first contact of \e drive at or after \e since seconds, checked every few millimetres; empty without
        contact. */
    std::optional<Touch> firstTouch(const Trajectory &drive, const Vehicle &car,
                                    const parking_test::PolygonOracle &oracle, double since);

    /** \brief The physically possible stop: a car that brakes with full force from a given time of a drive.

        An independent integration in steps of 5 ms, which shares nothing with controller, supervisor and simulated car.
        It decelerates at this car's limit. The steering is that of the drive at the same place, and stays constant
        while stuck.

        \param drive the simulated drive without braking
        \param odds disturbances of the car
        \param since seconds, begin of the check: an obstacle appears, or a fault begins
        \param brakes seconds when the brake takes effect
        \return the poses from \e since to standstill */
    std::vector<Pose> brakingPath(const Trajectory &drive, const Vehicle &car, const Disturbances &odds, double since,
                                  double brakes);

    /** \brief Whether a car is free at all poses of a path, with a distance of \e spare metres. */
    bool isFree(const std::vector<Pose> &path, const Vehicle &car, const parking_test::PolygonOracle &oracle,
                double spare);

    /** \brief The reference checker of a single obstacle. */
    parking_test::PolygonOracle alone(const Polygon &obstacle);

    /** \brief An obstacle that appears in front of a driving car. */
    struct Surprise
    {
        double time{0.0};   ///< seconds when it appears
        double ahead{0.0};  ///< metres until contact
        Polygon obstacle;   ///< outline, in the coordinates of the scenario
    };

    /** \brief A box 0.5 to 6 m in front of a car that continues its drive; empty when no place is found. */
    std::optional<Surprise> surpriseFor(const Scenario &scenario, const Trajectory &drive,
                                        parking_test::Random &random);
}  // namespace parking
