#include "playground/src/Playground.h"

#include "automatic_parking/scenario/ScenarioPlanner.h"
#include "automatic_parking/scenario/SearchTrace.h"
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/MakeScenario.h"
#include "parking_geometry/text/Text.h"
#include "playground/src/Describe.h"
#include "playground/src/TextbookPlan.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace
{
    using namespace parking;

    constexpr double MS = 1e3;                // milliseconds in a second
    constexpr double TRAJECTORY_STEP = 0.05;  // seconds between points
    constexpr std::size_t OUTPUTS = PLAYGROUND_FIELD + 1;
    constexpr double LEAST_SPACING = 0.1;  // metres between points of the distance field
    constexpr std::size_t MOST_TEXTBOOK_NODES = 20000;
    constexpr std::size_t MOST_GOALS = 1000, MOST_CORNERS = 1000000;

    struct Session
    {
        std::string message, parametersJson, vehiclesJson;
        std::vector<double> numbers;
        std::vector<std::uint8_t> cells;
        PlannerParameters parameters;
        std::unique_ptr<const ScenarioPlanner> planner;
        double loading{0.0};  // milliseconds
        std::optional<ScenarioPlan> plan;
        std::optional<SearchTrace> textbookTrace;  // of the plan, if the textbook's search found it
        std::array<std::vector<double>, OUTPUTS> outputs;
    };

    Session &session()
    {
        static Session only;
        return only;
    }

    std::vector<double> &output(PlaygroundOutput which)
    {
        return session().outputs[which];
    }

    /** Executes a function that may throw. */
    template <class Work>
    bool tried(const Work &work)
    {
        session().message.clear();
        try
        {
            work();
            return true;
        }
        catch (const std::bad_alloc &)
        {
            session().message = "there is not enough memory";
        }
        catch (const std::exception &error)
        {
            session().message = error.what();
        }
        return false;
    }

    /** Reads the numbers of a scene in order. */
    class Numbers
    {
    public:
        Numbers(const std::vector<double> &values, std::size_t count) : values_(values), count_(count)
        {
        }

        double take()
        {
            if (next_ >= count_ || next_ >= values_.size())
                throw Error("the scene ends after " + std::to_string(next_) + " numbers");
            return values_[next_++];
        }

        std::size_t count(std::size_t most)
        {
            const double value = take();
            if (!(value >= 0.0 && value <= static_cast<double>(most)) || value != std::floor(value))
                throw Error("number " + std::to_string(next_) + " of the scene is " + formatNumber(value) +
                            "; it must be a whole number from 0 to " + std::to_string(most));
            return static_cast<std::size_t>(value);
        }

        Pose pose()
        {
            const double x = take(), y = take(), yaw = take();
            return {x, y, yaw};
        }

        void end() const
        {
            if (next_ != count_)
                throw Error("the scene has " + std::to_string(count_) + " numbers, but " + std::to_string(next_) +
                            " are required");
        }

    private:
        const std::vector<double> &values_;
        std::size_t count_, next_{0};
    };

    ParkingSlot takeSlot(Numbers &numbers)
    {
        ParkingSlot slot;
        slot.kind = static_cast<SlotKind>(numbers.count(2));
        slot.pose = numbers.pose();
        slot.length = numbers.take();
        slot.width = numbers.take();
        slot.entry = static_cast<SlotEntry>(numbers.count(2));
        slot.angle = numbers.take();
        slot.side = static_cast<SlotSide>(numbers.count(2));
        const double depth = numbers.take();
        if (depth >= 0.0)
            slot.depth = depth;
        slot.lateralOffset = numbers.take();
        return slot;
    }

    OccupancyGrid takeMap(Numbers &numbers, const std::vector<std::uint8_t> &cells)
    {
        constexpr std::size_t MOST = 100000;
        const std::size_t columns = numbers.count(MOST), rows = numbers.count(MOST);
        const double resolution = numbers.take();
        OccupancyGrid grid(columns, rows, resolution, numbers.pose());
        if (cells.size() != columns * rows)
            throw Error("the map has " + std::to_string(cells.size()) + " cells, not " + std::to_string(columns) +
                        " x " + std::to_string(rows));
        for (std::size_t row = 0; row < rows; ++row)
            for (std::size_t column = 0; column < columns; ++column)
                grid.set(column, row, static_cast<Cell>(std::min<int>(cells[row * columns + column], 2)));
        return grid;
    }

    Scenario takeScenario(Numbers numbers, const std::vector<std::uint8_t> &cells)
    {
        Scenario scenario;
        scenario.name = "scene";
        Vehicle &car = scenario.vehicle;
        for (double *field : {&car.wheelbase, &car.frontOverhang, &car.rearOverhang, &car.width, &car.maxSteeringAngle,
                              &car.maxSpeed, &car.maxAcceleration, &car.maxSteeringRate})
            *field = numbers.take();
        for (std::size_t left = numbers.count(Vehicle::MAX_CORNERS); left > 0; --left)
        {
            const double x = numbers.take(), y = numbers.take();
            car.outline.emplace_back(x, y);
        }
        scenario.start = numbers.pose();
        if (numbers.count(1) == 0)
            for (std::size_t left = numbers.count(MOST_GOALS); left > 0; --left)
                scenario.goals.push_back(numbers.pose());
        else
            scenario.slot = takeSlot(numbers);
        if (numbers.count(1) == 0)
        {
            std::vector<std::size_t> corners(numbers.count(MOST_CORNERS));
            for (std::size_t &each : corners)
                each = numbers.count(MOST_CORNERS);
            for (const std::size_t count : corners)
            {
                Polygon polygon;
                for (std::size_t i = 0; i < count; ++i)
                {
                    const double x = numbers.take(), y = numbers.take();
                    polygon.emplace_back(x, y);
                }
                scenario.polygons.push_back(std::move(polygon));
            }
        }
        else
        {
            scenario.grid = takeMap(numbers, cells);
            scenario.unknownIsOccupied = numbers.count(1) == 1;
        }
        numbers.end();
        return makeScenario(std::move(scenario), "scene");
    }

    const ScenarioPlanner &planner()
    {
        if (!session().planner)
            throw Error("there is no scene");
        return *session().planner;
    }

    void append(std::vector<double> &to, std::initializer_list<double> values)
    {
        to.insert(to.end(), values);
    }

    void showScene(const Scenario &scenario)
    {
        for (auto &each : session().outputs)
            each.clear();
        for (const Pose &goal : scenario.goals)
        {
            const Pose pose = scenario.toWorld(goal);
            append(output(PLAYGROUND_GOALS), {pose.x, pose.y, pose.yaw});
        }
        if (scenario.slot)
            for (const Eigen::Vector2d &corner : scenario.slot->outline())
                append(output(PLAYGROUND_SLOT),
                       {corner.x() + scenario.worldOffset.x(), corner.y() + scenario.worldOffset.y()});
        const Eigen::Vector2d low = scenario.bounds.min + scenario.worldOffset,
                              high = scenario.bounds.max + scenario.worldOffset;
        output(PLAYGROUND_BOUNDS) = {low.x(), low.y(), high.x(), high.y()};
    }

    /** Whether the car itself can drive the path of a disc, as PLAYGROUND_SUMMARY reports it. */
    double obstructionOf(const ScenarioPlan &plan)
    {
        constexpr double ROUNDING = 1e-6;
        const FootprintChecker &footprint = planner().footprint();
        const double most = (1.0 + ROUNDING) / planner().scenario().vehicle.minTurningRadius();
        for (const PathPiece &piece : plan.path.pieces)
            if (piece.turn != 0.0 || std::max(std::abs(piece.curvature), std::abs(piece.endCurvature())) > most)
                return 1.0;
        for (const PathState &state : planner().states(plan))
            if (plan.isDisc && !footprint.isFree(state.pose))
                return 2.0;
        return 0.0;
    }

    void showPlan(const ScenarioPlan &plan)
    {
        constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
        const ScenarioPlanner &world = planner();
        const Scenario &scenario = world.scenario();
        const double clearance = plan.hasPath() ? world.clearance(plan) : NONE;
        output(PLAYGROUND_SUMMARY) = {static_cast<double>(plan.outcome),
                                      plan.hasPath() ? plan.path.length() : NONE,
                                      plan.hasPath() ? static_cast<double>(plan.path.cusps()) : NONE,
                                      clearance,
                                      plan.cost,
                                      plan.suboptimalityBound,
                                      static_cast<double>(plan.statistics.expanded),
                                      static_cast<double>(plan.statistics.generated),
                                      static_cast<double>(plan.statistics.connections),
                                      static_cast<double>(plan.checks.states),
                                      MS * plan.planningTime,
                                      session().loading + MS * plan.loadingTime,
                                      static_cast<double>(plan.goal),
                                      plan.isDisc ? 1.0 : 0.0,
                                      world.circleRadius(),
                                      scenario.vehicle.minTurningRadius(),
                                      obstructionOf(plan)};
        for (const PathState &state : world.states(plan))
        {
            const Pose pose = scenario.toWorld(state.pose);
            const double room = plan.isDisc ? world.circle().clearance(state.pose.x, state.pose.y)
                                            : world.footprint().clearance(state.pose);
            append(output(PLAYGROUND_PATH), {pose.x, pose.y, pose.yaw, static_cast<double>(state.direction),
                                             state.curvature, state.arcLength, room});
        }
        if (plan.hasPath())
            for (const PathPiece &piece : plan.path.pieces)
                append(output(PLAYGROUND_PIECES), {piece.curvature, piece.length, piece.sharpness, piece.turn});
    }

    void forgetPlan()
    {
        for (const PlaygroundOutput each :
             {PLAYGROUND_SUMMARY, PLAYGROUND_PATH, PLAYGROUND_PIECES, PLAYGROUND_TRAJECTORY})
            output(each).clear();
        session().plan.reset();
        session().textbookTrace.reset();
    }

    void showTree(std::vector<double> &to, const std::vector<TraceNode> &nodes)
    {
        const Scenario &scenario = planner().scenario();
        to.reserve(9 * nodes.size());
        for (const TraceNode &node : nodes)
        {
            const Pose pose = scenario.toWorld(node.pose);
            append(to, {pose.x, pose.y, pose.yaw, static_cast<double>(node.parent), node.curvature, node.length,
                        node.cost, node.ahead, node.expanded ? 1.0 : 0.0});
        }
    }

    void setParameter(const std::string &name, const std::string &value)
    {
        PlannerParameters &parameters = session().parameters;
        if (name == "parameter_set")
            parameters = parameterSet(value, parameters);
        else
            parameterNamed(name).setText(parameters, value);
    }
}  // namespace

