// States of Vehicle, Slot, Scenario and Result for pickle.
#include "python/src/Pickling.h"

#include "python/src/Values.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace parking::python
{
    namespace
    {
        py::tuple stateOf(const Pose &pose)
        {
            return py::make_tuple(pose.x, pose.y, pose.yaw);
        }

        Pose poseOf(const py::handle &state)
        {
            const auto [x, y, yaw] = py::cast<std::tuple<double, double, double>>(state);
            return {x, y, yaw};
        }

        py::tuple stateOf(const Eigen::Vector2d &point)
        {
            return py::make_tuple(point.x(), point.y());
        }

        Eigen::Vector2d pointOf(const py::handle &state)
        {
            const auto [x, y] = py::cast<std::pair<double, double>>(state);
            return {x, y};
        }

        py::list stateOf(const Polygon &polygon)
        {
            py::list corners;
            for (const Eigen::Vector2d &corner : polygon)
                corners.append(stateOf(corner));
            return corners;
        }

        Polygon polygonOf(const py::handle &state)
        {
            Polygon polygon;
            for (const py::handle corner : state)
                polygon.push_back(pointOf(corner));
            return polygon;
        }

        /** Cells of a map are stored as one byte each, since there may be millions. */
        py::object stateOf(const std::optional<OccupancyGrid> &grid)
        {
            if (!grid)
                return py::none();
            return py::make_tuple(
                grid->width(), grid->height(), grid->resolution(), stateOf(grid->origin()),
                py::bytes(reinterpret_cast<const char *>(grid->cells().data()), grid->cells().size()));
        }

        std::optional<OccupancyGrid> gridOf(const py::object &state)
        {
            if (state.is_none())
                return std::nullopt;
            const auto values = py::cast<py::tuple>(state);
            const auto width = py::cast<std::size_t>(values[0]), height = py::cast<std::size_t>(values[1]);
            OccupancyGrid grid(width, height, py::cast<double>(values[2]), poseOf(values[3]));
            const auto cells = py::cast<std::string>(values[4]);
            for (std::size_t i = 0; i < std::min(cells.size(), width * height); ++i)
                grid.set(i % width, i / width, static_cast<Cell>(cells[i]));
            return grid;
        }

        py::tuple stateOf(const Path &path)
        {
            py::list pieces;
            for (const PathPiece &piece : path.pieces)
                pieces.append(py::make_tuple(piece.curvature, piece.length, piece.sharpness, piece.turn));
            return py::make_tuple(stateOf(path.start), pieces);
        }

        py::object stateOf(const std::optional<Escape> &escape)
        {
            if (!escape)
                return py::none();
            return py::make_tuple(stateOf(escape->start), escape->arc.curvature, escape->arc.length, escape->depth);
        }

        std::optional<Escape> escapeOf(const py::object &state)
        {
            if (state.is_none())
                return std::nullopt;
            const auto values = py::cast<py::tuple>(state);
            return Escape{poseOf(values[0]),
                          {py::cast<double>(values[1]), py::cast<double>(values[2])},
                          py::cast<double>(values[3])};
        }

        Path pathOfState(const py::handle &state)
        {
            const auto values = py::cast<py::tuple>(state);
            Path path{poseOf(values[0]), {}};
            for (const py::handle each : py::cast<py::list>(values[1]))
            {
                const auto numbers = py::cast<std::array<double, 4>>(each);
                PathPiece piece(numbers[0], numbers[1], numbers[2]);
                piece.turn = numbers[3];
                path.pieces.push_back(piece);
            }
            return path;
        }
    }  // namespace

    py::tuple stateOf(const Vehicle &vehicle)
    {
        return py::make_tuple(vehicle.name, vehicle.wheelbase, vehicle.frontOverhang, vehicle.rearOverhang,
                              vehicle.width, vehicle.maxSteeringAngle, vehicle.maxSpeed, vehicle.maxAcceleration,
                              vehicle.maxSteeringRate, stateOf(vehicle.outline));
    }

    Vehicle vehicleOf(const py::tuple &state)
    {
        Vehicle vehicle;
        vehicle.name = py::cast<std::string>(state[0]);
        double *const fields[] = {&vehicle.wheelbase,       &vehicle.frontOverhang,    &vehicle.rearOverhang,
                                  &vehicle.width,           &vehicle.maxSteeringAngle, &vehicle.maxSpeed,
                                  &vehicle.maxAcceleration, &vehicle.maxSteeringRate};
        for (std::size_t i = 0; i < std::size(fields); ++i)
            *fields[i] = py::cast<double>(state[i + 1]);
        vehicle.outline = polygonOf(state[std::size(fields) + 1]);
        return vehicle;
    }

    py::tuple stateOf(const ParkingSlot &slot)
    {
        return py::make_tuple(static_cast<int>(slot.kind), stateOf(slot.pose), slot.length, slot.width,
                              static_cast<int>(slot.entry), slot.angle, static_cast<int>(slot.side), slot.depth,
                              slot.lateralOffset);
    }

    ParkingSlot slotOf(const py::tuple &state)
    {
        ParkingSlot slot;
        slot.kind = static_cast<SlotKind>(py::cast<int>(state[0]));
        slot.pose = poseOf(state[1]);
        slot.length = py::cast<double>(state[2]);
        slot.width = py::cast<double>(state[3]);
        slot.entry = static_cast<SlotEntry>(py::cast<int>(state[4]));
        slot.angle = py::cast<double>(state[5]);
        slot.side = static_cast<SlotSide>(py::cast<int>(state[6]));
        slot.depth = py::cast<std::optional<double>>(state[7]);
        slot.lateralOffset = py::cast<double>(state[8]);
        return slot;
    }

    py::tuple stateOf(const Scenario &scenario)
    {
        py::list goals, polygons;
        for (const Pose &goal : scenario.goals)
            goals.append(stateOf(goal));
        for (const Polygon &polygon : scenario.polygons)
            polygons.append(stateOf(polygon));
        return py::make_tuple(scenario.name, stateOf(scenario.vehicle), stateOf(scenario.start), goals,
                              scenario.slot ? py::object(stateOf(*scenario.slot)) : py::none(), polygons,
                              stateOf(scenario.grid), scenario.unknownIsOccupied, stateOf(scenario.bounds.min),
                              stateOf(scenario.bounds.max), stateOf(scenario.worldOffset), scenario.files,
                              scenario.warnings);
    }

    Scenario scenarioOf(const py::tuple &state)
    {
        Scenario scenario;
        scenario.name = py::cast<std::string>(state[0]);
        scenario.vehicle = vehicleOf(state[1]);
        scenario.start = poseOf(state[2]);
        for (const py::handle goal : py::cast<py::list>(state[3]))
            scenario.goals.push_back(poseOf(goal));
        if (!state[4].is_none())
            scenario.slot = slotOf(state[4]);
        for (const py::handle polygon : py::cast<py::list>(state[5]))
            scenario.polygons.push_back(polygonOf(polygon));
        scenario.grid = gridOf(state[6]);
        scenario.unknownIsOccupied = py::cast<bool>(state[7]);
        scenario.bounds = {pointOf(state[8]), pointOf(state[9])};
        scenario.worldOffset = pointOf(state[10]);
        scenario.files = py::cast<std::vector<std::string>>(state[11]);
        scenario.warnings = py::cast<std::vector<std::string>>(state[12]);
        return scenario;
    }

    py::tuple stateOf(const PlanHandle &handle)
    {
        const ScenarioPlan &plan = handle.plan();
        const search::SearchStatistics &work = plan.statistics;
        return py::make_tuple(handle.scenarioPointer(), toPython(handle.parameters()), static_cast<int>(plan.outcome),
                              plan.reason, stateOf(plan.path), plan.goal, plan.cost, plan.suboptimalityBound,
                              plan.isDisc, py::make_tuple(plan.planningTime, plan.loadingTime, work.loadingTime),
                              py::make_tuple(work.expanded, work.generated, work.connections, work.heuristicCells,
                                             work.openListOperations, work.openListComparisons, plan.checks.states,
                                             plan.checks.byField, plan.checks.byCircles, plan.checks.byEdges),
                              plan.notice, stateOf(plan.escape));
    }

    std::shared_ptr<PlanHandle> planOf(const py::tuple &state)
    {
        ScenarioPlan plan;
        plan.outcome = static_cast<search::PlanOutcome>(py::cast<int>(state[2]));
        plan.reason = py::cast<std::string>(state[3]);
        plan.path = pathOfState(state[4]);
        plan.goal = py::cast<std::size_t>(state[5]);
        plan.cost = py::cast<double>(state[6]);
        plan.suboptimalityBound = py::cast<double>(state[7]);
        plan.isDisc = py::cast<bool>(state[8]);
        const auto seconds = py::cast<std::array<double, 3>>(state[9]);
        plan.planningTime = seconds[0];
        plan.loadingTime = seconds[1];
        plan.statistics.loadingTime = seconds[2];
        std::uint64_t *const counts[] = {&plan.statistics.expanded,
                                         &plan.statistics.generated,
                                         &plan.statistics.connections,
                                         &plan.statistics.heuristicCells,
                                         &plan.statistics.openListOperations,
                                         &plan.statistics.openListComparisons,
                                         &plan.checks.states,
                                         &plan.checks.byField,
                                         &plan.checks.byCircles,
                                         &plan.checks.byEdges};
        const auto numbers = py::cast<std::vector<std::uint64_t>>(state[10]);
        for (std::size_t i = 0; i < std::min(numbers.size(), std::size(counts)); ++i)
            *counts[i] = numbers[i];
        plan.notice = py::cast<std::string>(state[11]);
        plan.escape = escapeOf(state[12]);
        return std::make_shared<PlanHandle>(py::cast<std::shared_ptr<ScenarioHandle>>(state[0]), std::move(plan),
                                            parametersFrom(state[1]));
    }
}  // namespace parking::python
