#include "parking_geometry/manoeuvres/SlotSurroundings.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parking
{
    namespace
    {
        using Eigen::Vector2d;

        constexpr double WALL_THICKNESS = 1.0;

        /** The line through the mouths of the row, in the slot's frame, for a slot on the right. */
        struct MouthLine
        {
            Vector2d corner;     ///< end of the inner side's neighbour, on the line
            Vector2d direction;  ///< of travel in the aisle
            Vector2d inward;     ///< unit normal, into the aisle
        };

        MouthLine mouthLine(const ParkingSlot &slot)
        {
            if (slot.kind == SlotKind::Parallel)
                return {{0.5 * slot.length, 0.5 * slot.width}, {1.0, 0.0}, {0.0, 1.0}};
            const double s = std::sin(slot.aisleAngle()), c = std::cos(slot.aisleAngle());
            return {{0.5 * slot.length + slot.width * c / s, -0.5 * slot.width}, {c, -s}, {s, c}};
        }

        /** From the frame of a slot on the right to the world, mirrored for one on the left. */
        Vector2d toWorld(const ParkingSlot &slot, SlotSide side, const Vector2d &local)
        {
            const Pose point = compose(slot.pose, {local.x(), side == SlotSide::Left ? -local.y() : local.y(), 0.0});
            return {point.x, point.y};
        }

        Polygon parallelogram(const Vector2d &corner, const Vector2d &a, const Vector2d &b)
        {
            return {corner, corner + a, corner + a + b, corner + b};
        }

        /** How deep two convex polygons overlap: the shortest way out along the normals of their sides; negative when
            they do not. */
        double overlap(const std::array<Vector2d, 4> &a, const Polygon &b)
        {
            double least = std::numeric_limits<double>::infinity();
            const auto alongNormals = [&](const auto &polygon)
            {
                for (std::size_t i = 0; i < polygon.size(); ++i)
                {
                    const Vector2d edge = (polygon[(i + 1) % polygon.size()] - polygon[i]).normalized();
                    const Vector2d normal(-edge.y(), edge.x());
                    double lowA = normal.dot(a[0]), highA = lowA, lowB = normal.dot(b[0]), highB = lowB;
                    for (const Vector2d &corner : a)
                    {
                        lowA = std::min(lowA, normal.dot(corner));
                        highA = std::max(highA, normal.dot(corner));
                    }
                    for (const Vector2d &corner : b)
                    {
                        lowB = std::min(lowB, normal.dot(corner));
                        highB = std::max(highB, normal.dot(corner));
                    }
                    least = std::min(least, std::min(highA, highB) - std::max(lowA, lowB));
                }
            };
            alongNormals(a);
            alongNormals(b);
            return least;
        }

        std::string inCentimetres(double metres)
        {
            return formatNumber(std::round(metres * 1000.0) / 10.0) + " cm";
        }
    }  // namespace

    std::vector<Polygon> slotSurroundings(const ParkingSlot &slot, SlotSide side, double aisleWidth, double reach)
    {
        slot.validate();
        const double x = 0.5 * slot.length, y = 0.5 * slot.width;
        const MouthLine mouth = mouthLine(slot);
        std::vector<Polygon> obstacles;
        if (slot.kind == SlotKind::Parallel)
        {
            obstacles.push_back(parallelogram({x, -y}, {reach, 0.0}, {0.0, slot.width}));
            obstacles.push_back(parallelogram({-x - reach, -y}, {reach, 0.0}, {0.0, slot.width}));
            obstacles.push_back(parallelogram({-x - reach, -y - WALL_THICKNESS}, {slot.length + 2.0 * reach, 0.0},
                                              {0.0, WALL_THICKNESS}));
        }
        else
        {
            obstacles.push_back(parallelogram({-x, -y}, reach * mouth.direction, {mouth.corner.x() + x, 0.0}));
            // On the outer side each neighbour lies back from the one before it.
            const double lean = slot.width * mouth.direction.x() / -mouth.direction.y();
            const int neighbours = std::abs(lean) < 1e-9 ? 1 : static_cast<int>(std::ceil(reach / slot.width));
            const double width = neighbours == 1 ? reach : slot.width;
            for (int k = 1; k <= neighbours; ++k)
                obstacles.push_back(
                    parallelogram({-x - k * lean, y + (k - 1) * width}, {slot.length, 0.0}, {0.0, width}));
            obstacles.push_back(parallelogram({-x - WALL_THICKNESS, -y - reach}, {WALL_THICKNESS, 0.0},
                                              {0.0, slot.width + 2.0 * reach}));
        }
        if (std::isfinite(aisleWidth))
            obstacles.push_back(parallelogram(mouth.corner + aisleWidth * mouth.inward - reach * mouth.direction,
                                              2.0 * reach * mouth.direction, WALL_THICKNESS * mouth.inward));
        for (Polygon &polygon : obstacles)
        {
            for (Vector2d &corner : polygon)
                corner = toWorld(slot, side, corner);
            if (signedArea(polygon) < 0.0)
                std::reverse(polygon.begin(), polygon.end());
        }
        return obstacles;
    }

    void checkStart(const ParkingSlot &slot, const Vehicle &vehicle, const Pose &start, double aisleWidth)
    {
        slot.validate();
        const std::array<Vector2d, 4> body = vehicle.footprint(start);
        constexpr double TOLERANCE = 1e-9;
        if (const double inside = overlap(body, slot.outline()); inside > TOLERANCE)
            throw Error("start: the car reaches " + inCentimetres(inside) +
                        " into the slot; it must stand outside of it");
        if (slot.side == SlotSide::Either && slot.kind != SlotKind::Perpendicular)
            return;
        const SlotSide side = slot.side == SlotSide::Left ? SlotSide::Left : SlotSide::Right;
        const MouthLine mouth = mouthLine(slot);
        const Vector2d corner = toWorld(slot, side, mouth.corner);
        const Vector2d inward = toWorld(slot, side, mouth.corner + mouth.inward) - corner;
        double beyond = 0.0;
        for (const Vector2d &each : body)
            beyond = std::max(beyond, inward.dot(each - corner) - aisleWidth);
        if (beyond > TOLERANCE)
            throw Error("start: the car reaches " + inCentimetres(beyond) + " beyond the aisle of " +
                        formatNumber(aisleWidth) + " m");
    }
}  // namespace parking
