#include "path_tracking/trajectory/StopAndSteer.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace parking
{
    namespace
    {
        constexpr double CLOTHOID_GRID = 0.01;    // metres between two knots where the curvature changes
        constexpr double SAME_CURVATURE = 1e-9;   // 1/m
        constexpr double CURVATURE_SLACK = 1e-3;  // share by which a path may exceed the car's curvature: rounding
        constexpr double SHORTEST_PIECE = 1e-9;   // metres
        constexpr double NEGLIGIBLE = 1e-9;       // metres, of a change of speed

        /** What Vehicle::validate() asks for but the least limits: what is used of a car's may be less. */
        void check(const Vehicle &vehicle)
        {
            const Require require("vehicle " + inQuotes(vehicle.name));
            require.positive("max_speed", vehicle.maxSpeed, "m/s");
            require.positive("max_acceleration", vehicle.maxAcceleration, "m/s^2");
            require.positive("max_steering_rate", vehicle.maxSteeringRate, "rad/s");
            Vehicle car = vehicle;
            for (double Vehicle::*limit : {&Vehicle::maxSpeed, &Vehicle::maxAcceleration, &Vehicle::maxSteeringRate})
                car.*limit = std::max(car.*limit, Vehicle::LEAST_LIMIT);
            car.validate();
        }

        void check(const PathPiece &piece, std::size_t index, const Vehicle &vehicle)
        {
            const std::string which = "trajectory: piece " + std::to_string(index + 1) + " of the path ";
            if (!std::isfinite(piece.curvature) || !std::isfinite(piece.length) || !std::isfinite(piece.sharpness) ||
                !std::isfinite(piece.turn))
                throw Error(which + "is not finite");
            if (piece.turn != 0.0)
                throw Error(which + "turns on the spot; no car can");
            const double most = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
            if (most * vehicle.minTurningRadius() > 1.0 + CURVATURE_SLACK)
                throw Error(which + "has the curvature " + formatNumber(most) + " 1/m; the car turns with up to " +
                            formatNumber(1.0 / vehicle.minTurningRadius()) + " 1/m");
        }

        double steeringOf(const Vehicle &vehicle, double curvature)
        {
            return std::clamp(vehicle.steeringAngle(curvature), -vehicle.maxSteeringAngle, vehicle.maxSteeringAngle);
        }

        /** A way between two standstills by its knots: place, steering angle there. */
        struct Leg
        {
            struct Knot
            {
                double place;  // metres since the begin of the leg
                double steering;
            };

            int direction{1};
            std::vector<Knot> knots;

            void add(const PathPiece &piece, const Vehicle &vehicle)
            {
                direction = piece.direction();
                if (knots.empty())
                    knots.push_back({0.0, steeringOf(vehicle, piece.curvature)});
                const double parts = piece.sharpness == 0.0 ? 1.0 : std::ceil(piece.driven() / CLOTHOID_GRID);
                const double begin = knots.back().place;
                for (double k = 1.0; k <= parts; k += 1.0)
                {
                    const double driven = piece.driven() * (k / parts);
                    knots.push_back({begin + driven, steeringOf(vehicle, piece.curvatureAt(driven))});
                }
            }
        };

        /** Drives a leg from rest to rest. */
        void drive(const Leg &leg, const Vehicle &vehicle, TimedMotion &motion)
        {
            const std::size_t n = leg.knots.size();
            const double doubled = 2.0 * vehicle.maxAcceleration;
            std::vector<double> caps(n, vehicle.maxSpeed * vehicle.maxSpeed), squared(n, 0.0);
            for (std::size_t i = 1; i < n; ++i)
            {
                const double angle = std::abs(leg.knots[i].steering - leg.knots[i - 1].steering);
                if (angle <= 0.0)
                    continue;
                const double speed = vehicle.maxSteeringRate * (leg.knots[i].place - leg.knots[i - 1].place) / angle;
                for (const std::size_t k : {i - 1, i})
                    caps[k] = std::min(caps[k], speed * speed);
            }
            for (std::size_t i = 1; i + 1 < n; ++i)
                squared[i] =
                    std::min(caps[i], squared[i - 1] + doubled * (leg.knots[i].place - leg.knots[i - 1].place));
            for (std::size_t i = n - 1; i-- > 0;)
                squared[i] =
                    std::min(squared[i], squared[i + 1] + doubled * (leg.knots[i + 1].place - leg.knots[i].place));
            for (std::size_t i = 1; i < n; ++i)
            {
                const double length = leg.knots[i].place - leg.knots[i - 1].place, from = squared[i - 1],
                             to = squared[i];
                const double top = leg.knots[i].steering == leg.knots[i - 1].steering
                                       ? vehicle.maxSpeed * vehicle.maxSpeed
                                       : std::max(from, to);
                const double peak = std::min(top, 0.5 * (from + to + doubled * length));
                const auto way = [&](double slow)
                {
                    const double metres = (peak - slow) / doubled;
                    return metres > NEGLIGIBLE ? metres : 0.0;
                };
                const double rise = way(from), fall = way(to);
                const double v0 = std::sqrt(from), v1 = std::sqrt(std::max(0.0, peak)), v2 = std::sqrt(to);
                // The steering angle moves with the place; where it does, the parts are a centimetre at most.
                const auto steeringAt = [&](double driven)
                {
                    return leg.knots[i - 1].steering +
                           std::clamp(driven / length, 0.0, 1.0) * (leg.knots[i].steering - leg.knots[i - 1].steering);
                };
                const double cruise = length - rise - fall;
                if (rise > 0.0)
                    motion.append(2.0 * rise / (v0 + v1), leg.direction * v1, steeringAt(rise));
                if (cruise > NEGLIGIBLE)
                    motion.append(cruise / v1, leg.direction * v1, steeringAt(rise + cruise));
                if (fall > 0.0)
                    motion.append(2.0 * fall / (v1 + v2), leg.direction * v2, steeringAt(length));
            }
        }
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
            const bool goesOn = before != nullptr && before->direction() == piece.direction() &&
                                std::abs(before->endCurvature() - piece.curvature) <= SAME_CURVATURE;
            if (!goesOn)
                legs.emplace_back();
            legs.back().add(piece, vehicle);
            before = &piece;
        }
        if (legs.empty())
            throw Error("trajectory: the path never drives");
        TimedMotion motion{path.start, {}};
        double steering = initialSteering.value_or(legs.front().knots.front().steering);
        motion.append(0.0, 0.0, steering);
        for (const Leg &leg : legs)
        {
            motion.append(std::abs(leg.knots.front().steering - steering) / vehicle.maxSteeringRate, 0.0,
                          leg.knots.front().steering);
            drive(leg, vehicle, motion);
            steering = leg.knots.back().steering;
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
