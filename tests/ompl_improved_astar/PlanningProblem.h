#pragma once

#include "benchmarks/worlds/RandomWorlds.h"
#include "ompl_improved_astar/ImprovedAStar.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplCompatibility.h"
#include "state_validity/ompl/OmplPose.h"
#include "state_validity/ompl/SweptMotionValidator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>

namespace parking_test
{
    namespace ob = ompl::base;
    namespace og = ompl::geometric;
    using parking::Pose;
    using Status = ob::PlannerStatus;

    constexpr double SAME = 1e-12;  // metres and radians, of poses that are equal up to rounding

    /** \brief The status of an infeasible problem: up to OMPL 1.5 the same as of a time-out. */
    inline Status::StatusType infeasible()
    {
        return parking::ompl_compatibility::infeasible<Status>(0);
    }

    /** \brief Values by name, from "name=value name=value". */
    inline std::map<std::string, std::string> settings(const std::string &text)
    {
        std::map<std::string, std::string> values;
        std::istringstream words(text);
        for (std::string word; words >> word;)
            values[word.substr(0, word.find('='))] = word.substr(word.find('=') + 1);
        return values;
    }

    struct Scene
    {
        std::vector<parking::Polygon> obstacles;
        parking::Box bounds;
    };

    inline parking::Polygon box(double minX, double minY, double maxX, double maxY)
    {
        return {{minX, minY}, {maxX, minY}, {maxX, maxY}, {minX, maxY}};
    }

    /** \brief A square with obstacles, \e half metres to each side of the origin. */
    inline Scene square(std::vector<parking::Polygon> boxes = {}, double half = 15.0)
    {
        return {std::move(boxes), {{-half, -half}, {half, half}}};
    }

    // An aisle with a slot between two cars above it.
    const Scene SLOT_SCENE = square({box(-4.0, 0.0, -1.3, 5.0), box(1.3, 0.0, 4.0, 5.0)});
    constexpr Pose AISLE{-8.0, -3.0, 0.0}, SLOT{0.0, 4.0, -0.5 * parking::PI}, IN_OBSTACLE{-2.5, 2.0, 0.0};

    // Two walls with a gap each, at opposite ends.
    const Scene GAPS = square({box(-3.0, -10.0, -2.0, 6.0), box(3.0, -6.0, 4.0, 10.0)});
    constexpr Pose LEFT{-9.0, -5.0, 0.0}, RIGHT{9.0, 5.0, 0.0};

    // Two rooms with a wall between them that has no door.
    const Scene CLOSED = square({box(-0.2, -15.0, 0.2, 15.0)});
    constexpr Pose BEFORE_WALL{-8.0, 1.0, 0.0}, BEHIND_WALL{8.0, 0.0, 0.0};

    // A pen round the origin with a little room to move.
    const Scene PEN = square(
        {box(-4.0, -1.5, -3.0, 1.5), box(6.0, -1.5, 7.0, 1.5), box(-4.0, -2.5, 7.0, -1.5), box(-4.0, 1.5, 7.0, 2.5)});

    enum class Space
    {
        SE2,
        ReedsShepp,
        Dubins,
        SymmetricDubins
    };

    /** \brief Spaces and parameters that most tests cover. */
    const std::pair<Space, const char *> VARIANTS[] = {
        {Space::SE2, ""}, {Space::ReedsShepp, ""}, {Space::Dubins, ""}, {Space::SE2, "motion_model=grid8"}};

    /** \brief A planning problem, assembled as in an application. OMPL prints nothing meanwhile. */
    class PlanningProblem
    {
    public:
        using Rule = std::function<bool(const Pose &)>;

        /** \brief The footprint among obstacles, swept; parameters as in settings(). */
        PlanningProblem(Space kind, const Scene &scene, const std::string &parameters = "",
                        const parking::Vehicle &car = {})
          : PlanningProblem(kind, scene.bounds, parameters, car)
        {
            setObstacles(scene);
        }

        /** \brief Any rule for the validity of states, with OMPL's own motion validator. */
        PlanningProblem(Space kind, const parking::Box &bounds, const Rule &rule, const std::string &parameters = "",
                        double resolution = 0.002)
          : PlanningProblem(kind, bounds, parameters, parking::Vehicle())
        {
            si->setStateValidityChecker([rule](const ob::State *state) { return rule(parking::poseOf(state)); });
            si->setStateValidityCheckingResolution(resolution);
            si->setup();
            isFree = rule;
        }

