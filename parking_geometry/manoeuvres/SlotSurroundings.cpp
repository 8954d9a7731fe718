#include "parking_geometry/manoeuvres/SlotSurroundings.h"

#include <algorithm>
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
            // On the outer side each neighbour is set back from the previous one.
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
}  // namespace parking
