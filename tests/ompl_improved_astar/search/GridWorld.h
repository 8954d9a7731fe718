#pragma once

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/Search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>
#include <string>
#include <utility>
#include <vector>

namespace parking_test
{
    /** \brief Square cells of one metre, free or blocked, with a robot that is a point, or two points one behind the
        other so that its heading matters. The outside is blocked. */
    class GridWorld : public parking::search::MotionEnvironment
    {
    public:
        GridWorld(int columnCount, int rowCount)
          : columns(columnCount),
            rows(rowCount),
            blocked(static_cast<std::size_t>(columnCount * rowCount), 0)
        {
        }

        /** \brief Rows from the top down; '#' is blocked. */
        explicit GridWorld(const std::vector<std::string> &picture)
          : GridWorld(static_cast<int>(picture.front().size()), static_cast<int>(picture.size()))
        {
            for (int row = 0; row < rows; ++row)
                for (int column = 0; column < columns; ++column)
                    at(column, row) =
                        picture[static_cast<std::size_t>(rows - 1 - row)][static_cast<std::size_t>(column)] == '#';
        }

        int columns, rows;
        std::vector<char> blocked;
        double nose{0.0};  ///< metres from the robot's point to its second one
        std::uint64_t states{0};
        std::uint64_t motions{0};

        char &at(int column, int row)
        {
            return blocked[static_cast<std::size_t>(row * columns + column)];
        }

        bool isPointFree(double x, double y) const
        {
            const double column = std::floor(x), row = std::floor(y);
            return column >= 0.0 && row >= 0.0 && column < columns && row < rows &&
                   !blocked[static_cast<std::size_t>(row * columns + column)];
        }

        bool isPoseFree(const parking::Pose &pose) const
        {
            return isPointFree(pose.x, pose.y) &&
                   (nose == 0.0 || isPointFree(pose.x + nose * std::cos(pose.yaw), pose.y + nose * std::sin(pose.yaw)));
        }

        /** \brief From the beginning, which is not looked at, to the end. */
        bool isBetweenFree(const parking::Pose &from, const parking::Pose &to) const
        {
            const double turn = parking::wrapAngle(to.yaw - from.yaw);
            const double steps = std::ceil(25.0 * (positionDistance(to, from) + nose * std::abs(turn)));
            for (double i = 1.0; i <= steps; i += 1.0)
            {
                const double t = i / steps;
                if (!isPoseFree({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), from.yaw + t * turn}))
                    return false;
            }
            return true;
        }

        bool isFree(const parking::Pose &pose) override
        {
            ++states;
            return isPoseFree(pose);
        }

        bool isMotionFree(const parking::Pose &from, const parking::Pose &to) override
        {
            ++motions;
            return isBetweenFree(from, to);
        }

        bool headingMatters() const override
        {
            return nose != 0.0;
        }

        parking::Pose freePose(Random &random) const
        {
            for (;;)
            {
                const double x = random.between(0.0, columns), y = random.between(0.0, rows);
                const parking::Pose pose{x, y, random.between(-parking::PI, parking::PI)};
                if (isPoseFree(pose))
                    return pose;
            }
        }

        /** \brief Of the paper's search on this grid; from the start where it is from one side. */
        parking::PlannerParameters parameters() const
        {
            parking::PlannerParameters result;
            result.motionModel = "grid8";
            result.searchFrom = "start";
            result.xyResolution = 1.0;
            return result;
        }

        parking::search::CarInSpace car() const
        {
            parking::search::CarInSpace result;
            result.bounds = bounds();
            return result;
        }

        parking::Box bounds() const override
        {
            return {{0.0, 0.0}, {columns, rows}};
        }

