#pragma once

#include "benchmarks/worlds/PolygonOracle.h"
#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Scenario.h"
#include "tests/fuzz/Fuzz.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace parking_test::fuzz
{
    /** \brief A car between small and large. */
    inline parking::Vehicle smallWorldCar(Numbers &numbers)
    {
        parking::Vehicle car;
        if (numbers.flag())
        {
            car.wheelbase = numbers.between(0.3, 3.5);
            car.frontOverhang = numbers.between(0.0, 1.2);
            car.rearOverhang = numbers.between(0.0, 1.2);
            car.width = numbers.between(0.2, 2.4);
            car.maxSteeringAngle = numbers.between(0.2, 1.0);
        }
        return car;
    }

    /** \brief Few boxes and stars within some 9 m of the middle; sometimes long thin ones, sometimes one that is hardly
     * there. */
    inline std::vector<parking::Polygon> smallWorldPolygons(Numbers &numbers)
    {
        std::vector<parking::Polygon> polygons;
        for (std::size_t left = numbers.below(6); left > 0; --left)
        {
            const parking::Pose at{numbers.between(-9.0, 9.0), numbers.between(-9.0, 9.0), numbers.between(-4.0, 4.0)};
            if (numbers.flag())
            {
                const double thinnest = numbers.flag() ? 0.002 : 0.3;
                polygons.push_back(rectangle(numbers.between(thinnest, 8.0), numbers.between(thinnest, 3.0), at));
                continue;
            }
            parking::Polygon star;
            const std::size_t corners = 3 + numbers.below(6);
            for (std::size_t i = 0; i < corners; ++i)
            {
                const double angle = 2.0 * parking::PI * (static_cast<double>(i) + numbers.between(0.0, 0.7)) /
                                     static_cast<double>(corners);
                const double radius = numbers.between(0.2, 3.0);
                star.emplace_back(at.x + radius * std::cos(angle), at.y + radius * std::sin(angle));
            }
            polygons.push_back(std::move(star));
        }
        return polygons;
    }

    /** \brief Metres: half the side of the worlds. Many small ones find more than few large ones. */
    constexpr double REACH = 14.0;

    /** \brief Side of a distance field's cells in metres, coarse: fine ones take all of the time. */
    inline double fieldResolution(Numbers &numbers)
    {
        return numbers.below(8) == 0 ? 0.2 : 0.6;
    }

    /** \brief Start, goal and obstacles within a small world. */
    inline parking::Scenario smallWorld(Numbers &numbers)
    {
        parking::Scenario scenario;
        scenario.name = "fuzzed";
        scenario.vehicle = smallWorldCar(numbers);
        scenario.polygons = smallWorldPolygons(numbers);
        scenario.start = {numbers.between(-6.0, 6.0), numbers.between(-6.0, 6.0), numbers.between(-3.14, 3.14)};
        for (std::size_t left = 1 + numbers.below(2); left > 0; --left)
            scenario.goals.push_back({scenario.start.x + numbers.between(-10.0, 10.0),
                                      scenario.start.y + numbers.between(-10.0, 10.0), numbers.between(-3.14, 3.14)});
        scenario.bounds = {{-REACH, -REACH}, {REACH, REACH}};
        return scenario;
    }
}  // namespace parking_test::fuzz
