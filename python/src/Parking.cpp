// ParkingPlanner and ParkingPlan.
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"
#include "python/src/Background.h"
#include "python/src/Bindings.h"
#include "python/src/Handles.h"
#include "python/src/Signals.h"
#include "python/src/Values.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace parking::python
{
    namespace
    {
        const std::vector<std::string> WAYS{"searched", "one_sweep", "in_stretches"};

        PlanningParameters planningParameters(bool tight, const py::kwargs &values)
        {
            using P = PlanningParameters;
            static const std::array<std::pair<const char *, double P::*>, 7> NUMBERS{
                {{"time_limit", &P::timeLimit},
                 {"gap_worth", &P::gapWeight},
                 {"radius_factor", &P::radiusFactor},
                 {"gear_change_penalty", &P::gearChangePenalty},
                 {"steering_change_penalty", &P::steeringChangePenalty},
                 {"preferred_clearance", &P::preferredClearance},
                 {"clearance_cost", &P::clearanceCost}}};
            const double aisle =
                values.contains("aisle_width") ? numberFrom(values["aisle_width"], "aisle_width") : HUGE_VAL;
            P parameters = tight ? P::intoTightSlots(aisle) : P();
            parameters.sweep.aisleWidth = aisle;
            for (const auto &[key, value] : values)
            {
                const auto name = py::cast<std::string>(key);
                const auto *const number =
                    std::find_if(NUMBERS.begin(), NUMBERS.end(), [&](const auto &each) { return each.first == name; });
                if (number != NUMBERS.end())
                    parameters.*number->second = numberFrom(value, name);
                else if (name == "smooth")
                    parameters.smooth = flagFrom(value, name);
                else if (name == "gaps")
                {
                    if (!py::isinstance<py::iterable>(value))
                        failFor(value, name, "a list of metres");
                    parameters.gaps.clear();
                    for (const py::handle gap : value)
                        parameters.gaps.push_back(numberFrom(gap, "gaps"));
                }
                else if (name == "expansions_per_gap")
                    parameters.expansionsPerGap = countFrom(value, name);
                else if (name == "way_in")
                {
                    const auto way = std::find(WAYS.begin(), WAYS.end(), py::cast<std::string>(py::str(value)));
                    if (way == WAYS.end())
                        throw Error(unknownName("value for way_in", py::cast<std::string>(py::str(value)), WAYS));
                    parameters.entryMode = static_cast<EntryMode>(way - WAYS.begin());
                }
                else if (name != "aisle_width")
                {
                    checkNotRemoved(name);
                    std::vector<std::string> names{"aisle_width", "smooth", "gaps", "expansions_per_gap", "way_in"};
                    for (const auto &each : NUMBERS)
                        names.emplace_back(each.first);
                    throw Error(unknownName("parameter", name, names));
                }
            }
            parameters.validate();
            return parameters;
        }

        std::shared_ptr<const ParkingHandle> plan(const ParkingPlanner &self, const py::object &problem)
        {
            const ScenarioPointer scenario = scenarioFrom(problem, "scenario");
            PlanningParameters parameters = self.parameters();
            // Reading a large map for each gap cannot be interrupted: this thread stops waiting for it instead.
            const auto stop = std::make_shared<std::atomic<bool>>(false);
            parameters.interrupted = [stop]
            {
                return stop->load(std::memory_order_relaxed);
            };
            using Found = std::shared_ptr<const ParkingHandle>;
            Found result;
            Signals signals;
            {
                const py::gil_scoped_release release;
                const auto found = resultInBackground<Found>(
                    [scenario, parameters] {
                        return std::make_shared<const ParkingHandle>(
                            scenario, ParkingPlanner(parameters).plan(scenario->scenario()));
                    });
                *stop = !await(found, [&signals] { return signals.ask(); });
                if (!*stop)
                    result = found.get();
            }
            signals.raise();
            return result;
        }

        py::dict statisticsOf(const ParkingHandle &self)
        {
            const ParkingPlan &plan = self.plan();
            py::dict result;
            result["tries"] = plan.attempts;
            result["expanded"] = plan.search.expanded;
            result["generated"] = plan.search.generated;
            result["planning_time"] = plan.planningTime;
            result["smoothing_time"] = plan.smoothingTime;
            result["map_loading_time"] = plan.loadingTime;
            return result;
        }
    }  // namespace

    void addParking(py::module_ &module)
    {
        py::class_<ParkingHandle, PathHandle, std::shared_ptr<ParkingHandle>>(
            module, "ParkingPlan", "Result of ParkingPlanner.plan(). It is True if a path was found.")
            .def_property_readonly("found", &ParkingHandle::hasPath, "Whether a path was found.")
            .def_property_readonly(
                "status",
                [](const ParkingHandle &self)
                { return self.hasPath() ? std::string("found") : toString(self.plan().failure); },
                "Status: found, no_path, invalid_start or invalid_goal.")
            .def_property_readonly(
                "message", [](const ParkingHandle &self) { return self.plan().message; },
                "One line: the kind of plan, or the reason of the failure.")
            .def_property_readonly(
                "goal",
                [](const ParkingHandle &self) -> py::object
                {
                    if (!self.hasPath())
                        return py::none();
                    return toPython(self.scenario().scenario().toWorld(self.plan().goal));
                },
                "Chosen goal pose; None without a path.")
            .def_property_readonly(
                "gap", [](const ParkingHandle &self) { return self.plan().gap; },
                "Gap kept around the car while planning, in metres.")
            .def_property_readonly(
                "turning_radius", [](const ParkingHandle &self) { return self.plan().turningRadius; },
                "Planned turning radius in metres.")
            .def_property_readonly(
                "cost",
                [](const ParkingHandle &self)
                { return self.hasPath() ? self.plan().cost : std::numeric_limits<double>::infinity(); },
                "Cost in metres: length and penalties; infinite without a path.")
            .def_property_readonly(
                "is_smooth", [](const ParkingHandle &self) { return !self.plan().smooth.path.pieces.empty(); },
                "Whether the curvature of the path is continuous between its cusps.")
            .def_property_readonly("statistics", &statisticsOf,
                                   "Statistics of the attempts, a dict: tries, expanded, generated; planning_time, "
                                   "smoothing_time and map_loading_time in seconds.")
            .def("__bool__", &ParkingHandle::hasPath)
            .def("__repr__", [](const ParkingHandle &self) { return "ParkingPlan(" + self.plan().message + ")"; });

        py::class_<ParkingPlanner>(module, "ParkingPlanner",
                                   R"(Plans paths into slots with as much clearance as possible and a
continuous curvature. It constructs a manoeuvre if one fits, and searches the rest of the path.

tight : whether to use parameters for slots with centimetres of clearance
time_limit : seconds for all attempts
gaps : list of metres kept around the car, one per attempt
gap_worth : metres, weight of the gap against the cost of a path
expansions_per_gap : limit of expansions per attempt
radius_factor : planned turning radius over the minimum of the car
gear_change_penalty : metres, cost of a change of direction
steering_change_penalty : metres, cost of steering to full lock
preferred_clearance : metres kept from obstacles where that is cheap
clearance_cost : extra cost per metre driven closer than that
way_in : method of planning the slot entry: searched, one_sweep or in_stretches
aisle_width : metres
smooth : whether to make the curvature continuous)")
            .def(py::init([](bool tight, const py::kwargs &values)
                          { return ParkingPlanner(planningParameters(tight, values)); }),
                 py::arg("tight") = false)
            .def("plan", &plan, py::arg("scenario"),
                 "Plans from the start of a scenario to its goal or slot and returns a ParkingPlan.");
    }
}  // namespace parking::python