        void setObstacles(const Scene &scene)
        {
            setObstacles(parking::ObstacleSet::fromPolygons(scene.obstacles, scene.bounds),
                         PolygonOracle(scene.obstacles, scene.bounds));
        }

        void setObstacles(const parking::ObstacleSet &obstacles, const PolygonOracle &oracle)
        {
            si->setStateValidityChecker(std::make_shared<parking::FclFootprintChecker>(si, obstacles, vehicle));
            si->setMotionValidator(std::make_shared<parking::SweptMotionValidator>(si));
            si->setup();
            isFree = [oracle, car = vehicle](const Pose &pose)
            {
                return oracle.isFree(pose, car);
            };
        }

        void set(const std::string &parameters)
        {
            EXPECT_TRUE(planner->params().setParams(settings(parameters))) << parameters;
        }

        ob::ScopedState<> state(const Pose &pose) const
        {
            ob::ScopedState<> result(space);
            parking::setPose(result.get(), pose);
            return result;
        }

        PlanningProblem &from(const std::vector<Pose> &poses)
        {
            pdef->clearStartStates();
            starts = poses;
            for (const Pose &start : starts)
                pdef->addStartState(state(start));
            return *this;
        }

        PlanningProblem &to(const std::vector<Pose> &poses)
        {
            const auto states = std::make_shared<ob::GoalStates>(si);
            goals = poses;
            for (const Pose &goal : goals)
                states->addState(state(goal));
            pdef->setGoal(states);
            return *this;
        }

        /** \brief Plans to the end; the time limit only guards against hanging. */
        Status solve(double seconds = 60.0)
        {
            return planner->solve(ob::timedPlannerTerminationCondition(seconds));
        }

        /** \brief Plans until the planner has polled the termination condition \e count times. */
        Status solveWithPolls(unsigned int count)
        {
            return planner->solve(
                ob::PlannerTerminationCondition([polls = 0u, count]() mutable { return ++polls > count; }));
        }

        og::PathGeometric path() const
        {
            const auto *solution = dynamic_cast<const og::PathGeometric *>(pdef->getSolutionPath().get());
            return solution ? *solution : og::PathGeometric(si);
        }

        std::vector<Pose> poses() const
        {
            std::vector<Pose> result;
            const og::PathGeometric solution = path();
            for (std::size_t i = 0; i < solution.getStateCount(); ++i)
                result.push_back(parking::poseOf(solution.getState(i)));
            return result;
        }

        double bestCost() const
        {
            return std::stod(planner->getPlannerProgressProperties().at("best cost REAL")());
        }

        /** \brief Metres along OMPL's own interpolation. */
        double driven(const Pose &from, const Pose &to) const
        {
            return kind_ == Space::SE2 ? positionDistance(from, to)
                                       : space->distance(state(from).get(), state(to).get());
        }

        /** \brief Checks the reported path along OMPL's own interpolation, independently of the planner: it passes the
            motion validator, begins at a start, ends exactly at a goal, is free every 5 mm, moves along its heading,
            respects the turning radius and, in a Dubins space, never reverses. */
        void expectSound(bool isExact = true) const
        {
            const auto contains = [](const std::vector<Pose> &list, const Pose &pose)
            {
                return std::any_of(list.begin(), list.end(),
                                   [&](const Pose &each) { return isSamePose(each, pose, 1e-15); });
            };
            const std::vector<Pose> states = poses();
            ASSERT_GE(states.size(), isExact ? 2u : 1u);
            EXPECT_TRUE(path().check());
            EXPECT_TRUE(contains(starts, states.front()));
            EXPECT_EQ(contains(goals, states.back()), isExact);
            ob::ScopedState<> between(space);
            Pose last = states.front();
            for (std::size_t i = 1; i < states.size(); ++i)
            {
                const ob::ScopedState<> begin = state(states[i - 1]), end = state(states[i]);
                const double steps = std::max(1.0, std::ceil(driven(states[i - 1], states[i]) / 0.005));
                for (double k = 1.0; k <= steps && !testing::Test::HasFailure(); k += 1.0)
                {
                    space->interpolate(begin.get(), end.get(), k / steps, between.get());
                    const Pose pose = parking::poseOf(between.get());
                    EXPECT_TRUE(isFree(pose)) << "state " << i << ": " << pose.x << ", " << pose.y << ", " << pose.yaw;
                    if (planner->parameters().motionModel == "car")
                        expectDrivable(last, pose);
                    last = pose;
                }
            }
        }

