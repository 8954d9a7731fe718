#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <tuple>

namespace parking
{
    namespace
    {
        // The grid of SurroundOcc: 100 m x 100 m x 8 m round the lidar in cells of half a metre.
        constexpr int SIDE = 200;
        constexpr int LAYERS = 16;
        constexpr double CELL = 0.5;
        constexpr double CORNER = -50.0;

        /** Number of layers above the ground that obstruct a car: voxels with a centre up to 2.2 m. The car passes
            under higher ones. */
        constexpr int CAR_LAYERS = 4;

        /** nuScenes: the rear axle is this far behind the lidar, and the car heads along +y of the lidar's frame. */
        constexpr double AXLE_BEHIND_LIDAR = 0.94;

        // Labels of nuScenes' lidar segmentation that matter here.
        bool isDrivable(std::int64_t label)
        {
            return label == 11 || label == 12;  // road, other flat ground
        }
        bool isOffRoad(std::int64_t label)
        {
            return label == 13 || label == 14;  // pavement, terrain
        }
        bool isObstacle(std::int64_t label)
        {
            return (label >= 1 && label <= 10) || label == 15 || label == 16;
        }

        struct Voxel
        {
            int x, y, z;
            std::int64_t label;
        };

        /** One entry of the Python dictionary in a .npy header, up to the comma or bracket that ends it. */
        std::string_view headerEntry(const std::string &file, std::string_view header, const std::string &key)
        {
            const std::size_t at = header.find("'" + key + "':");
            if (at == std::string_view::npos)
                throw Error(file + ": not a valid .npy file: its header has no " + key);
            std::string_view rest = trimmed(header.substr(at + key.size() + 3));
            const std::size_t end = !rest.empty() && rest[0] == '(' ? rest.find(')') : rest.find_first_of(",}");
            if (end == std::string_view::npos)
                throw Error(file + ": not a valid .npy file: the " + key + " in its header has no end");
            return rest.substr(0, rest[0] == '(' ? end + 1 : end);
        }

        /** Rows of an (n, 4) shape such as "(123, 4)". */
        std::size_t rowsOf(const std::string &file, std::string_view shape)
        {
            const std::size_t comma = shape.find(',');
            std::size_t rows = 0, columns = 0;
            const bool ok = shape.size() > 2 && shape.front() == '(' && comma != std::string_view::npos &&
                            parseCount(trimmed(shape.substr(1, comma - 1)), rows) &&
                            parseCount(trimmed(shape.substr(comma + 1, shape.size() - comma - 2)), columns);
            if (!ok || columns != 4)
                throw Error(file + ": its shape is " + inQuotes(shape) +
                            "; SurroundOcc occupancy is (n, 4): ix, iy, iz, label");
            if (rows == 0 || rows > std::size_t(SIDE) * SIDE * LAYERS)
                throw Error(file + ": holds " + std::to_string(rows) + " voxels; it must be 1 to " +
                            std::to_string(SIDE * SIDE * LAYERS));
            return rows;
        }

        Voxel checkedVoxel(const std::string &file, std::size_t row, const std::array<std::int64_t, 4> &values)
        {
            const std::array<std::int64_t, 4> ends = {SIDE, SIDE, LAYERS, 256};
            const std::array<const char *, 4> names = {"ix", "iy", "iz", "label"};
            for (std::size_t i = 0; i < 4; ++i)
                if (values[i] < 0 || values[i] >= ends[i])
                    throw Error(file + ": voxel " + std::to_string(row + 1) + " has " + names[i] + ' ' +
                                std::to_string(values[i]) + "; it must be 0 to " + std::to_string(ends[i] - 1));
            return {static_cast<int>(values[0]), static_cast<int>(values[1]), static_cast<int>(values[2]), values[3]};
        }

        std::vector<Voxel> readVoxels(const std::string &file)
        {
            const std::string bytes = readFile(file, std::size_t(64) << 20);
            if (bytes.compare(0, 6, "\x93NUMPY") != 0)
                throw Error(file + ": is not a .npy file");
            if (bytes.size() < 12)
                throw Error(file + ": truncated: the file ends within its header");
            const auto byte = [&bytes](std::size_t i)
            {
                return static_cast<unsigned char>(bytes[i]);
            };
            // Version 1 counts the header's bytes in two, later versions in four.
            const bool small = byte(6) == 1;
            const std::size_t begin = small ? 10 : 12;
            const std::size_t length =
                small ? byte(8) | std::size_t(byte(9)) << 8
                      : byte(8) | std::size_t(byte(9)) << 8 | std::size_t(byte(10)) << 16 | std::size_t(byte(11)) << 24;
            if (length > bytes.size() - begin)
                throw Error(file + ": truncated: the file ends within its header");
            const std::string_view header = std::string_view(bytes).substr(begin, length);
            const std::string_view type = headerEntry(file, header, "descr");
            if (type != "'<i8'")
                throw Error(file + ": its numbers are " + inQuotes(type) + "; SurroundOcc occupancy is int64 ('<i8')");
            if (headerEntry(file, header, "fortran_order") != "False")
                throw Error(file + ": is stored column by column; SurroundOcc occupancy is stored row by row");
            const std::size_t rows = rowsOf(file, headerEntry(file, header, "shape"));
            const std::size_t data = begin + length;
            if (bytes.size() - data != rows * 32)
                throw Error(file + (bytes.size() - data < rows * 32 ? ": truncated: " : ": too long: ") +
                            std::to_string(rows) + " voxels take " + std::to_string(rows * 32) +
                            " bytes and the file holds " + std::to_string(bytes.size() - data));
            std::vector<Voxel> voxels;
            voxels.reserve(rows);
            for (std::size_t row = 0; row < rows; ++row)
            {
                std::array<std::int64_t, 4> values;
                for (std::size_t i = 0; i < 4; ++i)
                {
                    std::uint64_t bits = 0;  // assembled byte by byte, independent of the machine's byte order
                    for (std::size_t k = 8; k-- > 0;)
                        bits = bits << 8 | byte(data + row * 32 + i * 8 + k);
                    values[i] = static_cast<std::int64_t>(bits);
                }
                voxels.push_back(checkedVoxel(file, row, values));
            }
            return voxels;
        }

