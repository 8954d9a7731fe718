#include "benchmarks/planners/PythonPlanner.h"

#include "benchmarks/planners/InputStates.h"
#include "benchmarks/planners/SolveRecord.h"
#include "benchmarks/system/ScriptFile.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplPose.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Exception.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>

namespace ob = ompl::base;
using nlohmann::json;

namespace parking
{
    namespace
    {
        constexpr double LONGEST_IMPORT = 60.0;  // seconds until a module is loaded
        constexpr double AT_GOAL = 1e-4;         // metres and radians: tolerance of the referee

        using States = std::vector<const ob::State *>;
        using Stop = ExternalProgram::Stop;

        json toJson(const Pose &pose)
        {
            return {pose.x, pose.y, pose.yaw};
        }

        json toJson(const Polygon &corners)
        {
            json list = json::array();
            for (const Eigen::Vector2d &corner : corners)
                list.push_back({corner.x(), corner.y()});
            return list;
        }

        json toJson(const Vehicle &car)
        {
            return {{"wheelbase", car.wheelbase},
                    {"front_overhang", car.frontOverhang},
                    {"rear_overhang", car.rearOverhang},
                    {"width", car.width},
                    {"max_steering_angle", car.maxSteeringAngle},
                    {"outline", toJson(car.footprint({}))}};
        }

        json toJson(const std::vector<Polygon> &polygons)
        {
            json list = json::array();
            for (const Polygon &polygon : polygons)
                list.push_back(toJson(polygon));
            return list;
        }

        Pose poseFrom(const json &numbers)
        {
            return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
        }

        bool isAt(const ob::State *state, const ob::State *goal)
        {
            const Pose a = poseOf(state), b = poseOf(goal);
            return positionDistance(a, b) < AT_GOAL && std::abs(wrapAngle(a.yaw - b.yaw)) < AT_GOAL;
        }

        /** The next message of Python; null when stopped. Throws parking::Error with the text of a message about an
         * error. */
        json receive(ExternalProgram &program, const Stop &stop)
        {
            const std::optional<std::string> line = program.receive(stop);
            if (!line)
                return nullptr;
            json message = json::parse(*line, nullptr, false);
            if (!message.is_object() || message.empty())
                throw Error("it wrote into the channel of its answer");
            if (message.contains("error"))
                throw Error(message["error"].get<std::string>());
            return message;
        }

        std::unique_ptr<ExternalProgram> startPython(const std::string &file)
        {
            const std::string script = findScript("planners/run_planner.py");
            if (script.empty())
                throw Error("the script run_planner.py is not installed");
            return std::make_unique<ExternalProgram>(std::vector<std::string>{"python3", script, file});
        }

        /** What the module says about itself when it is loaded. */
        json awaitDescription(ExternalProgram &program)
        {
            using Clock = std::chrono::steady_clock;
            const auto deadline = Clock::now() + std::chrono::duration<double>(LONGEST_IMPORT);
            const json message = receive(program, [&] { return Clock::now() >= deadline; });
            if (message.is_null())
                throw Error("it is not loaded after " + formatNumber(LONGEST_IMPORT) + " s");
            return message.at("ready");
        }
    }  // namespace

    PythonPlannerFile readPythonPlanner(const std::string &file)
    {
        const json ready = awaitDescription(*startPython(file));
        return {file, ready.at("name"), oneLine(ready.at("summary").get<std::string>()), ready.at("improves"),
                ready.at("parameters")};
    }

    PythonPlanner::PythonPlanner(const ob::SpaceInformationPtr &si, const PythonPlannerFile &description)
      : ob::Planner(si, description.name),
        file_(description.file),
        parameters_(description.parameters)
    {
        specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
        specs_.optimizingPaths = description.improves;
        for (const auto &[name, value] : parameters_.items())
            if (value.is_boolean())
                declare<bool>(name);
            else if (value.is_number_unsigned())
                declare<std::size_t>(name);
            else if (value.is_number_integer())
                declare<int>(name);
            else if (value.is_number())
                declare<double>(name);
            else
                declare<std::string>(name);
    }

    template <class Value>
    void PythonPlanner::declare(const std::string &name)
    {
        params_.declareParam<Value>(
            name, [this, name](Value value) { parameters_[name] = value; },
            [this, name] { return parameters_[name].template get<Value>(); });
    }

    void PythonPlanner::start()
    {
        try
        {
            program_ = startPython(file_);
            awaitDescription(*program_);
        }
        catch (const Error &error)
        {
            throw ompl::Exception(getName(), error.what());
        }
    }

    void PythonPlanner::setup()
    {
        ob::Planner::setup();
        if (dynamic_cast<const FclFootprintChecker *>(si_->getStateValidityChecker().get()) == nullptr)
            throw ompl::Exception(getName(), "a planner in Python requires footprint = rectangle");
        if (SolveRecord::isByProcessorTime())
            throw ompl::Exception(getName(),
                                  "a planner in Python has its own process, whose processor time is not "
                                  "measured; use clock = wall");
        if (!program_)
            start();
    }

