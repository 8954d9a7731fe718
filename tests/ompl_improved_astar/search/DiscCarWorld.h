#pragma once

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "parking_geometry/Box.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace parking_test
{
    using parking::Box;

    /** \brief The world of the search's tests: a car made of discs along its axis, among boxes inside of a box.

        Distances are exact and simple, so that this world is its own judge; nothing of the library is in it. */
    class DiscCarWorld : public parking::search::MotionEnvironment
    {
    public:
        explicit DiscCarWorld(const Box &insideOf, std::vector<Box> obstacles = {})
          : inside(insideOf),
            boxes(std::move(obstacles))
        {
        }

        Box inside;
        std::vector<Box> boxes;
        std::vector<double> offsets{0.0, 1.3, 2.6};  ///< of the discs' centres ahead of the rear axle
        double radius{0.95};
        bool tellsRoom{true};
        bool acceptsPaths{true};
        std::uint64_t roomsAsked{0};                                            ///< how often roomAt() was called
        bool tellsBlocked{false};                                               ///< whether proofs can be had
        std::uint64_t questions{0};                                             ///< asked so far, of any kind
        std::uint64_t lastQuestion{std::numeric_limits<std::uint64_t>::max()};  ///< what is asked later is interrupted

        /** \brief Distance from the point to the nearest obstacle; 0 inside of one. */
        double distanceFrom(double x, double y) const
        {
            double least = std::min({x - inside.min.x(), inside.max.x() - x, y - inside.min.y(), inside.max.y() - y});
            for (const Box &box : boxes)
                least = std::min(least, std::hypot(std::max({box.min.x() - x, 0.0, x - box.max.x()}),
                                                   std::max({box.min.y() - y, 0.0, y - box.max.y()})));
            return std::max(0.0, least);
        }

        /** \brief Distance between the car and the obstacles; negative when they overlap. */
        double gap(const parking::Pose &pose) const
        {
            double least = std::numeric_limits<double>::infinity();
            for (const double offset : offsets)
                least = std::min(
                    least, distanceFrom(pose.x + offset * std::cos(pose.yaw), pose.y + offset * std::sin(pose.yaw)));
            return least - radius;
        }

        bool isFree(const parking::Pose &pose) override
        {
            return isAnswered() && gap(pose) > 0.0;
        }

        bool keeps(const parking::Pose &pose, double clearance) override
        {
            return isAnswered() && gap(pose) >= clearance;
        }

        void freeLengths(const parking::Pose &from, const parking::Arc *arcs, std::size_t count, double clearance,
                         double *lengths) override
        {
            if (!isAnswered())
            {
                std::fill(lengths, lengths + count, 0.0);
                return;
            }
            double farthest = 0.0;
            for (const double offset : offsets)
                farthest = std::max(farthest, std::abs(offset));
            for (std::size_t i = 0; i < count; ++i)
            {
                const auto [curvature, length] = arcs[i];
                const double whole = std::abs(length), speed = std::hypot(1.0, farthest * curvature);
                const auto spare = [&, curvature = curvature, length = length](double driven)
                {
                    return gap(advance(from, curvature, std::copysign(driven, length))) - clearance;
                };
                double driven = 0.0, room = 0.0;
                while (driven < whole && (room = spare(driven)) >= 1e-4)
                    driven += room / speed;
                const bool isWhole = driven >= whole && spare(whole) >= 1e-4;
                lengths[i] = isWhole ? whole : std::max(0.0, std::min(driven, whole) - 1e-6);
            }
        }

        parking::Box bounds() const override
        {
            return inside;
        }

        bool isMotionFree(const parking::Pose & /*from*/, const parking::Pose &to) override
        {
            return isFree(to);  // cars do not ask
        }

        double roomAt(double x, double y) override
        {
            ++roomsAsked;
            ++questions;
            return tellsRoom ? distanceFrom(x, y) : std::numeric_limits<double>::infinity();
        }

        bool acceptPath(const parking::Path & /*path*/) override
        {
            return acceptsPaths;
        }

        bool wasInterrupted() const override
        {
            return questions > lastQuestion;
        }

        parking::search::BlockedHeadings blockedHeadings(double side, int headings) override
        {
            if (!tellsBlocked)
                return {};
            return [this, side, headings](double x, double y)
            {
                // The middle is anywhere in the cell, the heading anywhere in its part of the circle.
                const double middle = 0.5 * (offsets.front() + offsets.back()), part = 2.0 * parking::PI / headings;
                parking::search::HeadingSet blocked{};
                for (int i = 0; i < headings; ++i)
                    for (const double offset : offsets)
                    {
                        const double yaw = (i + 0.5) * part - parking::PI, ahead = offset - middle;
                        const double slack = 0.5 * std::sqrt(2.0) * side + 0.5 * part * std::abs(ahead);
                        if (distanceFrom(x + ahead * std::cos(yaw), y + ahead * std::sin(yaw)) + slack <= radius)
                            blocked[static_cast<std::size_t>(i) / 64] |= std::uint64_t{1} << (i % 64);
                    }
                return blocked;
            };
        }

        parking::Pose freePose(Random &random)
        {
            for (;;)
            {
                const double x = random.between(inside.min.x(), inside.max.x()),
                             y = random.between(inside.min.y(), inside.max.y());
                const parking::Pose pose{x, y, random.between(-parking::PI, parking::PI)};
                if (gap(pose) > 0.02)
                    return pose;
            }
        }

    private:
        bool isAnswered()
        {
            return ++questions <= lastQuestion;
        }
    };

    /** \brief A square field with boxes thrown into it. \param half metres: of its side */
    inline DiscCarWorld randomField(std::uint64_t seed, std::uint32_t count = 10, double half = 12.0)
    {
        Random random(seed);
        DiscCarWorld world({{-half, -half}, {half, half}});
        for (std::uint32_t i = 0; i < count; ++i)
        {
            const double x = random.between(-half, half), y = random.between(-half, half);
            const double w = random.between(0.2, 3.0), h = random.between(0.2, 3.0);
            world.boxes.push_back({{x - w, y - h}, {x + w, y + h}});
        }
        return world;
    }

    /** \brief Two rooms of 12 m with a doorway of the given width between them; 0: none. */
    inline DiscCarWorld twoRooms(double door)
    {
        DiscCarWorld world({{-12.0, -6.0}, {12.0, 6.0}});
        world.boxes.push_back({{-0.5, -6.0}, {0.5, -0.5 * door}});
        world.boxes.push_back({{-0.5, 0.5 * door}, {0.5, 6.0}});
        return world;
    }

    /** \brief A slot of the given width between blocks, off an aisle of 6 m; the car parks at (0, 1) heading out. */
    inline DiscCarWorld slot(double width)
    {
        DiscCarWorld world({{-12.0, -1.0}, {12.0, 11.0}});
        world.boxes.push_back({{-12.0, -1.0}, {-0.5 * width, 5.0}});
        world.boxes.push_back({{0.5 * width, -1.0}, {12.0, 5.0}});
        return world;
    }

    /** \brief The least distance between the car and the obstacles along a path, looked at every centimetre. */
    inline double leastGap(const DiscCarWorld &world, const parking::Path &path)
    {
        double least = world.gap(path.start);
        for (const parking::PathState &state : path.sample(0.01))
            least = std::min(least, world.gap(state.pose));
        return least;
    }

    /** \brief What is wrong with a path, or nothing: curvature, direction, ends, collisions (every 2 mm). */
    inline std::string faultOf(const parking::Path &path, const DiscCarWorld &world,
                               const std::vector<parking::Pose> &starts, const std::vector<parking::Pose> &goals,
                               double turningRadius, bool forwardOnly = false)
    {
        const auto isOneOf = [](const parking::Pose &pose, const std::vector<parking::Pose> &poses, double tolerance)
        {
            return std::any_of(poses.begin(), poses.end(),
                               [&](const parking::Pose &each) { return isSamePose(pose, each, tolerance); });
        };
        if (!isOneOf(path.start, starts, 0.0))
            return "does not begin at a start";
        if (!isOneOf(path.end(), goals, 1e-6))
            return "does not end at a goal";
        parking::Pose pose = path.start;
        for (const parking::PathPiece &segment : path.pieces)
        {
            if (std::abs(segment.curvature) > (1.0 + 1e-9) / turningRadius)
                return "turns too sharply";
            if (forwardOnly && segment.length < 0.0)
                return "drives in reverse";
            const double steps = std::ceil(std::abs(segment.length) / 0.002);
            for (double i = 0.0; i <= steps; i += 1.0)
                if (!(world.gap(advance(pose, segment.curvature, segment.length * i / std::max(1.0, steps))) > 0.0))
                    return "collides";
            pose = advance(pose, segment.curvature, segment.length);
        }
        return {};
    }
}  // namespace parking_test
