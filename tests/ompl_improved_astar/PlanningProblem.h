#pragma once

#include "ompl_improved_astar/ImprovedAStar.h"
#include "parking_geometry/Polygon.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplCompatibility.h"
#include "state_validity/ompl/OmplPose.h"
#include "state_validity/ompl/SweptMotionValidator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
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

    /** \brief What solve() answers where nothing is left to try: up to OMPL 1.5 the same as when its time is up. */
    inline ob::PlannerStatus::StatusType nothingLeft()
    {
        return parking::ompl_compatibility::infeasible<ob::PlannerStatus>(0);
    }

    /** \brief A fixture during whose tests OMPL prints nothing. */
    template <class Test>
    class Silent : public Test
    {
    protected:
        void SetUp() override
        {
            ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
        }
    };

    enum class Space
    {
        SE2,
        ReedsShepp,
        Dubins
    };

    /** \brief What stands in the way of the tests' car, and the box round it. */
    struct Site
    {
        std::vector<parking::Polygon> obstacles;
        parking::Box bounds;

        parking::ObstacleSet set() const
        {
            return parking::ObstacleSet::fromPolygons(obstacles, bounds);
        }
    };

    inline parking::Polygon box(double minX, double minY, double maxX, double maxY)
    {
        return {{minX, minY}, {maxX, minY}, {maxX, maxY}, {minX, maxY}};
    }

    /** \brief An aisle, and a slot between two cars above it. */
    inline Site slotSite()
    {
        return {{box(-4.0, 0.0, -1.3, 5.0), box(1.3, 0.0, 4.0, 5.0)}, {{-15.0, -15.0}, {15.0, 15.0}}};
    }
    constexpr parking::Pose AISLE{-8.0, -3.0, 0.0};
    constexpr parking::Pose SLOT{0.0, 4.0, -0.5 * parking::PI};

    inline Site openSite(double half)
    {
        return {{}, {{-half, -half}, {half, half}}};
    }

    /** \brief Two rooms with a wall between them that has no door. */
    inline Site closedSite()
    {
        return {{box(-0.2, -15.0, 0.2, 15.0)}, {{-15.0, -15.0}, {15.0, 15.0}}};
    }

    /** \brief A planning problem, put together as in an application. */
    class PlanningProblem
    {
    public:
        PlanningProblem(Space kind, const parking::Box &bounds, const parking::Vehicle &car = parking::Vehicle())
          : vehicle(car)
        {
            const double radius = car.minTurningRadius();
            std::shared_ptr<ob::SE2StateSpace> made;
            if (kind == Space::SE2)
                made = std::make_shared<ob::SE2StateSpace>();
            else if (kind == Space::ReedsShepp)
                made = std::make_shared<ob::ReedsSheppStateSpace>(radius);
            else
                made = std::make_shared<ob::DubinsStateSpace>(radius);
            ob::RealVectorBounds box(2);
            box.low = {bounds.min.x(), bounds.min.y()};
            box.high = {bounds.max.x(), bounds.max.y()};
            made->setBounds(box);
            space = made;
            si = std::make_shared<ob::SpaceInformation>(space);
            pdef = std::make_shared<ob::ProblemDefinition>(si);
        }

        /** \brief The footprint among obstacles, swept. */
        PlanningProblem(Space kind, const Site &site) : PlanningProblem(kind, site.bounds)
        {
            setObstacles(site.set());
            makePlanner();
        }

        /** \brief Any rule of what is valid, and OMPL's own motion validator. */
        PlanningProblem(Space kind, const parking::Box &bounds, std::function<bool(const parking::Pose &)> rule)
          : PlanningProblem(kind, bounds)
        {
            si->setStateValidityChecker([rule = std::move(rule)](const ob::State *state)
                                        { return rule(parking::poseOf(state)); });
            si->setStateValidityCheckingResolution(0.002);
            si->setup();
            makePlanner();
        }

        void setObstacles(const parking::ObstacleSet &obstacles)
        {
            si->setStateValidityChecker(std::make_shared<parking::FclFootprintChecker>(si, obstacles, vehicle));
            si->setMotionValidator(std::make_shared<parking::SweptMotionValidator>(si));
            si->setup();
        }

        void makePlanner()
        {
            planner = std::make_shared<og::ImprovedAStar>(si);
            parking::PlannerParameters parameters;
            parameters.turningRadius = vehicle.minTurningRadius();
            planner->setParameters(parameters);
            planner->setProblemDefinition(pdef);
        }

        /** \brief Sets a parameter of the planner by its name. */
        template <class Value>
        void set(const std::string &name, const Value &value)
        {
            if constexpr (std::is_arithmetic_v<Value>)
                EXPECT_TRUE(planner->params().setParam(name, parking::formatNumber(value))) << name;
            else
                EXPECT_TRUE(planner->params().setParam(name, value)) << name;
        }

        ob::ScopedState<> state(const parking::Pose &pose) const
        {
            ob::ScopedState<> result(space);
            parking::setPose(result.get(), pose);
            return result;
        }

        PlanningProblem &from(const parking::Pose &start)
        {
            pdef->addStartState(state(start));
            return *this;
        }

        PlanningProblem &to(const std::vector<parking::Pose> &goals)
        {
            const auto region = std::make_shared<ob::GoalStates>(si);
            for (const parking::Pose &goal : goals)
                region->addState(state(goal));
            pdef->setGoal(region);
            return *this;
        }

        /** \brief Plans to the end; the seconds only guard against hanging. */
        ob::PlannerStatus solve(double seconds = 60.0)
        {
            return planner->solve(ob::timedPlannerTerminationCondition(seconds));
        }

        /** \brief Lets the planner ask so many times whether to stop. */
        ob::PlannerStatus solveForQuestions(unsigned int questions)
        {
            unsigned int asked = 0;
            return planner->solve(ob::PlannerTerminationCondition([&asked, questions] { return ++asked > questions; }));
        }

        og::PathGeometric path() const
        {
            const auto *solution = dynamic_cast<const og::PathGeometric *>(pdef->getSolutionPath().get());
            return solution ? *solution : og::PathGeometric(si);
        }

        std::vector<parking::Pose> poses() const
        {
            return posesOf(path());
        }

        static std::vector<parking::Pose> posesOf(const og::PathGeometric &path)
        {
            std::vector<parking::Pose> result;
            for (std::size_t i = 0; i < path.getStateCount(); ++i)
                result.push_back(parking::poseOf(path.getState(i)));
            return result;
        }

        parking::Vehicle vehicle;
        ob::StateSpacePtr space;
        ob::SpaceInformationPtr si;
        ob::ProblemDefinitionPtr pdef;
        std::shared_ptr<og::ImprovedAStar> planner;
    };

    /** \brief Poses that are the same but for rounding: metres and radians. */
    constexpr double SAME = 1e-12;

    inline bool areSame(const std::vector<parking::Pose> &a, const std::vector<parking::Pose> &b)
    {
        if (a.size() != b.size())
            return false;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (a[i].x != b[i].x || a[i].y != b[i].y || a[i].yaw != b[i].yaw)
                return false;
        return true;
    }
}  // namespace parking_test
