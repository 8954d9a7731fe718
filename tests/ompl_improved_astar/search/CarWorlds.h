#pragma once

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "parking_geometry/Box.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>
#include <string>
#include <unordered_set>
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

    constexpr double TURNING_RADIUS = 3.0, UNREACHED = std::numeric_limits<double>::infinity();

    /** \brief A world, and where a car shall go in it. */
    struct CarProblem
    {
        DiscCarWorld world;
        std::vector<parking::Pose> starts, goals;
        bool forwardOnly{false};
        std::uint8_t maxCusps{parking::search::ANY_CUSPS};

        parking::search::CarInSpace car() const
        {
            parking::search::CarInSpace car;
            car.turningRadius = TURNING_RADIUS;
            car.inscribedRadius = car.bodyRadius = world.radius;
            car.bounds = world.inside;
            car.forwardOnly = forwardOnly;
            car.maxCusps = maxCusps;
            car.centreOffset = 0.5 * (world.offsets.front() + world.offsets.back());
            return car;
        }

        /** \brief Begins the query of a Search or a PathPlanner; the problem must outlive it. */
        template <class Planner>
        void begin(Planner &planner, const parking::PlannerParameters &parameters)
        {
            planner.begin(world, parameters, car());
            for (const parking::Pose &start : starts)
                planner.addStart(start);
            for (const parking::Pose &goal : goals)
                planner.addGoal(goal);
        }

        /** \brief What is wrong with a path from a start to a goal. */
        std::string faultOf(const parking::Path &path) const
        {
            if (maxCusps < parking::search::ANY_CUSPS && path.cusps() > maxCusps)
                return "changes direction too often";
            return parking_test::faultOf(path, world, starts, goals, TURNING_RADIUS, forwardOnly);
        }

        /** \brief What is wrong with a path from a start to anywhere. */
        std::string faultTowards(const parking::Path &path) const
        {
            return parking_test::faultOf(path, world, starts, {path.end()}, TURNING_RADIUS);
        }
    };

    struct NamedProblem
    {
        std::string name;
        CarProblem problem;
        bool isSolvable;
    };

    /** \brief The defaults, without a preferred clearance: costs then depend on no sampling. */
    inline parking::PlannerParameters carParameters()
    {
        parking::PlannerParameters parameters;
        parameters.preferredClearance = 0.0;
        return parameters;
    }

    /** \brief The same with cells so fine that a search without a path soon fills its memory. */
    inline parking::PlannerParameters hungryParameters()
    {
        parking::PlannerParameters parameters = carParameters();
        parameters.obstacleHeuristic = false;
        parameters.xyResolution = 0.01;
        parameters.headingBins = 720;
        parameters.maxMemoryMb = 16;
        return parameters;
    }

    /** \brief Stops what is polled more often than that, and always from then on. */
    inline parking::search::StopFunction afterPolls(int count)
    {
        return [count, polls = 0]() mutable
        {
            return ++polls > count;
        };
    }

    /** \brief The same; counts the questions asked of the world between two polls, and once it has stopped. */
    struct MeasuredStop
    {
        const DiscCarWorld &world;
        parking::search::StopFunction stop;
        bool isStopped{false};
        std::uint64_t before{world.questions}, most{0};

        bool operator()()
        {
            most = maxQuestions();
            before = isStopped ? before : world.questions;
            return isStopped = stop();
        }

        std::uint64_t maxQuestions() const
        {
            return std::max(most, world.questions - before);
        }
    };

    /** \brief Are these the same to the last bit? */
    inline bool isSamePath(const parking::Path &a, const parking::Path &b)
    {
        const auto &one = a.pieces, &other = b.pieces;
        return isSamePose(a.start, b.start, 0.0) &&
               std::equal(one.begin(), one.end(), other.begin(), other.end(),
                          [](const auto &c, const auto &d)
                          { return c.length == d.length && c.curvature == d.curvature; });
    }

    inline double metresInReverse(const parking::Path &path)
    {
        double metres = 0.0;
        for (const parking::PathPiece &piece : path.pieces)
            metres += std::max(0.0, -piece.length);
        return metres;
    }

    /** \brief Metres driven nearer to obstacles than \e clearance, sampled finely. */
    inline double metresNearer(const DiscCarWorld &world, const parking::Path &path, double clearance)
    {
        constexpr double STEP = 0.01;
        double metres = 0.0;
        for (const parking::PathState &state : path.sample(STEP))
            metres += world.gap(state.pose) < clearance ? STEP : 0.0;
        return metres;
    }

    /** \brief From somewhere in a field to somewhere else. */
    inline CarProblem randomProblem(std::uint64_t seed, std::uint32_t boxes = 10, double half = 12.0)
    {
        CarProblem problem{randomField(seed, boxes, half), {}, {}};
        Random random(seed + 1000);
        problem.starts.push_back(problem.world.freePose(random));
        problem.goals.push_back(problem.world.freePose(random));
        return problem;
    }

    /** \brief Walls that have to be driven round, one after the other. */
    inline CarProblem maze(int walls)
    {
        CarProblem problem{DiscCarWorld({{-20.0, -6.0}, {20.0, 6.0}}), {{-18.0, 0.0, 0.0}}, {{16.0, 0.0, 0.0}}};
        problem.world.boxes.push_back({{-1.0, -2.0}, {1.0, 2.0}});
        for (int i = 0; i < walls; ++i)
        {
            const double x = -12.0 + 8.0 * i;
            problem.world.boxes.push_back(i % 2 == 0 ? Box{{x, -6.0}, {x + 0.4, 1.5}} : Box{{x, -1.5}, {x + 0.4, 6.0}});
        }
        return problem;
    }

    /** \brief The goal is in a room without a door. */
    inline CarProblem walledIn()
    {
        CarProblem problem{DiscCarWorld({{-30.0, -30.0}, {30.0, 30.0}}), {{0.0, 0.0, 0.0}}, {{17.0, 17.0, 0.0}}};
        problem.world.boxes = {{{10.0, 10.0}, {25.0, 10.5}},
                               {{10.0, 25.0}, {25.0, 25.5}},
                               {{10.0, 10.0}, {10.5, 25.0}},
                               {{25.0, 10.0}, {25.5, 25.5}}};
        return problem;
    }

    /** \brief Two lanes that meet at a corner, which wide lanes let the car pass and narrow ones only a disc. */
    inline CarProblem corner(double width)
    {
        DiscCarWorld world({{-8.0, 0.0}, {width, 8.0 + width}}, {{{-8.0, width}, {0.0, 8.0 + width}}});
        return {world, {{-6.0, 0.5 * width, 0.0}}, {{0.5 * width, 4.0 + width, 0.5 * parking::PI}}};
    }

    inline std::vector<NamedProblem> namedProblems()
    {
        using parking::PI;
        // 15 cm on each side, and an aisle not much longer than the car; 30 cm at each end, parallel to the aisle.
        CarProblem tight{slot(2.2), {{-8.0, 8.0, 0.0}}, {{0.0, 0.5, 0.5 * PI}}};
        tight.world.boxes.push_back({{-12.0, 9.5}, {12.0, 11.0}});
        CarProblem parallel{DiscCarWorld({{-12.0, -2.0}, {12.0, 6.0}}), {{-8.0, 3.0, 0.0}}, {{0.0, 0.0, 0.0}}};
        parallel.world.boxes = {
            {{-12.0, -2.0}, {-1.25, 1.0}}, {{3.85, -2.0}, {12.0, 1.0}}, {{-12.0, -2.0}, {12.0, -1.0}}};
        return {{"open", {DiscCarWorld({{-12.0, -12.0}, {12.0, 12.0}}), {{-5.0, 0.0, 0.0}}, {{5.0, 3.0, 2.0}}}, true},
                {"doorway", {twoRooms(2.6), {{-9.0, 3.0, 0.0}}, {{6.0, -3.0, PI}}}, true},
                {"closed door", {twoRooms(0.0), {{-9.0, 0.0, 0.0}}, {{6.0, 0.0, 0.0}}}, false},
                {"narrow door", {twoRooms(1.8), {{-9.0, 3.0, 0.0}}, {{6.0, -3.0, PI}}}, false},
                {"slot, nose out", {slot(2.6), {{-8.0, 8.0, 0.0}}, {{0.0, 0.5, 0.5 * PI}}}, true},
                {"slot, nose in", {slot(2.6), {{-8.0, 8.0, 0.0}}, {{0.0, 3.2, -0.5 * PI}}}, true},
                {"tight slot", tight, true},
                {"tight parallel slot", parallel, true},
                {"maze", maze(2), true}};
    }

    /** \brief A flood of short motions over a fine lattice: how near to a target the rear axle comes, and a path to it.
     */
    struct Flood
    {
        double nearest{UNREACHED};   ///< metres between the rear axle and the target
        double cheapest{UNREACHED};  ///< cost of the cheapest path found to exactly the target

        /** \brief Nothing of the search is in it. Costs are those without a preferred clearance, all penalties default.

            \param joins whether exact paths are wanted: these end in a free curve to the target */
        Flood(DiscCarWorld world, const parking::Pose &start, const parking::Pose &target, bool joins)
        {
            constexpr double SIDE = 0.3, STEP = 0.45, HEADING = parking::PI / 18.0, REACH = 6.0;
            const parking::ReedsShepp curves(TURNING_RADIUS);
            parking::search::CostModel model;
            model.gearChangePenalty = parking::PlannerParameters().gearChangePenalty;
            model.steeringChangePenalty = parking::PlannerParameters().steeringChangePenalty;
            model.fullLockCurvature = 1.0 / TURNING_RADIUS;
            struct Reached
            {
                double cost;
                parking::Pose pose;
                parking::PathPiece last;
            };
            const auto isCostlier = [](const Reached &a, const Reached &b)
            {
                return a.cost > b.cost;
            };
            const auto cell = [](const parking::Pose &pose)
            {
                const long x = std::lround(pose.x / SIDE), y = std::lround(pose.y / SIDE);
                return ((x + 1000) * 2000 + y + 1000) * 2000 + std::lround(parking::wrapAngle(pose.yaw) / HEADING);
            };
            std::unordered_set<long> settled;
            std::priority_queue<Reached, std::vector<Reached>, decltype(isCostlier)> open(isCostlier);
            open.push({0.0, start, {}});
            std::vector<parking::ReedsSheppCurve> words;
            while (!open.empty() && open.top().cost < cheapest)
            {
                const Reached from = open.top();
                open.pop();
                if (!settled.insert(cell(from.pose)).second)
                    continue;
                nearest = std::min(nearest, positionDistance(from.pose, target));
                if (joins && positionDistance(from.pose, target) < REACH)
                    curves.candidates(from.pose, target, words, std::min(2.0 * REACH, cheapest - from.cost));
                else
                    words.clear();
                for (const parking::ReedsSheppCurve &word : words)
                {
                    const double cost =
                        from.cost + curveCost(model, word, from.last.length != 0.0 ? &from.last : nullptr);
                    parking::Pose pose = from.pose;
                    bool isFree = cost < cheapest;
                    for (std::size_t i = 0; i < word.count && isFree; ++i)
                    {
                        isFree = world.freeLength(pose, word.pieces[i]) >= std::abs(word.pieces[i].length);
                        pose = advance(pose, word.pieces[i]);
                    }
                    cheapest = isFree ? cost : cheapest;
                }
                for (const double steer : {-1.0, 0.0, 1.0})
                    for (const double length : {-STEP, STEP})
                    {
                        const parking::Arc motion{steer / TURNING_RADIUS, length};
                        const parking::Pose next = advance(from.pose, motion);
                        const double cost = from.cost + model.drive(motion) +
                                            (from.last.length != 0.0 ? model.join(from.last, motion) : 0.0);
                        if (cost < cheapest && settled.count(cell(next)) == 0 &&
                            world.freeLength(from.pose, motion) >= STEP)
                            open.push({cost, next, motion});
                    }
            }
        }
    };
}  // namespace parking_test
