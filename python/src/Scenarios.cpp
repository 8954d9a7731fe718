// Scenario.
#include "parking_geometry/Error.h"
#include "parking_geometry/MakeScenario.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/NearestName.h"
#include "python/src/Bindings.h"
#include "python/src/Handles.h"
#include "python/src/Pickling.h"
#include "python/src/Signals.h"
#include "python/src/Values.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace parking::python
{
    namespace
    {
        std::string fileFrom(const py::object &value, const std::string &field)
        {
            try
            {
                return py::cast<std::filesystem::path>(value).string();
            }
            catch (const py::cast_error &)
            {
                PyErr_Clear();
                throw Error(field + " must be the path of a file, not " +
                            py::cast<std::string>(py::str(py::type::of(value).attr("__name__"))));
            }
        }

        Vehicle vehicleFrom(const py::object &value)
        {
            if (py::isinstance<Vehicle>(value))
                return py::cast<Vehicle>(value);
            return readVehicle(fileFrom(value, "vehicle"));
        }

        bool isFile(const py::object &value)
        {
            return py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__");
        }

        OccupancyGrid readGrid(const std::string &file, std::vector<std::string> &warnings)
        {
            return std::filesystem::path(file).extension() == ".npy" ? readSurroundOcc(file)
                                                                     : readRosMap(file, nullptr, &warnings);
        }

        /** Issues the warnings of a reader. Throws if Python treats warnings as errors. */
        void warn(const std::vector<std::string> &warnings)
        {
            for (const std::string &each : warnings)
                if (PyErr_WarnEx(PyExc_UserWarning, each.c_str(), 1) != 0)
                    throw py::error_already_set();
        }

        /** A scenario with start, goals, slot, car and name, but without a world. */
        Scenario problemFrom(const py::object &start, const py::object &goal, const py::object &slot,
                             const py::object &vehicle, const py::object &name)
        {
            Scenario scenario;
            scenario.name = textFrom(name, "name");
            scenario.vehicle = vehicleFrom(vehicle);
            scenario.start = poseFrom(start, "start");
            if (!goal.is_none())
            {
                // One pose, or several of them.
                const py::array array = py::array::ensure(goal);
                PyErr_Clear();
                if (array && array.ndim() == 2)
                {
                    const Doubles rows = posesFrom(goal, "goal");
                    for (py::ssize_t i = 0; i < rows.shape(0); ++i)
                        scenario.goals.push_back({rows.at(i, 0), rows.at(i, 1), rows.at(i, 2)});
                }
                else
                    scenario.goals = {poseFrom(goal, "goal")};
            }
            if (!slot.is_none())
            {
                if (!py::isinstance<ParkingSlot>(slot))
                    throw Error("slot must be a Slot");
                scenario.slot = py::cast<ParkingSlot>(slot);
            }
            return scenario;
        }

        ScenarioPointer made(Scenario scenario)
        {
            return std::make_shared<const ScenarioHandle>(makeScenario(std::move(scenario), "scenario"));
        }

        ScenarioPointer fromPolygons(const py::object &polygons, const py::object &start, const py::object &goal,
                                     const py::object &slot, const py::object &vehicle, const py::object &name)
        {
            Scenario scenario = problemFrom(start, goal, slot, vehicle, name);
            if (!py::isinstance<py::iterable>(polygons) || py::isinstance<py::str>(polygons))
                throw Error("polygons must be a list of polygons, each an array of n rows (x, y)");
            for (const py::handle polygon : polygons)
                scenario.polygons.push_back(
                    polygonFrom(polygon, "polygons[" + std::to_string(scenario.polygons.size()) + "]"));
            return made(std::move(scenario));
        }

        ScenarioPointer fromGrid(const py::object &grid, const py::object &start, const py::object &goal,
                                 const py::object &slot, const py::object &resolution, const py::object &origin,
                                 const py::object &vehicle, const py::object &name, const py::object &unknownIsOccupied)
        {
            Scenario scenario = problemFrom(start, goal, slot, vehicle, name);
            scenario.unknownIsOccupied = flagFrom(unknownIsOccupied, "unknown_is_occupied");
            if (isFile(grid))
            {
                if (!resolution.is_none() || !origin.is_none())
                    throw Error("resolution and origin are defined by the file of the map: omit them");
                scenario.grid = readGrid(fileFrom(grid, "grid"), scenario.warnings);
                warn(scenario.warnings);
            }
            else
            {
                if (resolution.is_none())
                    throw Error("resolution must be given: metres per cell");
                scenario.grid = gridFrom(grid, numberFrom(resolution, "resolution"),
                                         origin.is_none() ? Pose() : poseFrom(origin, "origin"));
            }
            return made(std::move(scenario));
        }

        /** A copy of the scenario in world coordinates, input of another one. */
        Scenario inWorld(const Scenario &local)
        {
            Scenario scenario = local;
            scenario.start = local.toWorld(local.start);
            for (Pose &goal : scenario.goals)
                goal = local.toWorld(goal);
            if (scenario.slot)
                scenario.slot->pose = local.toWorld(scenario.slot->pose);
            for (Polygon &polygon : scenario.polygons)
                for (Eigen::Vector2d &corner : polygon)
                    corner += local.worldOffset;
            if (scenario.grid)
                scenario.grid->setOrigin(local.toWorld(scenario.grid->origin()));
            return scenario;
        }

        ScenarioPointer changed(const ScenarioHandle &self, const py::object &start, const py::object &goal,
                                const py::object &slot, const py::object &vehicle)
        {
            Scenario scenario = inWorld(self.scenario());
            if (!start.is_none())
                scenario.start = poseFrom(start, "start");
            if (!vehicle.is_none())
                scenario.vehicle = vehicleFrom(vehicle);
            if (!goal.is_none() || !slot.is_none())
            {
                const Scenario other =
                    problemFrom(toPython(scenario.start), goal, slot, py::cast(scenario.vehicle), py::str());
                scenario.goals = other.goals;
                scenario.slot = other.slot;
            }
            else if (scenario.slot)
                scenario.goals.clear();  // the slot defines them again
            return made(std::move(scenario));
        }

        template <class Result, class Ask>
        py::array_t<Result> askAll(const ScenarioHandle &self, const py::object &poses, const Ask &ask)
        {
            const Doubles rows = posesFrom(poses, "poses");
            // A vector as shape: pybind11 before 2.12 miscomputes the strides of a single number with NumPy 2.
            py::array_t<Result> answers(std::vector<py::ssize_t>{rows.shape(0)});
            const double *data = rows.data();
            for (py::ssize_t i = 0; i < rows.size(); ++i)
                if (!std::isfinite(data[i]))
                    throw Error("poses: row " + std::to_string(i / 3) + " is not finite");
            Result *to = answers.mutable_data();
            const auto count = static_cast<std::size_t>(rows.shape(0));
            const Eigen::Vector2d offset = self.scenario().worldOffset;
            Signals signals;
            {
                const auto interrupted = [&signals]
                {
                    return signals.arrived();
                };
                const py::gil_scoped_release release;
                const ScenarioPlanner *planner = self.planner(interrupted);
                constexpr std::size_t AT_ONCE = 1024;  // between two looks at the clock
                for (std::size_t i = 0; planner != nullptr && i < count; ++i)
                {
                    if (i % AT_ONCE == 0 && interrupted())
                        break;
                    to[i] = ask(planner->footprint(),
                                Pose{data[3 * i] - offset.x(), data[3 * i + 1] - offset.y(), data[3 * i + 2]});
                }
            }
            signals.raise();
            return answers;
        }

        py::list polygonsOf(const ScenarioHandle &self)
        {
            py::list polygons;
            for (const Polygon &polygon : self.scenario().polygons)
            {
                py::array_t<double> rows({static_cast<py::ssize_t>(polygon.size()), py::ssize_t{2}});
                auto values = rows.mutable_unchecked<2>();
                for (std::size_t i = 0; i < polygon.size(); ++i)
                    for (int k = 0; k < 2; ++k)
                        values(static_cast<py::ssize_t>(i), k) = polygon[i][k] + self.scenario().worldOffset[k];
                polygons.append(rows);
            }
            return polygons;
        }

        py::object cellsOf(const py::object &self)
        {
            const auto &scenario = py::cast<const ScenarioHandle &>(self).scenario();
            if (!scenario.grid)
                return py::none();
            const OccupancyGrid &grid = *scenario.grid;
            return view(reinterpret_cast<const std::uint8_t *>(grid.cells().data()),
                        {static_cast<py::ssize_t>(grid.height()), static_cast<py::ssize_t>(grid.width())}, self);
        }

        const char *const ABOUT = R"(A parking problem: obstacles, a vehicle, start and goals.

Scenario.read(path)                                  from a file: YAML or TPCAP case
Scenario.from_polygons(polygons, start, goal)        from lists or arrays of corners
Scenario.from_grid(array, start, goal, resolution=)  from a NumPy array or the path of a map

Coordinates are those of the given file or data, in metres and radians. Poses (x, y, yaw) are of the midpoint of the
rear axle. A scenario is immutable; replace() returns a modified copy.)";
    }  // namespace

    ScenarioPointer scenarioFrom(const py::handle &value, const std::string &field)
    {
        if (!py::isinstance<ScenarioHandle>(value))
            failFor(value, field, "a Scenario");
        return py::cast<std::shared_ptr<ScenarioHandle>>(value);
    }

    void addScenarios(py::module_ &module)
    {
        const py::none none;
        py::class_<ScenarioHandle, std::shared_ptr<ScenarioHandle>>(module, "Scenario", ABOUT)
            .def_static(
                "read",
                [](const py::object &path, const py::object &vehicle, const py::object &text)
                {
                    const std::string file = fileFrom(path, "path");
                    const auto read = [&](const ReaderOptions &options)
                    {
                        Scenario scenario = text.is_none()
                                                ? readScenario(file, options)
                                                : parseScenario(file, py::cast<std::string>(py::bytes(text)), options);
                        warn(scenario.warnings);
                        return scenario;
                    };
                    if (!vehicle.is_none() && py::isinstance<Vehicle>(vehicle))
                    {
                        Scenario scenario = inWorld(read({}));
                        scenario.vehicle = py::cast<Vehicle>(vehicle);
                        if (scenario.slot)
                            scenario.goals.clear();
                        return made(std::move(scenario));
                    }
                    const std::string car = vehicle.is_none() ? "" : fileFrom(vehicle, "vehicle");
                    return std::make_shared<const ScenarioHandle>(read({car}));
                },
                py::arg("path"), py::arg("vehicle") = none, py::kw_only(), py::arg("text") = none,
                "Reads a scenario file; its format is detected automatically.\n\n"
                "vehicle : a name, a file or a Vehicle that replaces the one of the file\n"
                "text : the content of path, if it was already read, for example from a pipe")
            .def_static("from_polygons", &fromPolygons, py::arg("polygons"), py::arg("start"), py::arg("goal") = none,
                        py::kw_only(), py::arg("slot") = none, py::arg("vehicle") = "tpcap",
                        py::arg("name") = "polygons",
                        "Creates a scenario from polygons, each an array of n rows (x, y).\n\n"
                        "goal : one pose, or n rows of poses; alternatively a Slot as slot")
            .def_static("from_grid", &fromGrid, py::arg("grid"), py::arg("start"), py::arg("goal") = none,
                        py::kw_only(), py::arg("slot") = none, py::arg("resolution") = none, py::arg("origin") = none,
                        py::arg("vehicle") = "tpcap", py::arg("name") = "grid", py::arg("unknown_is_occupied") = true,
                        "Creates a scenario from a map.\n\n"
                        "grid : a 2-D array (0 free, 1 occupied, -1 or 2 unknown; row 0 is the lowest), or the path "
                        "of a ROS map or a SurroundOcc .npy file\n"
                        "resolution : metres per cell, for arrays only\n"
                        "origin : pose of the lower left corner, for arrays only\n"
                        "goal : one pose, or n rows of poses; alternatively a Slot as slot")
            .def("replace", &changed, py::kw_only(), py::arg("start") = none, py::arg("goal") = none,
                 py::arg("slot") = none, py::arg("vehicle") = none,
                 "Returns a copy with another start, goal, slot or car.")
            .def(py::pickle([](const ScenarioHandle &self) { return stateOf(self.scenario()); },
                            [](const py::tuple &state) { return std::make_shared<ScenarioHandle>(scenarioOf(state)); }))
            .def(
                "is_free",
                [](const ScenarioHandle &self, const py::object &poses)
                {
                    return askAll<bool>(self, poses,
                                        [](const FootprintChecker &checker, const Pose &pose)
                                        { return checker.isFree(pose); });
                },
                py::arg("poses"),
                "Returns an array of n bool: whether the car is free of collision at each of n poses.")
            .def(
                "clearance_at",
                [](const ScenarioHandle &self, const py::object &poses)
                {
                    return askAll<double>(self, poses,
                                          [](const FootprintChecker &checker, const Pose &pose)
                                          { return checker.isFree(pose) ? checker.exactClearance(pose) : 0.0; });
                },
                py::arg("poses"),
                "Returns the distance between the car and the nearest obstacle at each of n poses in metres; 0 in "
                "collision.")
            .def_property_readonly(
                "name", [](const ScenarioHandle &self) { return self.scenario().name; }, "Name of the scenario.")
            .def_property_readonly(
                "vehicle", [](const ScenarioHandle &self) { return self.scenario().vehicle; },
                "The Vehicle that parks.")
            .def_property_readonly(
                "start",
                [](const ScenarioHandle &self) { return toPython(self.scenario().toWorld(self.scenario().start)); },
                "Start pose of the car: (x, y, yaw).")
            .def_property_readonly(
                "goals",
                [](const ScenarioHandle &self)
                {
                    py::list goals;
                    for (const Pose &goal : self.scenario().goals)
                        goals.append(toPython(self.scenario().toWorld(goal)));
                    return goals;
                },
                "Goal poses as a list of (x, y, yaw); those of the slot if there is one.")
            .def_property_readonly(
                "slot", [](const ScenarioHandle &self) { return inWorld(self.scenario()).slot; },
                "The Slot in which the car parks, or None.")
            .def_property_readonly("polygons", &polygonsOf, "Obstacles as a list of n x 2 arrays; empty for a map.")
            .def_property_readonly(
                "files", [](const ScenarioHandle &self) { return self.scenario().files; },
                "Files from which the scenario was read: its own, and those of its map and car.")
            .def_property_readonly(
                "unknown_is_occupied", [](const ScenarioHandle &self) { return self.scenario().unknownIsOccupied; },
                "Whether unknown cells of a map are obstacles.")
            .def_property_readonly("grid", &cellsOf,
                                   "Cells of a map: 0 free, 1 occupied, 2 unknown. A read-only view of the "
                                   "scenario's memory; None for polygons.")
            .def_property_readonly(
                "resolution",
                [](const ScenarioHandle &self) -> py::object
                {
                    if (!self.scenario().grid)
                        return py::none();
                    return py::float_(self.scenario().grid->resolution());
                },
                "Metres per cell of a map; None for polygons.")
            .def_property_readonly(
                "origin",
                [](const ScenarioHandle &self) -> py::object
                {
                    if (!self.scenario().grid)
                        return py::none();
                    return toPython(self.scenario().toWorld(self.scenario().grid->origin()));
                },
                "Pose of the lower left corner of a map; None for polygons.")
            .def_property_readonly(
                "bounds",
                [](const ScenarioHandle &self)
                {
                    const Scenario &scenario = self.scenario();
                    const Eigen::Vector2d low = scenario.bounds.min + scenario.worldOffset,
                                          high = scenario.bounds.max + scenario.worldOffset;
                    return py::make_tuple(low.x(), low.y(), high.x(), high.y());
                },
                "Bounds of the world: (min x, min y, max x, max y).")
            .def("__repr__", [](const ScenarioHandle &self) { return "Scenario('" + self.scenario().name + "')"; });
    }
}  // namespace parking::python
