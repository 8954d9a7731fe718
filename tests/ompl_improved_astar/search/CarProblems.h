#pragma once

#include "ompl_improved_astar/search/Search.h"
#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "tests/ompl_improved_astar/AfterAsking.h"
#include "tests/ompl_improved_astar/search/DiscCarWorld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace parking_test
{
    constexpr double TURNING_RADIUS = 3.0;

    struct CarProblem
    {
        DiscCarWorld world;
        std::vector<parking::Pose> starts, goals;

        /** \brief Begins the query of a Search or a PathPlanner; the problem must outlive it. */
        template <class Planner, class Parameters>
        void begin(Planner &planner, const Parameters &parameters)
        {
            planner.begin(world, parameters);
            for (const parking::Pose &start : starts)
                planner.addStart(start);
            for (const parking::Pose &goal : goals)
                planner.addGoal(goal);
        }
    };

    struct NamedProblem
    {
        std::string name;
        CarProblem problem;
        bool solvable;
    };

    struct TargetProblem
    {
        std::string name;
        CarProblem problem;
        parking::Pose target;
    };

    inline parking::search::SearchParameters carParameters()
    {
        parking::search::SearchParameters parameters;
        parameters.turningRadius = TURNING_RADIUS;
        parameters.cost = {0.0, 1.0, 0.1, 0.0, 1.0, 1.0 / TURNING_RADIUS};
        return parameters;
    }

    /** \brief The same for the world of a problem. */
    inline parking::search::SearchParameters parametersIn(const CarProblem &problem)
    {
        parking::search::SearchParameters parameters = carParameters();
        parameters.inscribedRadius = problem.world.radius;
        parameters.bounds = problem.world.inside;
        return parameters;
    }

    /** \brief Of a PathPlanner that knows how large a disc is within the car. */
    inline parking::search::PathPlannerParameters parametersFor(const CarProblem &problem)
    {
        parking::search::PathPlannerParameters parameters;
        parameters.search = carParameters();
        parameters.search.inscribedRadius = problem.world.radius;
        return parameters;
    }

    /** \brief Searches up to the first solution, which must be right where there is one, or up to so many expansions.
     */
    inline bool isSolved(parking::search::Search &search, CarProblem &problem,
                         const parking::search::SearchParameters &parameters, std::uint64_t mostExpansions)
    {
        problem.begin(search, parameters);
        search.run({}, mostExpansions);
        if (!search.hasSolution())
            return false;
        EXPECT_EQ(faultOf(search.bestPath(), problem.world, problem.starts, problem.goals, TURNING_RADIUS,
                          parameters.forwardOnly),
                  "");
        if (!parameters.cost.prefersClearance())  // else it depends on where motions are sampled
        {
            EXPECT_NEAR(search.bestCost(), pathCost(parameters.cost, search.bestPath(), problem.world), 1e-6);
        }
        return true;
    }

    /** \brief From somewhere in that world to somewhere else. */
    inline CarProblem randomProblemIn(const DiscCarWorld &world, std::uint64_t seed)
    {
        CarProblem problem{world, {}, {}};
        Random random(seed);
        problem.starts.push_back(problem.world.freePose(random));
        problem.goals.push_back(problem.world.freePose(random));
        return problem;
    }

    inline CarProblem randomProblem(std::uint64_t seed, std::uint32_t boxes = 10)
    {
        return randomProblemIn(randomField(seed, boxes), seed + 1000);
    }

    /** \brief 15 cm on each side, and an aisle not much longer than the car. */
    inline CarProblem tightSlot()
    {
        CarProblem problem{slot(2.2), {{-8.0, 8.0, 0.0}}, {{0.0, 0.5, 0.5 * parking::PI}}};
        problem.world.boxes.push_back({{-12.0, 9.5}, {12.0, 11.0}});
        return problem;
    }

    /** \brief Parallel to the aisle, 30 cm at each end. */
    inline CarProblem tightParallelSlot()
    {
        CarProblem problem{DiscCarWorld({{-12.0, -2.0}, {12.0, 6.0}}), {{-8.0, 3.0, 0.0}}, {{0.0, 0.0, 0.0}}};
        problem.world.boxes = {
            {{-12.0, -2.0}, {-1.25, 1.0}}, {{3.85, -2.0}, {12.0, 1.0}}, {{-12.0, -2.0}, {12.0, -1.0}}};
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

    inline std::vector<NamedProblem> namedProblems()
    {
        using parking::PI;
        std::vector<NamedProblem> problems{
            {"open", {DiscCarWorld({{-12.0, -12.0}, {12.0, 12.0}}), {{-5.0, 0.0, 0.0}}, {{5.0, 3.0, 2.0}}}, true},
            {"doorway", {twoRooms(2.6), {{-9.0, 3.0, 0.0}}, {{6.0, -3.0, PI}}}, true},
            {"closed door", {twoRooms(0.0), {{-9.0, 0.0, 0.0}}, {{6.0, 0.0, 0.0}}}, false},
            {"slot, nose out", {slot(2.6), {{-8.0, 8.0, 0.0}}, {{0.0, 0.5, 0.5 * PI}}}, true},
            {"slot, nose in", {slot(2.6), {{-8.0, 8.0, 0.0}}, {{0.0, 3.2, -0.5 * PI}}}, true},
            {"tight slot", tightSlot(), true},
            {"maze", maze(2), true}};
        // Too narrow for the body, whatever the rear axle may do.
        problems.push_back({"too narrow", {twoRooms(1.8), {{-9.0, 3.0, 0.0}}, {{6.0, -3.0, PI}}}, false});
        return problems;
    }

    inline std::vector<TargetProblem> targetProblems()
    {
        return {{"open", {DiscCarWorld({{-12.0, -12.0}, {12.0, 12.0}}), {{-5.0, 0.0, 0.0}}, {}}, {6.0, 5.0, 0.0}},
                {"outside", {DiscCarWorld({{-12.0, -12.0}, {12.0, 12.0}}), {{-5.0, 0.0, 0.0}}, {}}, {30.0, 0.0, 0.0}},
                {"closed door", {twoRooms(0.0), {{-9.0, 0.0, 0.0}}, {}}, {6.0, 0.0, 0.0}},
                {"in a block", {slot(3.0), {{-8.0, 8.0, 0.0}}, {}}, {4.0, 2.0, 0.0}},
                {"behind walls", maze(3), {19.9, 0.0, 0.0}}};
    }

    /** \brief How near to \e target the rear axle comes, by flooding a fine lattice with short motions. */
    inline double nearestByFlooding(DiscCarWorld world, const parking::Pose &start, const parking::Pose &target)
    {
        constexpr double SIDE = 0.3, STEP = 0.45, HEADING = parking::PI / 18.0;
        const auto cell = [](const parking::Pose &pose)
        {
            return std::tuple{std::lround(pose.x / SIDE), std::lround(pose.y / SIDE),
                              std::lround(parking::wrapAngle(pose.yaw) / HEADING)};
        };
        std::set<std::tuple<long, long, long>> seen{cell(start)};
        std::queue<parking::Pose> open({start});
        double nearest = std::numeric_limits<double>::infinity();
        while (!open.empty())
        {
            const parking::Pose pose = open.front();
            open.pop();
            nearest = std::min(nearest, positionDistance(pose, target));
            for (const double steer : {-1.0, 0.0, 1.0})
                for (const double gear : {-STEP, STEP})
                {
                    const double free = world.freeLength(pose, steer / TURNING_RADIUS, gear);
                    if (free < STEP)
                        continue;
                    const parking::Pose next = advance(pose, steer / TURNING_RADIUS, gear);
                    if (seen.insert(cell(next)).second)
                        open.push(next);
                }
        }
        return nearest;
    }
}  // namespace parking_test
