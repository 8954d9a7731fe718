#include "parking_geometry/OccupancyGrid.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <cmath>
#include <new>

namespace parking
{
    namespace
    {
        constexpr std::size_t MAX_CELLS = std::size_t(1) << 31;

        std::string sizeText(std::size_t width, std::size_t height)
        {
            return std::to_string(width) + " x " + std::to_string(height) + " cells";
        }
    }  // namespace

    OccupancyGrid::OccupancyGrid(std::size_t width, std::size_t height, double resolution, const Pose &origin,
                                 Cell fill)
      : width_(width),
        height_(height),
        resolution_(resolution),
        origin_(origin)
    {
        if (width == 0 || height == 0)
            throw Error("map of " + sizeText(width, height) + "; both sides must be at least 1");
        if (width > MAX_CELLS / height)
            throw Error("map of " + sizeText(width, height) + "; at most 2^31 cells are supported");
        if (!std::isfinite(resolution) || resolution <= 0.0)
            throw Error("map resolution is " + formatNumber(resolution) +
                        "; it must be a positive number of metres per cell");
        if (!isFinite(origin))
            throw Error("map origin is [" + formatNumber(origin.x) + ", " + formatNumber(origin.y) + ", " +
                        formatNumber(origin.yaw) + "]; all three must be finite numbers");
        try
        {
            cells_.assign(width * height, fill);
        }
        catch (const std::bad_alloc &)
        {
            throw Error("map of " + sizeText(width, height) + "; there is not enough memory for it");
        }
    }

    void checkUpdate(const GridUpdate &update, std::size_t width, std::size_t height)
    {
        for (const CellChange &change : update)
        {
            const auto fail = [&](const std::string &what)
            {
                throw Error("changed cell (" + std::to_string(change.column) + ", " + std::to_string(change.row) +
                            ") " + what);
            };
            if (change.column >= width || change.row >= height)
                fail("lies outside of the map of " + sizeText(width, height));
            if (change.cell > Cell::Unknown)
                fail("has the occupancy " + std::to_string(static_cast<int>(change.cell)) +
                     "; it must be free, occupied or unknown");
        }
    }

    void OccupancyGrid::apply(const GridUpdate &update)
    {
        checkUpdate(update, width_, height_);
        for (const CellChange &change : update)
            set(change.column, change.row, change.cell);
    }

    std::vector<Eigen::Vector2d> OccupancyGrid::outline() const
    {
        const double right = static_cast<double>(width_) * resolution_;
        const double top = static_cast<double>(height_) * resolution_;
        std::vector<Eigen::Vector2d> corners;
        for (const Pose &local : {Pose{0.0, 0.0, 0.0}, {right, 0.0, 0.0}, {right, top, 0.0}, {0.0, top, 0.0}})
        {
            const Pose corner = compose(origin_, local);
            corners.emplace_back(corner.x, corner.y);
        }
        return corners;
    }
}  // namespace parking
