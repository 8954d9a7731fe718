#include "benchmarks/plan/Problem.h"

#include "ompl_improved_astar/DrivingCostObjective.h"
#include "ompl_improved_astar/ImprovedAStar.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/fcl/FclContactTest.h"
#include "state_validity/ompl/CircleValidityChecker.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplPose.h"
#include "state_validity/ompl/SweptMotionValidator.h"

#include <ompl/base/goals/GoalState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/util/Console.h>
#include <ompl/util/Exception.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        constexpr double CHECK_SPACING = 0.05;  // metres between states that OMPL's own tools check

        std::shared_ptr<ob::SE2StateSpace> makeSpace(const Scenario &scenario, SpaceKind kind)
        {
            std::shared_ptr<ob::SE2StateSpace> space;
            const double radius = scenario.vehicle.minTurningRadius();
            if (kind == SpaceKind::ReedsShepp)
                space = std::make_shared<ob::ReedsSheppStateSpace>(radius);
            else if (kind == SpaceKind::Dubins)
                space = std::make_shared<ob::DubinsStateSpace>(radius);
            else
                space = std::make_shared<ob::SE2StateSpace>();
            space->setBounds(positionBounds(scenario.bounds));
            return space;
        }

        constexpr const char *TURNING_RADIUS = "turning_radius";

        bool isOn(ob::Planner &planner, const std::string &parameter)
        {
            std::string value;
            return planner.params().getParam(parameter, value) && (value == "1" || value == "true");
        }

        /** Throws SettingError for a turning radius below the car's, which this project's planner would ignore. */
        void requireUsedRadius(const std::string &planner, const PlannerSettings &settings, const Problem &problem)
        {
            const double ofCar = problem.scenario().vehicle.minTurningRadius();
            for (const auto &[name, value] : settings)
            {
                // The car's own radius, as printed in results, is allowed.
                double radius = 0.0;
                if (name == TURNING_RADIUS && parseNumber(value, radius) && std::abs(radius - ofCar) > 1e-4 * ofCar)
                    throw SettingError({name}, "parameter turning_radius of " + planner +
                                                   " requires space se2: in space " +
                                                   toString(problem.settings().space) + " the car turns within " +
                                                   formatNumber(ofCar, 3) +
                                                   " m, by the wheelbase and max_steering_angle of its vehicle");
            }
        }

        PlannerSettings allSettings(const PlannerEntry &entry, const PlannerSettings &settings)
        {
            PlannerSettings all = entry.settings;
            all.insert(all.end(), settings.begin(), settings.end());
            return all;
        }

        ob::GoalPtr makeGoal(const Scenario &scenario, const ob::SpaceInformationPtr &si)
        {
            ob::ScopedState<> state(si);
            if (scenario.goals.size() == 1)
            {
                auto goal = std::make_shared<ob::GoalState>(si);
                setPose(state.get(), scenario.goals.front());
                goal->setState(state);
                return goal;
            }
            auto goals = std::make_shared<ob::GoalStates>(si);
            for (const Pose &pose : scenario.goals)
            {
                setPose(state.get(), pose);
                goals->addState(state);
            }
            return goals;
        }
    }  // namespace

    std::string toString(SpaceKind space)
    {
        return space == SpaceKind::ReedsShepp ? "reeds_shepp" : space == SpaceKind::Dubins ? "dubins" : "se2";
    }

    std::string toString(FootprintKind footprint)
    {
        return footprint == FootprintKind::Rectangle ? "rectangle" : "circle";
    }

    SpaceKind spaceByName(const std::string &name)
    {
        for (const SpaceKind kind : {SpaceKind::ReedsShepp, SpaceKind::Dubins, SpaceKind::SE2})
            if (toString(kind) == name)
                return kind;
        throw Error(unknownName("space", name, {"reeds_shepp", "dubins", "se2"}));
    }

    FootprintKind footprintByName(const std::string &name)
    {
        for (const FootprintKind kind : {FootprintKind::Rectangle, FootprintKind::Circle})
            if (toString(kind) == name)
                return kind;
        throw Error(unknownName("footprint", name, {"rectangle", "circle"}));
    }

    std::string toString(ObjectiveKind objective)
    {
        return objective == ObjectiveKind::Length ? "length" : objective == ObjectiveKind::Driving ? "driving" : "";
    }

    ObjectiveKind objectiveByName(const std::string &name)
    {
        for (const ObjectiveKind kind : {ObjectiveKind::Length, ObjectiveKind::Driving})
            if (toString(kind) == name)
                return kind;
        throw Error(unknownName("objective", name, {"length", "driving"}));
    }

    void checkSettings(const ProblemSettings &settings)
    {
        if (!(std::isfinite(settings.circleRadius) && settings.circleRadius >= 0.0))
            throw Error(
                "the radius of the circle must be a positive number of metres, or 0 for half of the car's "
                "width, not " +
                formatNumber(settings.circleRadius));
        if (settings.footprint == FootprintKind::Circle && settings.space != SpaceKind::SE2)
            throw Error("footprint circle requires space se2, not " + toString(settings.space) +
                        ": a disc has no heading that a curve could turn");
    }

    Problem::Problem(Scenario scenario, const ProblemSettings &settings)
      : scenario_(std::move(scenario)),
        settings_(settings)
    {
        checkSettings(settings_);
        const bool circle = settings_.footprint == FootprintKind::Circle;
        const auto space = makeSpace(scenario_, settings_.space);
        si_ = std::make_shared<ob::SpaceInformation>(space);
        const auto begin = std::chrono::steady_clock::now();
        const auto stopClock = [&]
        {
            loadingTime_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        };
        obstacles_ = std::make_shared<const ObstacleSet>(ObstacleSet::fromScenario(scenario_));
        if (circle)
        {
            const auto checker = std::make_shared<CircleValidityChecker>(si_, *obstacles_, circleRadius());
            stopClock();
            si_->setStateValidityChecker(checker);
            si_->setMotionValidator(std::make_shared<CircleMotionValidator>(si_, checker));
        }
        footprint_ = std::make_shared<const FootprintChecker>(*obstacles_, scenario_.vehicle, 0.0, fclContactTest());
        if (!circle)
        {
            stopClock();
            si_->setStateValidityChecker(std::make_shared<FclFootprintChecker>(si_, footprint_));
            si_->setMotionValidator(std::make_shared<SweptMotionValidator>(si_, footprint_));
        }
        si_->setStateValidityCheckingResolution(std::min(0.01, CHECK_SPACING / space->getMaximumExtent()));
        si_->setup();
        curveSpace_ = std::make_unique<CurveSpace>(*si_->getStateSpace());
        referee_ = std::make_unique<const Referee>(scenario_, circleRadius());
    }

    double circleRadiusOf(const ProblemSettings &settings, const Vehicle &vehicle)
    {
        if (settings.footprint == FootprintKind::Rectangle)
            return 0.0;
        return settings.circleRadius > 0.0 ? settings.circleRadius : 0.5 * vehicle.width;
    }

    double Problem::circleRadius() const
    {
        return circleRadiusOf(settings_, scenario_.vehicle);
    }

    /** The fault of a pose, as the end of a sentence; empty when it is free. */
    std::string Problem::troubleAt(const Pose &pose) const
    {
        ob::ScopedState<> state(si_);
        setPose(state.get(), pose);
        if (si_->isValid(state.get()))
            return "";
        const Pose local = obstacles_->toLocal(pose);
        std::vector<Eigen::Vector2d> outline;
        if (settings_.footprint == FootprintKind::Rectangle)
            for (const Eigen::Vector2d &corner : scenario_.vehicle.footprint(local))
                outline.push_back(corner);
        else
            for (const double side : {-circleRadius(), circleRadius()})
                outline.emplace_back(local.x + side, local.y + side);
        const Box &world = obstacles_->bounds();
        for (const Eigen::Vector2d &point : outline)
            if ((point.array() < world.min.array()).any() || (point.array() > world.max.array()).any())
                return std::string("is outside of the ") + (scenario_.grid ? "map" : "world") +
                       ", in whole or in part,";
        return si_->satisfiesBounds(state.get()) ? "is in collision" : "is outside of the planning volume";
    }

    std::string Problem::whyUnsolvable() const
    {
        const std::string shape = settings_.footprint == FootprintKind::Rectangle ? "the car" : "the circle";
        const auto place = [this](const Pose &local)
        {
            const Pose pose = scenario_.toWorld(local);
            return formatNumber(pose.x) + ", " + formatNumber(pose.y) + ", " + formatNumber(pose.yaw);
        };
        if (const std::string trouble = troubleAt(scenario_.start); !trouble.empty())
            return shape + " " + trouble + " at the start " + place(scenario_.start);
        std::string first;
        for (const Pose &goal : scenario_.goals)
        {
            const std::string trouble = troubleAt(goal);
            if (trouble.empty())
                return "";
            if (first.empty())
                first = shape + " " + trouble + " at the goal " + place(goal);
        }
        return first + (scenario_.goals.size() > 1 ? ", and no other goal is free" : "");
    }

    ompl::geometric::ImprovedAStar *PreparedPlanner::improved() const
    {
        return dynamic_cast<ompl::geometric::ImprovedAStar *>(&planner->wrapped());
    }

    ob::OptimizationObjectivePtr Problem::objective() const
    {
        if (settings_.objective == ObjectiveKind::Length)
            return std::make_shared<ob::PathLengthOptimizationObjective>(si_);
        if (settings_.objective == ObjectiveKind::Driving)
            return std::make_shared<DrivingCostObjective>(si_);
        return nullptr;
    }

    PreparedPlanner Problem::prepare(const PlannerEntry &entry, const PlannerSettings &settings) const
    {
        PreparedPlanner prepared;
        prepared.setup = std::make_shared<ompl::geometric::SimpleSetup>(si_);
        ob::ScopedState<> start(si_);
        setPose(start.get(), scenario_.start);
        prepared.setup->setStartState(start);
        prepared.setup->setGoal(makeGoal(scenario_, si_));
        const ob::PlannerPtr planner = entry.allocate(si_);
        if (!planner)
            throw Error("planner " + entry.name + ": its allocator returned nothing");
        planner->setName(entry.name);
        prepared.planner = std::make_shared<MeasuredPlanner>(planner);
        if (planner->params().hasParam(TURNING_RADIUS))
            applySettings(*planner, {{TURNING_RADIUS, formatNumber(scenario_.vehicle.minTurningRadius())}});
        if (prepared.improved() != nullptr && isDrivable())
            requireUsedRadius(entry.name, settings, *this);
        applySettings(*planner, allSettings(entry, settings));
        const std::shared_ptr<SolveRecord> &record = prepared.planner->record();
        ob::OptimizationObjectivePtr objective = this->objective();
        prepared.planner->setObjective(objective);
        if (entry.optimizing)
        {
            using Length = RecordingObjective<ob::PathLengthOptimizationObjective>;
            using Driving = RecordingObjective<DrivingCostObjective>;
            if (settings_.objective == ObjectiveKind::Driving)
                objective = std::make_shared<Driving>(si_, record);
            else
                objective = std::make_shared<Length>(si_, record);
        }
        else
        {
            // A planner that improves paths without this objective defines itself when to stop (improved_astar with
            // `anytime`).
            prepared.problem()->setIntermediateSolutionCallback(
                [record](const ob::Planner *, const std::vector<const ob::State *> &, ob::Cost cost)
                { record->note(cost.value()); });
            const bool stops = settings_.threshold > 0.0 && isOn(*planner, "anytime");
            if (stops && !objective)
                objective = std::make_shared<ob::PathLengthOptimizationObjective>(si_);
            else if (!stops && prepared.improved() == nullptr)
                objective.reset();  // with one, some planners to the first solution use up their time limit
        }
        if (objective)
        {
            objective->setCostThreshold(ob::Cost(settings_.threshold));
            prepared.setup->setOptimizationObjective(objective);
        }
        prepared.setup->setPlanner(prepared.planner);
        try
        {
            prepared.setup->setup();
        }
        catch (const ompl::Exception &error)
        {
            throw Error(oneLine(error.what()));
        }
        return prepared;
    }

    ClosedLoop Problem::closedLoop() const
    {
        ClosedLoop loop(scenario_.vehicle);
        loop.setClearance([checker = footprint_](const Pose &pose)
                          { return checker->isFree(pose) ? checker->clearance(pose) : 0.0; });
        return loop;
    }

    CheckCounts Problem::checkCounts() const
    {
        CheckCounts counts;
        if (const auto *checker = dynamic_cast<const FclFootprintChecker *>(si_->getStateValidityChecker().get()))
            counts += checker->counts();
        if (const auto *validator = dynamic_cast<const SweptMotionValidator *>(si_->getMotionValidator().get()))
            counts += validator->counts();
        return counts;
    }

    void Problem::resetCounts() const
    {
        if (auto *checker = dynamic_cast<FclFootprintChecker *>(si_->getStateValidityChecker().get()))
            checker->resetCounts();
        if (auto *validator = dynamic_cast<SweptMotionValidator *>(si_->getMotionValidator().get()))
            validator->resetCounts();
    }

    ProblemSettings suitableSettings(const PlannerEntry &entry, const PlannerSettings &settings)
    {
        ProblemSettings suitable;
        const auto space = std::make_shared<ob::SE2StateSpace>();
        space->setBounds(positionBounds({{0.0, 0.0}, {1.0, 1.0}}));
        const ob::PlannerPtr planner = entry.allocate(std::make_shared<ob::SpaceInformation>(space));
        const auto *improved = dynamic_cast<const ompl::geometric::ImprovedAStar *>(planner.get());
        if (improved == nullptr)
            return suitable;
        planner->setName(entry.name);
        applySettings(*planner, allSettings(entry, settings));
        if (improved->parameters().motionModel != "car")
            suitable = {SpaceKind::SE2, FootprintKind::Circle};
        return suitable;
    }

    void seedRandomNumbers(std::uint_fast32_t seed)
    {
        ompl::msg::OutputHandler *handler = ompl::msg::getOutputHandler();
        ompl::msg::noOutputHandler();
        ompl::RNG::setSeed(seed == 0 ? 1 : seed);
        ompl::msg::useOutputHandler(handler);
    }
}  // namespace parking