        parking::Vehicle vehicle;
        std::shared_ptr<ob::SE2StateSpace> space;
        ob::SpaceInformationPtr si;
        ob::ProblemDefinitionPtr pdef;
        std::shared_ptr<og::ImprovedAStar> planner;
        Rule isFree;
        std::vector<Pose> starts, goals;

    private:
        PlanningProblem(Space kind, const parking::Box &bounds, const std::string &parameters,
                        const parking::Vehicle &car)
          : vehicle(car),
            kind_(kind)
        {
            ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
            const double radius = vehicle.minTurningRadius();
            if (kind == Space::SE2)
                space = std::make_shared<ob::SE2StateSpace>();
            else if (kind == Space::ReedsShepp)
                space = std::make_shared<ob::ReedsSheppStateSpace>(radius);
            else
                space = std::make_shared<ob::DubinsStateSpace>(radius, kind == Space::SymmetricDubins);
            ob::RealVectorBounds limits(2);
            limits.low = {bounds.min.x(), bounds.min.y()};
            limits.high = {bounds.max.x(), bounds.max.y()};
            space->setBounds(limits);
            si = std::make_shared<ob::SpaceInformation>(space);
            pdef = std::make_shared<ob::ProblemDefinition>(si);
            planner = std::make_shared<og::ImprovedAStar>(si);
            planner->setProblemDefinition(pdef);
            set("turning_radius=" + parking::formatNumber(radius));
            set(parameters);
        }

        void expectDrivable(const Pose &from, const Pose &to) const
        {
            // Metres and radians: rounding of coordinates in the billions, and chords instead of arcs on a plain space.
            constexpr double ROUNDING = 2e-5, CHORD = 0.01;
            const Pose step = relativeTo(from, to);
            const double length = std::hypot(step.x, step.y);
            const bool mayReverse = kind_ == Space::SE2 || kind_ == Space::ReedsShepp;
            const double radius =
                kind_ == Space::SE2 ? planner->parameters().turningRadius : vehicle.minTurningRadius();
            EXPECT_LE(std::abs(step.yaw), 1.001 * length / radius + ROUNDING) << "turns too sharply";
            EXPECT_LE(std::abs(step.y), CHORD * length + ROUNDING) << "slides sideways";
            EXPECT_GE(step.x, mayReverse ? -HUGE_VAL : -ROUNDING) << "reverses";
        }

        Space kind_;
    };

    inline bool areEqual(const std::vector<Pose> &a, const std::vector<Pose> &b)
    {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                          [](const Pose &p, const Pose &q) { return p.x == q.x && p.y == q.y && p.yaw == q.yaw; });
    }

    /** \brief Valid where the clearance is positive; counts the queries of both. */
    class CountingChecker : public ob::StateValidityChecker
    {
    public:
        CountingChecker(const ob::SpaceInformationPtr &information, std::function<double(const Pose &)> clearance,
                        bool knowsClearance = true)
          : StateValidityChecker(information),
            clearance_(std::move(clearance))
        {
            specs_.clearanceComputationType =
                knowsClearance ? ob::StateValidityCheckerSpecs::EXACT : ob::StateValidityCheckerSpecs::NONE;
        }
        bool isValid(const ob::State *state) const override
        {
            return ++states > 0 && clearance_(parking::poseOf(state)) > 0.0;
        }
        double clearance(const ob::State *state) const override
        {
            return ++clearances > 0 ? std::max(0.0, clearance_(parking::poseOf(state))) : 0.0;
        }
        mutable std::uint64_t states{0}, clearances{0};

    private:
        std::function<double(const Pose &)> clearance_;
    };

    /** \brief Any number of goals; the sampler takes the number of samples made before. */
    class SampledRegion : public ob::GoalSampleableRegion
    {
    public:
        using Sampler = std::function<Pose(unsigned int)>;

        SampledRegion(const ob::SpaceInformationPtr &information, Sampler sampler)
          : GoalSampleableRegion(information),
            sampler_(std::move(sampler))
        {
        }
        void sampleGoal(ob::State *state) const override
        {
            parking::setPose(state, sampler_(samples++));
        }
        unsigned int maxSampleCount() const override
        {
            return std::numeric_limits<unsigned int>::max();
        }
        double distanceGoal(const ob::State *state) const override
        {
            return positionDistance(parking::poseOf(state), {});
        }
        mutable unsigned int samples{0};

    private:
        Sampler sampler_;
    };
}  // namespace parking_test
