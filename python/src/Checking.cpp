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
                // In the scenario that is asked about, which may lie elsewhere.
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
        py::class_<Verdict>(module, "Verdict", "What check() found. True when nothing is wrong.")
            .def_readonly("valid", &Verdict::valid)
            .def_property_readonly(
                "fault", [](const Verdict &self) { return toString(self.fault); },
                "none, no_path, not_finite, wrong_start, misses_goal, not_drivable or collision: the "
                "first one found")
            .def_readonly("reason", &Verdict::reason, "What is wrong and where, in a few words; empty when valid.")
            .def_readonly("states", &Verdict::states, "Poses tested.")
            .def_readonly("collisions", &Verdict::collisions, "Of those in collision.")
            .def_readonly("max_curvature", &Verdict::maxCurvature, "1/m")
            .def("__bool__", [](const Verdict &self) { return self.valid; })
            .def("__repr__",
                 [](const Verdict &self) {
                     return self.valid ? std::string("Verdict(valid)")
                                       : "Verdict(" + toString(self.fault) + ": " + self.reason + ")";
                 });
        module.def("check", &checkPath, py::arg("scenario"), py::arg("path"), py::arg("exact") = true,
                   R"(The referee's word on a path, by code that shares nothing with the planner: does it lead from the
start to a goal, can the car steer like that, and does its body stay clear, looked at every 5 mm?

path : a Result, a ParkingPlan, or an array of n rows (x, y, yaw, ...), joined by arcs
exact : False for a path that only ends near a goal

Returns a Verdict.)");
    }
}  // namespace parking::python