extern "C"
{
    const char *playground_message()
    {
        return session().message.c_str();
    }

    const char *playground_parameters()
    {
        session().parametersJson = playground::parametersJson();
        return session().parametersJson.c_str();
    }

    const char *playground_vehicles()
    {
        session().vehiclesJson = playground::vehiclesJson();
        return session().vehiclesJson.c_str();
    }

    double *playground_numbers(std::size_t count)
    {
        session().numbers.assign(count, 0.0);
        return session().numbers.data();
    }

    std::uint8_t *playground_cells(std::size_t count)
    {
        session().cells.assign(count, 0);
        return session().cells.data();
    }

    bool playground_scene(std::size_t count)
    {
        return tried(
            [count]
            {
                session().planner.reset();
                forgetPlan();
                for (auto &each : session().outputs)
                    each.clear();
                Scenario scenario = takeScenario(Numbers(session().numbers, count), session().cells);
                showScene(scenario);
                const auto begin = std::chrono::steady_clock::now();
                session().planner = std::make_unique<const ScenarioPlanner>(std::move(scenario));
                session().loading =
                    MS * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
            });
    }

    void playground_reset_parameters()
    {
        session().parameters = PlannerParameters();
    }

    bool playground_set_parameter(const char *name, const char *value)
    {
        return tried([&] { setParameter(name, value); });
    }

    bool playground_plan(double seconds, double expansions)
    {
        return tried(
            [&]
            {
                forgetPlan();
                PlanLimits limits;
                limits.time = seconds;
                limits.expansions = expansions > 0.0 ? static_cast<std::uint64_t>(expansions) : 0;
                session().plan = planner().plan(session().parameters, limits);
                showPlan(*session().plan);
                session().message = session().plan->reason.empty() ? session().plan->notice : session().plan->reason;
            });
    }

    bool playground_plan_by_textbook(double seconds)
    {
        return tried(
            [seconds]
            {
                forgetPlan();
                PlanLimits limits;
                limits.time = seconds;
                playground::TextbookPlan found = playground::planByTextbook(planner(), limits, MOST_TEXTBOOK_NODES);
                session().plan = std::move(found.plan);
                session().textbookTrace = std::move(found.trace);
                showPlan(*session().plan);
                session().message = session().plan->reason;
            });
    }

    bool playground_field(double mostSide)
    {
        return tried(
            [mostSide]
            {
                std::vector<double> &field = output(PLAYGROUND_FIELD);
                field.clear();
                const Scenario &scenario = planner().scenario();
                const FootprintChecker &footprint = planner().footprint();
                const Eigen::Vector2d low = scenario.bounds.min, size = scenario.bounds.size();
                const double spacing = std::max(LEAST_SPACING, size.maxCoeff() / std::clamp(mostSide, 1.0, 2000.0));
                const double columns = std::floor(size.x() / spacing) + 1.0,
                             rows = std::floor(size.y() / spacing) + 1.0;
                append(field, {columns, rows, spacing, low.x() + scenario.worldOffset.x(),
                               low.y() + scenario.worldOffset.y()});
                for (double row = 0.0; row < rows; ++row)
                    for (double column = 0.0; column < columns; ++column)
                    {
                        const Pose at =
                            footprint.obstacles().toLocal({low.x() + column * spacing, low.y() + row * spacing, 0.0});
                        field.push_back(0.5 * (footprint.field().lowerBound(at.x, at.y) +
                                               footprint.field().upperBound(at.x, at.y)));
                    }
            });
    }

    bool playground_trace(double seconds, double mostNodes)
    {
        return tried(
            [&]
            {
                for (const PlaygroundOutput each : {PLAYGROUND_START_TREE, PLAYGROUND_GOAL_TREE, PLAYGROUND_STEPS})
                    output(each).clear();
                PlanLimits limits;
                limits.time = seconds;
                const SearchTrace trace = session().textbookTrace
                                              ? *session().textbookTrace
                                              : traceSearch(planner(), session().parameters, limits,
                                                            static_cast<std::size_t>(std::max(1.0, mostNodes)));
                showTree(output(PLAYGROUND_START_TREE), trace.start);
                showTree(output(PLAYGROUND_GOAL_TREE), trace.goal);
                for (const TraceStep &step : trace.steps)
                    append(output(PLAYGROUND_STEPS),
                           {static_cast<double>(step.expanded), static_cast<double>(step.start),
                            static_cast<double>(step.goal), step.solved ? 1.0 : 0.0});
            });
    }

    bool playground_trajectory(double seconds)
    {
        return tried(
            [&]
            {
                output(PLAYGROUND_TRAJECTORY).clear();
                if (!session().plan)
                    throw Error("there is no plan");
                const auto begin = std::chrono::steady_clock::now();
                const QuickestTrajectory found = planner().trajectory(
                    *session().plan, {},
                    [&] {
                        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() >
                               seconds;
                    });
                const Scenario &scenario = planner().scenario();
                for (const TrajectoryPoint &point : sample(found.trajectory.motion, scenario.vehicle, TRAJECTORY_STEP))
                {
                    const Pose pose = scenario.toWorld({point.x, point.y, point.yaw});
                    append(output(PLAYGROUND_TRAJECTORY), {point.t, pose.x, pose.y, pose.yaw, point.v,
                                                           point.acceleration, point.steering, point.steeringRate});
                }
                session().message = found.trajectory.reason;
            });
    }

    bool playground_is_free(double x, double y, double yaw)
    {
        if (!session().planner)
            return false;
        const Eigen::Vector2d offset = session().planner->scenario().worldOffset;
        return session().planner->footprint().isFree({x - offset.x(), y - offset.y(), yaw});
    }

    const double *playground_output(int which)
    {
        return which < 0 || which >= static_cast<int>(OUTPUTS)
                   ? nullptr
                   : session().outputs[static_cast<std::size_t>(which)].data();
    }

    std::size_t playground_output_size(int which)
    {
        return which < 0 || which >= static_cast<int>(OUTPUTS)
                   ? 0
                   : session().outputs[static_cast<std::size_t>(which)].size();
    }
}
