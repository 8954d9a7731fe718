#pragma once

#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/Vehicle.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace parking_test
{
    /** \brief A vehicle with this outline and the limits of TPCAP's car. */
    inline parking::Vehicle outlined(double wheelbase, const parking::Polygon &outline)
    {
        parking::Vehicle vehicle;
        vehicle.name = "outlined";
        vehicle.wheelbase = wheelbase;
        vehicle.setOutline(outline);
        return vehicle;
    }

    /** \brief The default car as an outline. */
    inline parking::Vehicle rectangularOutline()
    {
        const parking::Vehicle car;
        return outlined(car.wheelbase, car.footprint({}));
    }

    /** \brief The default car with cut-off corners: six of them. */
    inline parking::Vehicle hexagonalCar()
    {
        return outlined(2.8,
                        {{-0.929, -0.6}, {0.3, -0.971}, {3.2, -0.971}, {3.76, 0.0}, {3.2, 0.971}, {-0.929, 0.971}});
    }

    /** \brief A car with mirrors, one larger than the other. */
    inline parking::Vehicle carWithMirrors()
    {
        return outlined(2.8, {{-0.9, -0.8},
                              {-0.6, -0.9},
                              {1.9, -0.9},
                              {1.9, -1.1},
                              {2.05, -1.05},
                              {2.05, -0.9},
                              {3.4, -0.9},
                              {3.8, -0.5},
                              {3.8, 0.5},
                              {3.4, 0.9},
                              {2.05, 0.9},
                              {2.1, 1.15},
                              {1.95, 1.2},
                              {1.9, 0.9},
                              {-0.6, 0.9},
                              {-0.9, 0.8}});
    }

    /** \brief A forklift: the forks lie behind the fixed axle, and the rear steers. */
    inline parking::Vehicle forklift()
    {
        return outlined(1.4, {{-1.6, -0.35},
                              {-0.4, -0.35},
                              {-0.4, -0.55},
                              {1.5, -0.55},
                              {1.8, -0.3},
                              {1.8, 0.3},
                              {1.5, 0.55},
                              {-0.4, 0.55},
                              {-0.4, 0.35},
                              {-1.6, 0.35},
                              {-1.6, 0.2},
                              {-0.4, 0.2},
                              {-0.4, -0.2},
                              {-1.6, -0.2}});
    }

    /** \brief An L with the rear axle outside of the body. */
    inline parking::Vehicle axleOutside()
    {
        return outlined(2.0, {{0.3, -1.2}, {2.5, -1.2}, {2.5, -0.6}, {0.9, -0.6}, {0.9, 1.0}, {0.3, 1.0}});
    }

    /** \brief A thin wedge with sharp corners. */
    inline parking::Vehicle wedge()
    {
        return outlined(1.5, {{-0.8, -0.6}, {3.2, 0.1}, {-0.5, 0.5}, {0.1, 0.0}});
    }

    /** \brief All of the above. */
    inline std::vector<parking::Vehicle> outlinedVehicles()
    {
        return {rectangularOutline(), hexagonalCar(), carWithMirrors(), forklift(), axleOutside(), wedge()};
    }

    /** \brief A vehicle with a random outline of 3 to 12 corners, visible from one of its points. */
    inline parking::Vehicle randomOutlined(Random &random)
    {
        for (;;)
        {
            std::vector<double> angles(3 + random.index(10));
            for (double &angle : angles)
                angle = random.between(-parking::PI, parking::PI);
            std::sort(angles.begin(), angles.end());
            const double x = random.between(-1.0, 2.0), y = random.chance(0.5) ? 0.0 : random.between(-1.0, 1.0);
            parking::Polygon outline;
            for (const double angle : angles)
            {
                const double radius = random.between(0.3, 2.5);
                outline.emplace_back(x + radius * std::cos(angle), y + 0.5 * radius * std::sin(angle));
            }
            parking::Vehicle vehicle = outlined(random.between(0.8, 3.0), outline);
            try
            {
                vehicle.validate();
            }
            catch (const parking::Error &)
            {
                continue;
            }
            return vehicle;
        }
    }
}  // namespace parking_test
