#pragma once

#include "parking_geometry/ParkingSlot.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <random>

namespace parking_test
{
    using namespace parking;

    /** \brief Random cars, slots and paths; the same ones for the same seed. */
    class RandomParking
    {
    public:
        explicit RandomParking(unsigned seed) : generator_(seed)
        {
        }

        double uniform(double low, double high)
        {
            return std::uniform_real_distribution<double>(low, high)(generator_);
        }

        bool coin()
        {
            return generator_() % 2 == 0;
        }

        int below(int count)
        {
            return static_cast<int>(generator_() % static_cast<unsigned>(count));
        }

        Pose pose(double extent)
        {
            return {uniform(-extent, extent), uniform(-extent, extent), uniform(-PI, PI)};
        }

        /** From a city car to a large van, steering from lazy to nimble. */
        Vehicle vehicle()
        {
            Vehicle car;
            car.name = "random";
            car.wheelbase = uniform(1.8, 3.4);
            car.frontOverhang = uniform(0.3, 1.1);
            car.rearOverhang = uniform(0.3, 1.3);
            car.width = uniform(1.5, 2.2);
            car.maxSteeringAngle = uniform(0.45, 0.78);
            car.maxSteeringRate = uniform(0.3, 0.8);
            return car;
        }

        /** A slot that holds \e car, of any kind, anywhere; side and entry are given, not Either. */
        ParkingSlot slot(const Vehicle &car)
        {
            ParkingSlot result;
            result.kind = static_cast<SlotKind>(below(3));
            result.pose = pose(50.0);
            result.angle = uniform(0.35, 0.5 * PI);
            result.length = car.length() + uniform(0.02, 1.0);
            result.width = car.width + uniform(0.05, 1.2);
            result.side = coin() ? SlotSide::Right : SlotSide::Left;
            result.entry = coin() ? SlotEntry::Reverse : SlotEntry::Forward;
            if (coin())
            {
                result.depth = uniform(0.0, 1.0) * (result.length - car.length());
                result.lateralOffset = uniform(-0.5, 0.5) * (result.width - car.width);
            }
            return result;
        }

        /** What a lattice planner returns: stretches of pieces at full, half or no lock, 0.2 to 2.5 m each, at a
            turning radius that many times the smallest. */
        Path plannerPath(const Vehicle &car, double radiusFactor)
        {
            const double full = 1.0 / (radiusFactor * car.minTurningRadius());
            const double choices[] = {full, -full, full, -full, 0.5 * full, -0.5 * full, 0.0, 0.0};
            Path path{pose(20.0), {}};
            double direction = coin() ? 1.0 : -1.0;
            for (int stretch = below(5); stretch >= 0; --stretch, direction = -direction)
                for (int piece = below(6); piece >= 0; --piece)
                    path.append({choices[below(8)], direction * uniform(0.2, 2.5)});
            return path;
        }

    private:
        std::mt19937 generator_;
    };
}  // namespace parking_test