        /** Lowest layer of ground in every column; -1 if there is none. */
        using GroundMap = std::vector<int>;

        std::size_t cellIndex(int x, int y)
        {
            return static_cast<std::size_t>(y) * SIDE + static_cast<std::size_t>(x);
        }

        GroundMap groundOf(const std::vector<Voxel> &voxels)
        {
            GroundMap ground(std::size_t(SIDE) * SIDE, -1);
            for (const Voxel &voxel : voxels)
            {
                int &lowest = ground[cellIndex(voxel.x, voxel.y)];
                if ((isDrivable(voxel.label) || isOffRoad(voxel.label)) && (lowest < 0 || voxel.z < lowest))
                    lowest = voxel.z;
            }
            return ground;
        }

        /** Ground layer at a column or, if unknown, that of the nearest column with known ground; 0 if there is none.
            Ties select the first column, row by row. */
        int groundAt(const GroundMap &ground, int x, int y)
        {
            int best = 0, bestDistance = 2 * SIDE * SIDE, bestRow = 0, bestColumn = 0;
            // Square rings of growing size; a ring cannot hold anything nearer than its own half side.
            for (int ring = 0; ring < SIDE && ring * ring <= bestDistance; ++ring)
                for (int row = std::max(0, y - ring); row <= std::min(SIDE - 1, y + ring); ++row)
                {
                    const int step = row == y - ring || row == y + ring ? 1 : std::max(1, 2 * ring);
                    for (int column = x - ring; column <= x + ring; column += step)
                    {
                        if (column < 0 || column >= SIDE || ground[cellIndex(column, row)] < 0)
                            continue;
                        const int distance = (column - x) * (column - x) + (row - y) * (row - y);
                        if (std::tie(distance, row, column) >= std::tie(bestDistance, bestRow, bestColumn))
                            continue;
                        std::tie(bestDistance, bestRow, bestColumn) = std::tie(distance, row, column);
                        best = ground[cellIndex(column, row)];
                    }
                }
            return best;
        }

        OccupancyGrid classify(const std::vector<Voxel> &voxels)
        {
            OccupancyGrid grid(SIDE, SIDE, CELL, {CORNER, CORNER, 0.0}, Cell::Unknown);
            const auto set = [&grid](const Voxel &voxel, Cell cell)
            {
                grid.set(static_cast<std::size_t>(voxel.x), static_cast<std::size_t>(voxel.y), cell);
            };
            // From the weakest evidence to the strongest.
            for (const Voxel &voxel : voxels)
                if (isOffRoad(voxel.label))
                    set(voxel, Cell::Occupied);
            for (const Voxel &voxel : voxels)
                if (isDrivable(voxel.label))
                    set(voxel, Cell::Free);
            const GroundMap ground = groundOf(voxels);
            for (const Voxel &voxel : voxels)
            {
                if (!isObstacle(voxel.label))
                    continue;
                const int height = voxel.z - groundAt(ground, voxel.x, voxel.y);
                if (height >= 0 && height <= CAR_LAYERS)
                    set(voxel, Cell::Occupied);
            }
            return grid;
        }

        std::size_t freeNeighbours(const OccupancyGrid &grid, std::size_t x, std::size_t y)
        {
            std::size_t count = 0;
            for (std::size_t row = y - std::min<std::size_t>(y, 1); row <= std::min(y + 1, grid.height() - 1); ++row)
                for (std::size_t column = x - std::min<std::size_t>(x, 1); column <= std::min(x + 1, grid.width() - 1);
                     ++column)
                    count += grid.at(column, row) == Cell::Free;
            return count;
        }

        /** Sets unknown cells that are mostly surrounded by free ones to free, because the rings of a lidar leave gaps
            on the road. */
        void closeGaps(OccupancyGrid &grid)
        {
            const OccupancyGrid before = grid;
            for (std::size_t y = 0; y < grid.height(); ++y)
                for (std::size_t x = 0; x < grid.width(); ++x)
                    if (before.at(x, y) == Cell::Unknown && freeNeighbours(before, x, y) >= 5)
                        grid.set(x, y, Cell::Free);
        }

        /** Sets the cells under the car to free, which its lidar cannot observe. */
        void clearOwnCar(OccupancyGrid &grid)
        {
            const Vehicle car;
            for (std::size_t y = 0; y < grid.height(); ++y)
                for (std::size_t x = 0; x < grid.width(); ++x)
                {
                    const double across = CORNER + (static_cast<double>(x) + 0.5) * CELL;
                    const double along = CORNER + (static_cast<double>(y) + 0.5) * CELL + AXLE_BEHIND_LIDAR;
                    if (grid.at(x, y) == Cell::Unknown && std::abs(across) <= 0.5 * car.width &&
                        along >= -car.rearOverhang && along <= car.wheelbase + car.frontOverhang)
                        grid.set(x, y, Cell::Free);
                }
        }
    }  // namespace

    OccupancyGrid readSurroundOcc(const std::string &npyFile)
    {
        OccupancyGrid grid = classify(readVoxels(npyFile));
        for (int pass = 0; pass < 3; ++pass)
            closeGaps(grid);
        clearOwnCar(grid);
        return grid;
    }
}  // namespace parking