        // What only cars ask.
        bool knowsClearance() const override
        {
            return false;
        }
        void freeLengths(const parking::Pose & /*from*/, const parking::Arc * /*arcs*/, std::size_t count,
                         double /*clearance*/, double *lengths) override
        {
            std::fill(lengths, lengths + count, 0.0);
        }
        double roomAt(double /*x*/, double /*y*/) override
        {
            return std::numeric_limits<double>::infinity();
        }
    };

    inline GridWorld randomGrid(std::uint64_t seed, double density, int side = 16)
    {
        Random random(seed);
        GridWorld world(side, side);
        for (char &cell : world.blocked)
            cell = random.chance(density);
        return world;
    }

    /** \brief The poses where the pieces of a path end; those on centres of cells exactly, so that rounding does not
       push a diagonal step against the corner that it touches. */
    inline std::vector<parking::Pose> posesOf(const parking::Path &path)
    {
        const auto snapped = [](double value)
        {
            const double centre = std::floor(value) + 0.5;
            return std::abs(value - centre) < 1e-9 ? centre : value;
        };
        std::vector<parking::Pose> poses{path.start};
        for (const parking::PathPiece &piece : path.pieces)
        {
            const parking::Pose from = poses.back(), pose = advance(from, piece);
            if (std::abs(piece.turn) > parking::PathPiece::LONGEST_TURN)
                poses.push_back({from.x, from.y, parking::wrapAngle(from.yaw + 0.5 * piece.turn)});
            poses.push_back({snapped(pose.x), snapped(pose.y), parking::wrapAngle(pose.yaw)});
        }
        return poses;
    }

    inline double lengthOf(const std::vector<parking::Pose> &path)
    {
        double length = 0.0;
        for (std::size_t i = 1; i < path.size(); ++i)
            length += positionDistance(path[i], path[i - 1]);
        return length;
    }

    /** \brief What is wrong with a path, or nothing: ends, every state, every motion, turns while moving. */
    inline std::string faultOf(const std::vector<parking::Pose> &path, const GridWorld &world,
                               const parking::Pose &start, const parking::Pose &goal)
    {
        const auto same = [](const parking::Pose &a, const parking::Pose &b)
        {
            return parking::positionDistance(a, b) < 1e-9 && std::abs(parking::wrapAngle(a.yaw - b.yaw)) < 1e-9;
        };
        if (path.size() < 2)
            return "has no two poses";
        if (!same(path.front(), start))
            return "does not begin at the start";
        if (!same(path.back(), goal))
            return "does not end at the goal";
        // Of headings only their rounding is known: what touches exactly may be judged either way.
        GridWorld judge = world;
        judge.nose *= 1.0 - 1e-9;
        for (const parking::Pose &pose : path)
            if (!judge.isPoseFree(pose))
                return "has a pose in an obstacle";
        for (std::size_t i = 1; i < path.size(); ++i)
        {
            if (!judge.isBetweenFree(path[i - 1], path[i]))
                return "has a motion through an obstacle";
            const double dx = path[i].x - path[i - 1].x, dy = path[i].y - path[i - 1].y;
            if (std::hypot(dx, dy) > 1e-9 && (std::abs(parking::wrapAngle(path[i].yaw - std::atan2(dy, dx))) > 1e-9 ||
                                              std::abs(parking::wrapAngle(path[i - 1].yaw - path[i].yaw)) > 1e-9))
                return "does not head where it goes";
        }
        return {};
    }

    /** \brief Dijkstra over the cells, those of start and goal standing for their exact positions; infinite when there
        is no way. For robots whose heading does not matter. */
    inline double shortestByDijkstra(const GridWorld &world, const parking::Pose &start, const parking::Pose &goal,
                                     bool sixteenNeighbours)
    {
        const int reach = sixteenNeighbours ? 2 : 1;
        const auto cellOf = [&](const parking::Pose &pose)
        {
            return static_cast<int>(std::floor(pose.y)) * world.columns + static_cast<int>(std::floor(pose.x));
        };
        const int first = cellOf(start), last = cellOf(goal);
        const auto place = [&](int cell) -> parking::Pose
        {
            if (cell == first)
                return start;
            if (cell == last)
                return goal;
            return {cell % world.columns + 0.5, cell / world.columns + 0.5, 0.0};
        };
        if (first == last)
            return world.isBetweenFree(start, goal) ? positionDistance(start, goal)
                                                    : std::numeric_limits<double>::infinity();
        std::vector<double> settled(world.blocked.size(), -1.0);
        using Item = std::pair<double, int>;
        std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
        open.push({0.0, first});
        while (!open.empty())
        {
            const auto [g, cell] = open.top();
            open.pop();
            if (settled[static_cast<std::size_t>(cell)] >= 0.0)
                continue;
            settled[static_cast<std::size_t>(cell)] = g;
            for (int dr = -reach; dr <= reach; ++dr)
                for (int dc = -reach; dc <= reach; ++dc)
                {
                    const bool single = std::max(std::abs(dr), std::abs(dc)) == 1;
                    const bool knight = std::abs(dr) + std::abs(dc) == 3;
                    const int column = cell % world.columns + dc, row = cell / world.columns + dr;
                    if ((!single && !knight) || column < 0 || row < 0 || column >= world.columns || row >= world.rows)
                        continue;
                    const int next = row * world.columns + column;
                    const parking::Pose a = place(cell), b = place(next);
                    if (world.isPointFree(b.x, b.y) && world.isBetweenFree({a.x, a.y, 0.0}, {b.x, b.y, 0.0}))
                        open.push({g + positionDistance(a, b), next});
                }
        }
        const double found = settled[static_cast<std::size_t>(last)];
        return found < 0.0 ? std::numeric_limits<double>::infinity() : found;
    }
}  // namespace parking_test
