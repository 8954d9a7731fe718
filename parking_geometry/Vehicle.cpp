#include "parking_geometry/Vehicle.h"

#include "parking_geometry/Box.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Largest length in metres. Larger values indicate other units and would otherwise only result in an
            infeasible problem. */
        constexpr double MAX_LENGTH = 50.0;
        /** Smallest length in metres. Below it, rounding errors are as large as the car and OMPL's curves fail their
            own checks. */
        constexpr double MIN_LENGTH = 0.01;
        constexpr double MIN_RADIUS = 0.01, MAX_RADIUS = 1000.0;  // metres

        /** Checks a limit of the drive. Smaller values would result in drives of hours and exhaust the memory, larger
            ones indicate other units. The minimum is twice that of a timed path (SpeedLimits), so a share of the limit
            can be reserved for the controller. */
        void checkLimit(const Require &require, const char *field, double value, const std::string &unit)
        {
            require.that(value >= Vehicle::MIN_LIMIT && value <= Vehicle::MAX_LIMIT, field, value,
                         "a number of " + unit + " from " + formatNumber(Vehicle::MIN_LIMIT) + " to " +
                             formatNumber(Vehicle::MAX_LIMIT));
        }

        void checkLength(const Require &require, const char *field, double value, bool zeroAllowed)
        {
            const bool ok = std::isfinite(value) && value >= (zeroAllowed ? 0.0 : MIN_LENGTH) && value <= MAX_LENGTH;
            require.that(ok, field, value,
                         zeroAllowed ? "a number of metres from 0 to 50" : "a number of metres from 0.01 to 50");
        }

        /** Smallest distance in metres between a corner of an outline and a side to which it does not belong. */
        constexpr double MIN_APART = 1e-3;
        /** Largest difference in metres between a given length and that of the outline, for rounded files. */
        constexpr double SAME_LENGTH = 1e-6;

        /** The bounding rectangle of the outline and both axles, as lengths of \e vehicle. */
        void setLengths(Vehicle &vehicle)
        {
            Box box{{0.0, 0.0}, {vehicle.wheelbase, 0.0}};
            for (const Eigen::Vector2d &corner : vehicle.outline)
                box.include(corner);
            vehicle.frontOverhang = box.max.x() - vehicle.wheelbase;
            vehicle.rearOverhang = -box.min.x();
            vehicle.width = 2.0 * std::max(-box.min.y(), box.max.y());
        }

        /** Throws for the first fault of the outline. */
        void checkOutline(const Vehicle &vehicle)
        {
            const Polygon &outline = vehicle.outline;
            const std::size_t count = outline.size();
            const auto refuse = [&vehicle](const std::string &fault)
            {
                throw FieldError("vehicle " + inQuotes(vehicle.name) + ": outline " + fault, "outline");
            };
            const auto numbered = [](std::size_t index)
            {
                return std::to_string(index + 1);
            };
            if (count < 3 || count > Vehicle::MAX_CORNERS)
                refuse("has " + std::to_string(count) + " corners; it must have 3 to " +
                       std::to_string(Vehicle::MAX_CORNERS));
            for (std::size_t i = 0; i < count; ++i)
                if (!outline[i].allFinite() || outline[i].cwiseAbs().maxCoeff() > MAX_LENGTH)
                    refuse("has the corner " + numbered(i) + " at (" + formatNumber(outline[i].x()) + ", " +
                           formatNumber(outline[i].y()) + "); it must be within 50 m of the rear axle");
            if (crossesItself(outline))
                refuse("crosses itself; it must be a simple polygon");
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t k = 0; k < count; ++k)
                    if (k != i && (k + 1) % count != i &&
                        distanceToSegment(outline[i], outline[k], outline[(k + 1) % count]) < MIN_APART)
                        refuse("has the corner " + numbered(i) + " nearer than 1 mm to the side from corner " +
                               numbered(k) + " to " + numbered((k + 1) % count) + "; it must be a simple polygon");
            if (signedArea(outline) < 0.0)
                refuse("is clockwise; Vehicle::setOutline() accepts either order");
        }

        /** Throws if a length differs from that of the outline. */
        void checkLengths(const Require &require, const Vehicle &vehicle)
        {
            Vehicle right = vehicle;
            setLengths(right);
            const auto check = [&require](const char *field, double value, double expected)
            {
                require.that(std::abs(value - expected) <= SAME_LENGTH, field, value,
                             formatNumber(expected) + " m, as the outline determines, or absent");
            };
            check("front_overhang", vehicle.frontOverhang, right.frontOverhang);
            check("rear_overhang", vehicle.rearOverhang, right.rearOverhang);
            check("width", vehicle.width, right.width);
        }
    }  // namespace

    void Vehicle::setOutline(const Polygon &corners)
    {
        outline = corners;
        if (signedArea(outline) < 0.0)
            std::reverse(outline.begin(), outline.end());
        setLengths(*this);
    }

    double Vehicle::inscribedRadius(double margin) const
    {
        if (!outline.empty())
            return std::max(0.0, margin + depthWithin(outline, {0.0, 0.0}));
        return margin + std::min({0.5 * width, rearOverhang, wheelbase + frontOverhang});
    }

    double Vehicle::bodyRadius(double margin) const
    {
        return margin +
               (outline.empty() ? 0.5 * std::min(width, length()) : depthWithin(outline, deepestPoint(outline)));
    }

    double Vehicle::turningLane(double margin) const
    {
        const double half = 0.5 * width + margin, farthest = margin + std::max(rearOverhang, wheelbase + frontOverhang);
        const double radius = minTurningRadius();
        return std::hypot(radius + half, farthest) - std::max(0.0, radius - half);
    }

    double Vehicle::minTurningRadius() const
    {
        return wheelbase / std::tan(maxSteeringAngle);
    }

    double Vehicle::curvature(double steeringAngle) const
    {
        return std::tan(steeringAngle) / wheelbase;
    }

    double Vehicle::steeringAngle(double curvature) const
    {
        return std::atan(curvature * wheelbase);
    }

    Polygon Vehicle::footprint(const Pose &pose) const
    {
        const Eigen::Vector2d axle(pose.x, pose.y);
        const Eigen::Vector2d forward(std::cos(pose.yaw), std::sin(pose.yaw));
        if (!outline.empty())
        {
            Polygon corners;
            for (const Eigen::Vector2d &corner : outline)
                corners.emplace_back(axle + corner.x() * forward +
                                     corner.y() * Eigen::Vector2d(-forward.y(), forward.x()));
            return corners;
        }
        const Eigen::Vector2d left = 0.5 * width * Eigen::Vector2d(-forward.y(), forward.x());
        const Eigen::Vector2d rear = axle - rearOverhang * forward;
        const Eigen::Vector2d front = axle + (wheelbase + frontOverhang) * forward;
        return {rear - left, front - left, front + left, rear + left};
    }

    void Vehicle::validate() const
    {
        const Require require("vehicle " + inQuotes(name));
        checkLength(require, "wheelbase", wheelbase, false);
        if (!outline.empty())
        {
            checkOutline(*this);
            checkLengths(require, *this);
        }
        checkLength(require, "front_overhang", frontOverhang, true);
        checkLength(require, "rear_overhang", rearOverhang, true);
        checkLength(require, "width", width, false);
        require.that(std::isfinite(maxSteeringAngle) && maxSteeringAngle > 0.0 && maxSteeringAngle < 0.5 * PI,
                     "max_steering_angle", maxSteeringAngle,
                     "a number of radians above 0 and below 1.5708 (90 degrees)");
        const double radius = minTurningRadius();
        require.that(radius >= MIN_RADIUS && radius <= MAX_RADIUS, "max_steering_angle", maxSteeringAngle,
                     "an angle that turns the car round a circle with a radius of 0.01 to 1000 m, not " +
                         formatNumber(radius) + " m");
        checkLimit(require, "max_speed", maxSpeed, "m/s");
        checkLimit(require, "max_acceleration", maxAcceleration, "m/s^2");
        checkLimit(require, "max_steering_rate", maxSteeringRate, "rad/s");
    }
}  // namespace parking
