#include "parking_geometry/ParkingSlot.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        /** Overlap in metres that counts as rounding if the slot is exactly as long as the car. */
        constexpr double TOLERANCE = 1e-9;

        /** Largest dimension in metres; larger values indicate other units. */
        constexpr double MAX_LENGTH = 1000.0;

        void checkLength(const Require &require, const char *field, double value)
        {
            require.that(value > 0.0 && value <= MAX_LENGTH, field, value,
                         "a number of metres above 0 and up to " + formatNumber(MAX_LENGTH));
        }

        std::string inCentimetres(double metres)
        {
            return formatNumber(std::ceil(metres * 1000.0 - 1e-6) / 10.0) + " cm";
        }

        void checkFits(const char *dimension, double car, double slot)
        {
            if (car > slot + TOLERANCE)
                throw Error("slot: " + std::string(dimension) + " is " + formatNumber(slot) + " m, " +
                            inCentimetres(car - slot) + " less than that of the car (" + formatNumber(car) + " m)");
        }
    }  // namespace

    std::vector<Pose> ParkingSlot::goals(const Vehicle &vehicle) const
    {
        validate();
        const double spareLength = length - vehicle.length(), spareWidth = width - vehicle.width;
        checkFits("length", vehicle.length(), length);
        checkFits("width", vehicle.width, width);
        const double gap = depth.value_or(0.5 * spareLength);
        if (gap < -TOLERANCE || gap > spareLength + TOLERANCE)
            throw Error("slot: depth is " + formatNumber(gap) + ", which puts the car " +
                        inCentimetres(gap < 0.0 ? -gap : gap - spareLength) + " outside; it must be from 0 to " +
                        formatNumber(spareLength));
        if (std::abs(lateralOffset) > 0.5 * spareWidth + TOLERANCE)
            throw Error("slot: lateral offset is " + formatNumber(lateralOffset) + ", which puts the car " +
                        inCentimetres(std::abs(lateralOffset) - 0.5 * spareWidth) +
                        " outside; its magnitude must be at most " + formatNumber(0.5 * spareWidth));
        const double innerEnd = -0.5 * length + gap;
        const Pose tailIn = compose(pose, {innerEnd + vehicle.rearOverhang, lateralOffset, 0.0});
        if (kind == SlotKind::Parallel)
            return {tailIn};
        const Pose noseIn = compose(pose, {innerEnd + vehicle.frontOverhang + vehicle.wheelbase, lateralOffset, PI});
        switch (entry)
        {
            case SlotEntry::Reverse:
                return {tailIn};
            case SlotEntry::Forward:
                return {noseIn};
            default:
                return {tailIn, noseIn};
        }
    }

    Polygon ParkingSlot::outline() const
    {
        Polygon corners;
        for (const auto &[x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
        {
            const Pose corner = compose(pose, {x * length, y * width, 0.0});
            corners.emplace_back(corner.x, corner.y);
        }
        return corners;
    }

    void ParkingSlot::validate() const
    {
        const Require require("slot");
        for (const auto &[field, value] : {std::pair{"pose x", pose.x}, {"pose y", pose.y}})
        {
            require.finite(field, value, "metres");
            if (std::abs(value) > MAX_COORDINATE)
                require.that(false, field, value,
                             "at most " + formatNumber(MAX_COORDINATE) + " m either way: move the origin");
        }
        require.finite("pose yaw", pose.yaw, "radians");
        checkLength(require, "length", length);
        checkLength(require, "width", width);
        if (kind == SlotKind::Angled)
            require.that(angle > 0.0 && angle <= 0.5 * PI + TOLERANCE, "angle", angle,
                         "in (0, 1.5708] radians, above 0 and up to 90 degrees");
        if (depth)
            require.finite("depth", *depth, "metres");
        require.finite("lateral offset", lateralOffset, "metres");
    }

    double ParkingSlot::aisleAngle() const
    {
        switch (kind)
        {
            case SlotKind::Parallel:
                return 0.0;
            case SlotKind::Perpendicular:
                return 0.5 * PI;
            default:
                return angle;
        }
    }

    double ParkingSlot::aisleYaw(SlotSide onSide) const
    {
        return wrapAngle(pose.yaw + (onSide == SlotSide::Left ? aisleAngle() : -aisleAngle()));
    }
}  // namespace parking
