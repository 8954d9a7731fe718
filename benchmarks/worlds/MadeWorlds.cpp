#include "benchmarks/worlds/MadeWorlds.h"

#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/text/NearestName.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace parking_test
{
    using namespace parking;

    namespace
    {
        using Polygons = std::vector<Polygon>;

        constexpr double MILLIMETRES = 1e3;  // in a metre
        constexpr double SLOT_LENGTH = 5.0;  // width of a perpendicular slot in metres
        constexpr double WALL = 0.3;         // metres

        Polygon wall(double left, double low, double right, double high)
        {
            return {{left, low}, {right, low}, {right, high}, {left, high}};
        }

        /** Walls round a box, on its outside. */
        void surround(Polygons &world, double left, double low, double right, double high)
        {
            world.push_back(wall(left - WALL, low - WALL, right + WALL, low));
            world.push_back(wall(left - WALL, high, right + WALL, high + WALL));
            world.push_back(wall(left - WALL, low, left, high));
            world.push_back(wall(right, low, right + WALL, high));
        }

        /** A parked car with usual tolerances: off the middle and at a small angle. */
        void park(Polygons &world, Random &random, const Pose &middle)
        {
            static const std::vector<std::string> names = vehicleNames();
            const Vehicle car = vehicleByName(names[random.index(names.size())]);
            const double along = random.between(-0.15, 0.15), across = random.between(-0.12, 0.12);
            world.push_back(
                rectangle(car.length(), car.width, compose(middle, {along, across, random.between(-0.03, 0.03)})));
        }

        /** Cars side by side along x, facing up or down; each slot is taken with a probability. */
        void row(Polygons &world, Random &random, double left, double right, double y, double slotWidth, double taken,
                 double lean)
        {
            for (double x = left + 0.5 * slotWidth; x + 0.5 * slotWidth <= right; x += slotWidth)
                if (random.chance(taken))
                    park(world, random, {x, y, 0.5 * PI + lean});
        }

        Polygons parkedRows(Random &random)
        {
            Polygons world;
            const double width = random.between(40.0, 90.0), end = random.between(6.0, 9.0);
            const double aisle = random.between(5.2, 7.0), slot = random.between(2.4, 2.8);
            const double taken = random.between(0.5, 0.95), lean = random.chance(0.3) ? random.between(-0.5, 0.5) : 0.0;
            double y = 0.5 * SLOT_LENGTH;
            row(world, random, 0.0, width, y, slot, taken, lean);
            for (std::size_t aisles = 1 + random.index(3); aisles > 0; --aisles)
            {
                y += SLOT_LENGTH + aisle;
                row(world, random, aisles > 1 ? end : 0.0, aisles > 1 ? width - end : width, y, slot, taken, lean);
                if (aisles > 1)
                    row(world, random, end, width - end, y += SLOT_LENGTH, slot, taken, lean);
            }
            surround(world, 0.0, 0.0, width, y + 0.5 * SLOT_LENGTH);
            return world;
        }

        Polygons streets(Random &random)
        {
            Polygons world;
            const std::size_t columns = 2 + random.index(3), rows = 2 + random.index(2);
            std::vector<double> widths, heights, roadsX, roadsY;
            for (std::size_t i = 0; i <= columns; ++i)
                widths.push_back(random.between(22.0, 60.0)), roadsX.push_back(random.between(6.5, 11.0));
            for (std::size_t i = 0; i <= rows; ++i)
                heights.push_back(random.between(22.0, 60.0)), roadsY.push_back(random.between(6.5, 11.0));
            const double crowded = random.between(0.2, 0.8);
            double y = 0.0;
            for (std::size_t i = 0; i < rows; y += heights[i] + roadsY[i], ++i)
            {
                double x = 0.0;
                for (std::size_t k = 0; k < columns; x += widths[k] + roadsX[k], ++k)
                {
                    const double right = x + widths[k], high = y + heights[i];
                    if (random.chance(0.7))
                        world.push_back(wall(x, y, right, high));
                    else
                    {
                        // A yard that is open to one street.
                        const double depth = random.between(0.3, 0.7) * heights[i], gate = random.between(7.0, 14.0);
                        const double at = random.between(x + 3.0, right - 3.0 - gate);
                        world.push_back({{x, y},
                                         {at, y},
                                         {at, y + depth},
                                         {at + gate, y + depth},
                                         {at + gate, y},
                                         {right, y},
                                         {right, high},
                                         {x, high}});
                    }
                    // Along the upper and the right kerb, where the street stays wide enough.
                    for (double s = 6.0; s < widths[k] - 6.0; s += random.between(5.6, 8.0))
                        if (roadsY[i] > 7.5 && random.chance(crowded))
                            park(world, random, {x + s, high + 1.3, 0.0});
                    for (double s = 6.0; s < heights[i] - 6.0; s += random.between(5.6, 8.0))
                        if (roadsX[k] > 7.5 && random.chance(crowded))
                            park(world, random, {right + 1.3, y + s, 0.5 * PI});
                }
            }
            return world;
        }

        Polygons multiStorey(Random &random)
        {
            Polygons world;
            const double width = random.between(42.0, 70.0), lane = random.between(5.4, 6.5);
            const double slot = random.between(2.4, 2.7), taken = random.between(0.6, 0.95);
            const double deck = 4.0 * SLOT_LENGTH + 2.0 * lane, ramp = random.between(3.4, 4.5);
            const double climb = random.between(12.0, 20.0);
            const std::size_t decks = 2 + random.index(3);
            for (std::size_t i = 0; i < decks; ++i)
            {
                const double y = static_cast<double>(i) * (deck + climb);
                // The ramps up begin at alternate ends, so that a route crosses every deck.
                const auto rampAt = [&](std::size_t below)
                {
                    return below % 2 == 0 ? width - 1.0 - ramp : 1.0;
                };
                const double clear = ramp + 4.0;
                const double lowLeft = i > 0 && i % 2 == 0 ? clear : 0.0;
                const double lowRight = i % 2 == 1 ? width - clear : width;
                const double highLeft = i + 1 < decks && i % 2 == 1 ? clear : 0.0;
                const double highRight = i + 1 < decks && i % 2 == 0 ? width - clear : width;
                row(world, random, lowLeft, lowRight, y + 0.5 * SLOT_LENGTH, slot, taken, 0.0);
                for (const double middle : {1.5 * SLOT_LENGTH + lane, 2.5 * SLOT_LENGTH + lane})
                    row(world, random, lane + 0.5, width - lane - 0.5, y + middle, slot, taken, 0.0);
                row(world, random, highLeft, highRight, y + deck - 0.5 * SLOT_LENGTH, slot, taken, 0.0);
                for (double x = lane + 2.0; x < width - lane - 2.0; x += 3.0 * slot)
                    world.push_back(rectangle(0.4, 0.4, {x, y + 0.5 * deck, 0.0}));
                world.push_back(wall(-WALL, y, 0.0, y + deck));
                world.push_back(wall(width, y, width + WALL, y + deck));
                if (i == 0)
                    world.push_back(wall(0.0, y - WALL, width, y));
                if (i + 1 == decks)
                {
                    world.push_back(wall(0.0, y + deck, width, y + deck + WALL));
                    continue;
                }
                // The area beside the ramp is blocked.
                const double from = rampAt(i);
                world.push_back(wall(-WALL, y + deck, from, y + deck + climb));
                world.push_back(wall(from + ramp, y + deck, width + WALL, y + deck + climb));
            }
            return world;
        }

        Polygons clutter(Random &random)
        {
            Polygons world;
            const double size = random.between(35.0, 75.0);
            const auto count = static_cast<std::size_t>(size * size * random.between(0.008, 0.03));
            for (std::size_t i = 0; i < count; ++i)
            {
                const double x = random.between(0.0, size), y = random.between(0.0, size);
                if (random.chance(0.3))
                    world.push_back(rectangle(0.12, 0.12, {x, y, 0.0}));
                else if (random.chance(0.5))
                {
                    const double yaw = random.between(-PI, PI), length = random.between(0.3, 3.0);
                    world.push_back(rectangle(length, random.between(0.2, 1.5), {x, y, yaw}));
                }
                else
                    world.push_back(star(random, x, y, random.between(0.2, 1.6)));
            }
            surround(world, 0.0, 0.0, size, size);
            return world;
        }

        Polygons shapes(Random &random)
        {
            Polygons world;
            const double size = random.between(60.0, 120.0);
            for (std::size_t count = 7 + random.index(14); count > 0; --count)
            {
                const double x = random.between(0.0, size), y = random.between(0.0, size);
                world.push_back(star(random, x, y, random.between(2.5, 0.14 * size)));
            }
            return world;
        }

        Polygons largeLot(Random &random)
        {
            Polygons world;
            const double width = random.between(150.0, 250.0), cross = random.between(6.0, 9.0);
            const double aisle = random.between(5.8, 7.5), slot = random.between(2.45, 2.75);
            const double taken = random.between(0.3, 0.9);
            const std::size_t modules = 5 + random.index(5);
            double y = 0.0;
            for (std::size_t i = 0; i < modules; ++i, y += 2.0 * SLOT_LENGTH + aisle)
                // Two halves with a lane across in the middle; an island with a lamp at each end of a double row.
                for (const double left : {cross, 0.5 * width + 0.5 * cross})
                {
                    const double right = left + 0.5 * width - 1.5 * cross;
                    row(world, random, left + 2.0, right - 2.0, y + aisle + 0.5 * SLOT_LENGTH, slot, taken, 0.0);
                    row(world, random, left + 2.0, right - 2.0, y + aisle + 1.5 * SLOT_LENGTH, slot, taken, 0.0);
                    for (const double x : {left + 0.8, right - 0.8})
                        world.push_back(rectangle(1.4, random.between(3.0, 9.0), {x, y + aisle + SLOT_LENGTH, 0.0}));
                }
            surround(world, 0.0, 0.0, width, y + aisle);
            return world;
        }

        Polygons angledLot(Random &random)
        {
            Polygons world;
            const double width = random.between(50.0, 90.0), cross = random.between(6.0, 8.0);
            const double lean = random.between(PI / 4.0, PI / 3.0), slot = random.between(2.5, 2.8) / std::sin(lean);
            const double aisle = random.between(3.8, 5.0), taken = random.between(0.5, 0.9);
            // A slot across its aisle, with the corners of the car in it.
            const double depth = SLOT_LENGTH * std::sin(lean) + 2.0 * std::cos(lean);
            const std::size_t aisles = 2 + random.index(3);
            double y = 0.0;
            for (std::size_t i = 0; i < aisles; ++i, y += 2.0 * depth + aisle)
                // Both rows lean towards the direction of the one-way aisle.
                for (const bool upper : {false, true})
                    row(world, random, cross + 0.5 * slot, width - cross - 0.5 * slot,
                        y + (upper ? 1.5 * depth + aisle : 0.5 * depth), slot, taken,
                        (i % 2 == 0) == upper ? lean - 0.5 * PI : 0.5 * PI - lean);
            surround(world, 0.0, 0.0, width, y);
            return world;
        }

        Polygons carelessLot(Random &random)
        {
            Polygons world;
            const double width = random.between(45.0, 75.0), aisle = random.between(4.2, 5.5);
            const double askew = random.between(0.03, 0.12), taken = random.between(0.6, 0.9);
            double y = 0.5 * SLOT_LENGTH;
            for (std::size_t rows = 3 + random.index(3); rows > 0; --rows, y += SLOT_LENGTH + aisle)
                for (double x = 2.0; x < width - 2.0; x += random.between(2.4, 3.1))
                    if (random.chance(taken))
                        park(world, random,
                             {x, y + random.between(-0.6, 0.6), 0.5 * PI + askew * random.between(-2.0, 2.0)});
            const double height = y - aisle - 0.5 * SLOT_LENGTH;
            for (std::size_t count = 3 + random.index(5); count > 0; --count)
            {
                const double x = random.between(5.0, width - 5.0);
                park(world, random, {x, random.between(5.0, height - 5.0), random.between(-PI, PI)});
            }
            surround(world, 0.0, 0.0, width, height);
            return world;
        }

        /** Lanes between walls that connect all places, mostly by a single route. */
        Polygons maze(Random &random)
        {
            const std::size_t size = 5 + random.index(4);
            const double lane = random.between(6.0, 9.0), loops = random.between(0.05, 0.2), half = 0.5 * WALL;
            const auto side = static_cast<int>(size);
            std::vector<bool> seen(size * size, false);
            // Whether a place is open towards its neighbour on the right, and above.
            std::vector<std::array<bool, 2>> open(size * size, {false, false});
            const auto at = [side](int x, int y)
            {
                return static_cast<std::size_t>(y * side + x);
            };
            std::vector<std::pair<int, int>> route{{0, 0}};
            seen[0] = true;
            while (!route.empty())
            {
                const auto [x, y] = route.back();
                std::vector<std::pair<int, int>> next;
                for (const auto &[dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
                    if (x + dx >= 0 && y + dy >= 0 && x + dx < side && y + dy < side && !seen[at(x + dx, y + dy)])
                        next.emplace_back(dx, dy);
                if (next.empty())
                {
                    route.pop_back();
                    continue;
                }
                const auto [dx, dy] = next[random.index(next.size())];
                open[at(x + std::min(dx, 0), y + std::min(dy, 0))][dx == 0 ? 1 : 0] = true;
                seen[at(x + dx, y + dy)] = true;
                route.emplace_back(x + dx, y + dy);
            }
            Polygons world;
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                {
                    const double right = (x + 1) * lane, high = (y + 1) * lane;
                    if (x + 1 < side && !open[at(x, y)][0] && !random.chance(loops))
                        world.push_back(wall(right - half, y * lane - half, right + half, high + half));
                    if (y + 1 < side && !open[at(x, y)][1] && !random.chance(loops))
                        world.push_back(wall(x * lane - half, high - half, right + half, high + half));
                }
            surround(world, 0.0, 0.0, side * lane, side * lane);
            return world;
        }

        const std::vector<std::pair<std::string, std::function<Polygons(Random &)>>> KINDS{
            {"parked_rows", parkedRows},
            {"streets", streets},
            {"multi_storey", multiStorey},
            {"clutter", clutter},
            {"shapes", shapes},
            {"large_lot", largeLot},
            {"angled_lot", angledLot},
            {"careless_lot", carelessLot},
            {"maze", maze}};
    }  // namespace

    std::vector<std::string> worldKinds()
    {
        std::vector<std::string> names;
        for (const auto &[name, make] : KINDS)
            names.push_back(name);
        return names;
    }

    std::vector<Polygon> madeWorld(const std::string &kind, const std::string &seed)
    {
        for (const auto &[name, make] : KINDS)
            if (name == kind)
            {
                Random random(seedOf(seed));
                std::vector<Polygon> world = make(random);
                for (Polygon &polygon : world)
                    for (Eigen::Vector2d &corner : polygon)
                        corner = (corner * MILLIMETRES).array().round().matrix() / MILLIMETRES;
                return world;
            }
        throw Error(unknownName("kind of world", kind, worldKinds()));
    }
}  // namespace parking_test
