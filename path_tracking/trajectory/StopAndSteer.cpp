#include "path_tracking/trajectory/StopAndSteer.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"
#include "path_tracking/trajectory/SpeedProfile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace parking
{
    namespace
    {
        constexpr double CLOTHOID_GRID = 0.01;    // metres between two knots where the curvature changes
        constexpr double SAME_CURVATURE = 1e-9;   // 1/m
        constexpr double CURVATURE_SLACK = 1e-3;  // relative excess of a path's curvature over the car's: rounding
        constexpr double SHORTEST_PIECE = 1e-9;   // metres

        /** Vehicle::validate() without its minimum limits, because shares of a car's limits may be lower. */
        void check(const Vehicle &vehicle)
        {
            const Require require("vehicle " + inQuotes(vehicle.name));
            require.positive("max_speed", vehicle.maxSpeed, "m/s");
            require.positive("max_acceleration", vehicle.maxAcceleration, "m/s^2");
            require.positive("max_steering_rate", vehicle.maxSteeringRate, "rad/s");
            Vehicle car = vehicle;
            for (double Vehicle::*limit : {&Vehicle::maxSpeed, &Vehicle::maxAcceleration, &Vehicle::maxSteeringRate})
                car.*limit = std::max(car.*limit, Vehicle::MIN_LIMIT);
            car.validate();
        }

        void check(const PathPiece &piece, std::size_t index, const Vehicle &vehicle)
        {
            const std::string which = "trajectory: piece " + std::to_string(index + 1) + " of the path ";
            if (!std::isfinite(piece.curvature) || !std::isfinite(piece.length) || !std::isfinite(piece.sharpness) ||
                !std::isfinite(piece.turn))
                throw Error(which + "is not finite");
            if (piece.turn != 0.0)
                throw Error(which + "turns on the spot, which no car can do");
            const double most = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
            if (most * vehicle.minTurningRadius() > 1.0 + CURVATURE_SLACK)
                throw Error(which + "has the curvature " + formatNumber(most) + " 1/m; the maximum of the car is " +
                            formatNumber(1.0 / vehicle.minTurningRadius()) + " 1/m");
        }

        double steeringOf(const Vehicle &vehicle, double curvature)
        {
            return std::clamp(vehicle.steeringAngle(curvature), -vehicle.maxSteeringAngle, vehicle.maxSteeringAngle);
        }

        /** A path between two standstills. */
        struct Leg
        {
            int direction{1};
            std::vector<SteeringKnot> steering;

            void add(const PathPiece &piece, const Vehicle &vehicle)
            {
                direction = piece.direction();
                if (steering.empty())
                    steering.push_back({0.0, steeringOf(vehicle, piece.curvature)});
                const double parts = piece.sharpness == 0.0 ? 1.0 : std::ceil(piece.driven() / CLOTHOID_GRID);
                const double begin = steering.back().s;
                for (double k = 1.0; k <= parts; k += 1.0)
                {
                    const double driven = piece.driven() * (k / parts);
                    steering.push_back({begin + driven, steeringOf(vehicle, piece.curvatureAt(driven))});
                }
            }
        };
    }  // namespace

    TimedMotion stopAndSteer(const Path &path, const Vehicle &vehicle, std::optional<double> initialSteering,
                             std::optional<double> finalSteering)
    {
        check(vehicle);
        if (!isFinite(path.start))
            throw Error("trajectory: the path does not begin at a finite pose");
        std::vector<Leg> legs;
        const PathPiece *before = nullptr;
        for (std::size_t i = 0; i < path.pieces.size(); ++i)
        {
            const PathPiece &piece = path.pieces[i];
            check(piece, i, vehicle);
            if (piece.driven() <= SHORTEST_PIECE)
                continue;
            const bool continues = before != nullptr && before->direction() == piece.direction() &&
                                   std::abs(before->endCurvature() - piece.curvature) <= SAME_CURVATURE;
            if (!continues)
                legs.emplace_back();
            legs.back().add(piece, vehicle);
            before = &piece;
        }
        if (legs.empty())
            throw Error("trajectory: the path never drives");
        SpeedLimits limits = SpeedLimits::of(vehicle);
        limits.lateralAcceleration = std::numeric_limits<double>::infinity();
        TimedMotion motion{path.start, {}};
        double steering = initialSteering.value_or(legs.front().steering.front().angle);
        motion.append(0.0, 0.0, steering);
        for (const Leg &leg : legs)
        {
            const double first = leg.steering.front().angle;
            motion.append(std::abs(first - steering) / vehicle.maxSteeringRate, 0.0, first);
            const std::vector<SpeedPoint> drive = fastestDrive(leg.steering, limits, vehicle);
            for (std::size_t i = 1; i < drive.size(); ++i)
                motion.append(drive[i].t - drive[i - 1].t, leg.direction * drive[i].speed,
                              steeringAt(leg.steering, drive[i].s));
            steering = leg.steering.back().angle;
        }
        const double last = finalSteering.value_or(steering);
        motion.append(std::abs(last - steering) / vehicle.maxSteeringRate, 0.0, last);
        if (!(motion.duration() <= LONGEST_MOTION))
            throw Error("trajectory: the path takes " + formatNumber(std::round(motion.duration())) +
                        " s with these limits of the car; at most " + formatNumber(LONGEST_MOTION) +
                        " s are supported");
        return motion;
    }
}  // namespace parking
