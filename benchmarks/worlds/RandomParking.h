#pragma once

#include "benchmarks/worlds/Random.h"
#include "parking_geometry/ParkingSlot.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

namespace parking_test
{
    using namespace parking;

    /** \brief Random cars, slots and paths; equal seeds give equal ones. */
    class RandomParking : public Random
    {
    public:
        /** \brief Creates a generator; equal seeds give equal cars, slots and paths. */
        using Random::Random;

        /** \brief A pose within \e extent metres of the origin along both axes, with any heading. */
        Pose pose(double extent)
        {
            return poseIn(-extent, extent);
        }

        /** A car from a city car to a large van, with any usual steering angle and rate. */
        Vehicle vehicle()
        {
            Vehicle car;
            car.name = "random";
            car.wheelbase = between(1.8, 3.4);
            car.frontOverhang = between(0.3, 1.1);
            car.rearOverhang = between(0.3, 1.3);
            car.width = between(1.5, 2.2);
            car.maxSteeringAngle = between(0.45, 0.78);
            car.maxSteeringRate = between(0.3, 0.8);
            return car;
        }

        /** A slot that contains \e car, of any kind and place; its side and entry are definite. */
        ParkingSlot slot(const Vehicle &car)
        {
            ParkingSlot result;
            result.kind = static_cast<SlotKind>(below(3));
            result.pose = pose(50.0);
            result.angle = between(0.35, 0.5 * PI);
            result.length = car.length() + between(0.02, 1.0);
            result.width = car.width + between(0.05, 1.2);
            result.side = chance(0.5) ? SlotSide::Right : SlotSide::Left;
            result.entry = chance(0.5) ? SlotEntry::Reverse : SlotEntry::Forward;
            if (chance(0.5))
            {
                result.depth = between(0.0, 1.0) * (result.length - car.length());
                result.lateralOffset = between(-0.5, 0.5) * (result.width - car.width);
            }
            return result;
        }

        /** A path of the kind that lattice planners return: stretches of pieces at full, half or no lock, 0.2 to 2.5 m
            each. The turning radius is \e radiusFactor times the minimum. */
        Path plannerPath(const Vehicle &car, double radiusFactor)
        {
            const double full = 1.0 / (radiusFactor * car.minTurningRadius());
            const double choices[] = {full, -full, full, -full, 0.5 * full, -0.5 * full, 0.0, 0.0};
            Path path{pose(20.0), {}};
            double direction = chance(0.5) ? 1.0 : -1.0;
            for (int stretch = below(5); stretch >= 0; --stretch, direction = -direction)
                for (int piece = below(6); piece >= 0; --piece)
                    path.append({choices[below(8)], direction * between(0.2, 2.5)});
            return path;
        }
    };
}  // namespace parking_test
