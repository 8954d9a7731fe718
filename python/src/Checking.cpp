// check().
#include "parking_geometry/Error.h"
#include "parking_geometry/referee/Referee.h"
#include "python/src/Bindings.h"
#include "python/src/Handles.h"
#include "python/src/Values.h"

namespace parking::python
{
    namespace
    {
        Verdict checkPath(const py::object &world, const py::object &path, const py::object &mustArrive)
        {
            const ScenarioPointer scenario = scenarioFrom(world, "scenario");
            const Scenario &problem = scenario->scenario();
            const bool exact = flagFrom(mustArrive, "exact");
            double circle = 0.0;
            Path pieces;
            if (py::isinstance<PathHandle>(path))
            {
                const auto &handle = py::cast<const PathHandle &>(path);
                if (!handle.hasPath())
                    return {};
                // In the given scenario, which may have another offset.
                const Scenario &own = handle.scenario().scenario();
                pieces = handle.path();
                const Eigen::Vector2d between = own.worldOffset - problem.worldOffset;
                pieces.start.x += between.x();
                pieces.start.y += between.y();
                if (const auto *plan = dynamic_cast<const PlanHandle *>(&handle);
                    plan != nullptr && plan->plan().isDisc)
                    circle = scenario->planner().circleRadius();
            }
            else
                pieces = pathFrom(path, problem);
            const py::gil_scoped_release release;
            return Referee(problem, circle).check(pieces, exact);
        }
    }  // namespace

    void addReferee(py::module_ &module)
    {
        py::class_<Verdict>(module, "Verdict", "Result of check(). It is True for a valid path.")
            .def_readonly("valid", &Verdict::valid, "Whether the path is valid.")
            .def_property_readonly(
                "fault", [](const Verdict &self) { return toString(self.fault); },
                "First fault found: none, no_path, not_finite, wrong_start, misses_goal, not_drivable or collision.")
            .def_readonly("reason", &Verdict::reason, "Description and place of the fault; empty for a valid path.")
            .def_readonly("states", &Verdict::states, "Number of tested poses.")
            .def_readonly("collisions", &Verdict::collisions, "Number of tested poses in collision.")
            .def_readonly("max_curvature", &Verdict::maxCurvature, "Maximum curvature of the path in 1/m.")
            .def("__bool__", [](const Verdict &self) { return self.valid; })
            .def("__repr__",
                 [](const Verdict &self) {
                     return self.valid ? std::string("Verdict(valid)")
                                       : "Verdict(" + toString(self.fault) + ": " + self.reason + ")";
                 });
        module.def("check", &checkPath, py::arg("scenario"), py::arg("path"), py::arg("exact") = true,
                   R"(Checks a path with code that is independent of the planner. The path must lead from the start
to a goal within the turning radius of the car. Its body must be free of collision, tested every 5 mm.

path : a Result, a ParkingPlan, or an array of n rows (x, y, yaw, ...), joined by arcs
exact : False for a path that only ends near a goal

Returns a Verdict.)");
    }
}  // namespace parking::python