    ob::PlannerStatus PythonPlanner::solve(const ob::PlannerTerminationCondition &ptc)
    {
        checkValidity();
        pis_.restart();
        const ob::State *start = pis_.nextStart();
        if (start == nullptr)
            return ob::PlannerStatus::INVALID_START;
        const States goals = goalsOf(pis_, ptc);
        if (goals.empty())  // No goal is free, or there was no time to sample one.
            return ptc ? ob::PlannerStatus::TIMEOUT : ob::PlannerStatus::INVALID_GOAL;
        if (!program_)
            this->start();
        const std::unique_ptr<ExternalProgram> program = std::move(program_);  // ends with solve()
        const Stop stop = [&ptc]
        {
            return ptc();
        };
        bool isDone = !program->send(json{{"problem", problem(start, goals)}}.dump(), stop);
        try
        {
            while (!isDone)
            {
                const json message = receive(*program, stop);
                if (message.is_null() || message.contains("done"))
                    isDone = true;
                else if (message.contains("path"))
                    isDone = !message["path"].is_null() && addPath(message["path"], goals);
                else
                    isDone = !program->send(json{{"answer", answer(message, stop)}}.dump(), stop);
            }
        }
        catch (const Error &error)
        {
            const std::string text = error.what();
            if (text.rfind("MemoryError", 0) == 0)
                throw std::bad_alloc();
            throw ompl::Exception(getName(), text);
        }
        if (!pdef_->hasSolution())
            return ob::PlannerStatus::TIMEOUT;
        return pdef_->hasApproximateSolution() ? ob::PlannerStatus::APPROXIMATE_SOLUTION
                                               : ob::PlannerStatus::EXACT_SOLUTION;
    }

    json PythonPlanner::problem(const ob::State *start, const States &goals) const
    {
        const auto &checker = static_cast<const FclFootprintChecker &>(*si_->getStateValidityChecker());  // see setup()
        const FootprintChecker &footprint = checker.footprint();
        const ob::RealVectorBounds &bounds = si_->getStateSpace()->as<ob::SE2StateSpace>()->getBounds();
        json goalPoses = json::array();
        for (const ob::State *goal : goals)
            goalPoses.push_back(toJson(poseOf(goal)));
        return {{"start", toJson(poseOf(start))},
                {"goals", goalPoses},
                {"bounds", {{bounds.low[0], bounds.low[1]}, {bounds.high[0], bounds.high[1]}}},
                {"vehicle", toJson(footprint.vehicle())},
                {"turning_radius", footprint.vehicle().minTurningRadius()},
                {"obstacles", toJson(footprint.obstacles().solids())},
                {"time_limit", timeLimit_},
                {"seed", ompl::RNG().uniformInt(0, std::numeric_limits<int>::max() - 1)},
                {"parameters", parameters_}};
    }

    json PythonPlanner::answer(const json &question, const ExternalProgram::Stop &stop) const
    {
        ob::ScopedState<> from(si_), to(si_);
        json answers = json::array();
        const std::string &kind = question.begin().key();
        for (const json &each : question.front())
        {
            if (stop())
                break;
            if (kind == "is_free")
            {
                setPose(from.get(), poseFrom(each));
                answers.push_back(si_->isValid(from.get()));
                continue;
            }
            setPose(from.get(), poseFrom(each.at(0)));
            setPose(to.get(), poseFrom(each.at(1)));
            if (kind == "distance")
                answers.push_back(si_->distance(from.get(), to.get()));
            else
                answers.push_back(si_->isValid(from.get()) && si_->checkMotion(from.get(), to.get()));
        }
        return answers;
    }

    /** \return whether it is good enough to end the search */
    bool PythonPlanner::addPath(const json &poses, const States &goals)
    {
        const auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
        ob::ScopedState<> state(si_);
        for (const json &pose : poses)
        {
            setPose(state.get(), poseFrom(pose));
            path->append(state.get());
        }
        if (path->getStateCount() == 0)
            return false;
        ob::PlannerSolution solution(path);
        solution.setPlannerName(getName());
        double distance = std::numeric_limits<double>::infinity();
        for (const ob::State *goal : goals)
            distance = isAt(state.get(), goal) ? 0.0 : std::min(distance, si_->distance(state.get(), goal));
        if (distance > 0.0)
            solution.setApproximate(distance);
        bool isEnough = false;
        if (const ob::OptimizationObjectivePtr &objective = pdef_->getOptimizationObjective())
        {
            const ob::Cost cost = path->cost(objective);
            isEnough = distance == 0.0 && objective->isSatisfied(cost);
            solution.setOptimized(objective, cost, isEnough);
        }
        pdef_->addSolutionPath(solution);
        return isEnough;
    }
}  // namespace parking
