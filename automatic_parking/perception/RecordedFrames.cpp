#include "automatic_parking/perception/RecordedFrames.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace parking
{
    namespace
    {
        /** What a frame shows of a square, given by its bounding box in cells of the frame. */
        Cell cellIn(const OccupancyGrid &frame, const Eigen::Vector2d &low, const Eigen::Vector2d &high)
        {
            constexpr double SLACK = 1e-6;  // squares that only touch do not overlap
            const auto width = static_cast<double>(frame.width()), height = static_cast<double>(frame.height());
            const double left = std::floor(low.x() + SLACK), right = std::floor(high.x() - SLACK),
                         bottom = std::floor(low.y() + SLACK), top = std::floor(high.y() - SLACK);
            bool isFree = left >= 0.0 && right < width && bottom >= 0.0 && top < height;
            for (double row = std::max(bottom, 0.0); row <= std::min(top, height - 1.0); ++row)
                for (double column = std::max(left, 0.0); column <= std::min(right, width - 1.0); ++column)
                {
                    const Cell cell = frame.at(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
                    if (cell == Cell::Occupied)
                        return Cell::Occupied;
                    isFree = isFree && cell == Cell::Free;
                }
            return isFree ? Cell::Free : Cell::Unknown;
        }
    }  // namespace

    RecordedFrames::RecordedFrames(std::vector<RecordedFrame> frames) : frames_(std::move(frames))
    {
        for (std::size_t i = 0; i < frames_.size(); ++i)
        {
            const std::string name = "recorded frame " + std::to_string(i + 1);
            if (!std::isfinite(frames_[i].time) || (i > 0 && !(frames_[i].time > frames_[i - 1].time)))
                throw Error(name + ": time is " + formatNumber(frames_[i].time) +
                            " s; it must be a finite number above that of the frame before");
            if (frames_[i].grid.width() == 0)
                throw Error(name + " has no cells");
        }
    }

    GridUpdate RecordedFrames::observe(double time, const Pose & /*car*/, const OccupancyGrid &map)
    {
        GridUpdate seen;
        for (; next_ < frames_.size() && frames_[next_].time <= time; ++next_)
        {
            const OccupancyGrid &frame = frames_[next_].grid;
            const Pose toFrame = relativeTo(frame.origin(), map.origin());
            const double c = std::cos(toFrame.yaw), s = std::sin(toFrame.yaw), scale = map.resolution();
            const double reach = 0.5 * scale * (std::abs(c) + std::abs(s)) / frame.resolution();
            const Eigen::Vector2d half(reach, reach);
            for (std::size_t row = 0; row < map.height(); ++row)
                for (std::size_t column = 0; column < map.width(); ++column)
                {
                    const double x = scale * (static_cast<double>(column) + 0.5),
                                 y = scale * (static_cast<double>(row) + 0.5);
                    const Eigen::Vector2d centre(toFrame.x + c * x - s * y, toFrame.y + s * x + c * y);
                    const Eigen::Vector2d middle = centre / frame.resolution();
                    if (const Cell cell = cellIn(frame, middle - half, middle + half); cell != Cell::Unknown)
                        seen.push_back({static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), cell});
                }
        }
        return seen;
    }
}  // namespace parking
