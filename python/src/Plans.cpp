// plan(), plan_batch() and Result.
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"
#include "python/src/Bindings.h"
#include "python/src/Handles.h"
#include "python/src/Pickling.h"
#include "python/src/Signals.h"
#include "python/src/Values.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <thread>

namespace parking::python
{
    namespace
    {
        using PlanPointer = std::shared_ptr<const PlanHandle>;

        struct Question
        {
            PlannerParameters parameters;
            PlanLimits limits;
        };

        Question questionFrom(const py::object &timeLimit, const py::object &anytime, const py::object &maxExpansions,
                              const py::kwargs &parameters)
        {
            Question question;
            question.parameters = parametersFrom(parameters);
            // The default is allowed: the parameters of another plan contain it.
            if (question.parameters.turningRadius != PlannerParameters().turningRadius)
                throw Error("turning_radius has no effect: the vehicle defines it by wheelbase and max_steering_angle");
            question.parameters.anytime = flagFrom(anytime, "anytime");
            question.limits.expansions = countFrom(maxExpansions, "max_expansions");
            question.limits.time = numberFrom(timeLimit, "time_limit");
            if (!(question.limits.time > 0.0))
                throw Error("time_limit must be a positive number of seconds, not " +
                            formatNumber(question.limits.time));
            if (question.parameters.anytime && std::isinf(question.limits.time) && question.limits.expansions == 0)
                throw Error("anytime requires a finite time_limit or max_expansions");
            return question;
        }

        PlanPointer planScenario(const py::object &problem, const py::object &timeLimit, const py::object &anytime,
                                 const py::object &maxExpansions, const py::kwargs &parameters)
        {
            const auto scenario = scenarioFrom(problem, "scenario");
            Question question = questionFrom(timeLimit, anytime, maxExpansions, parameters);
            Signals signals;
            question.limits.interrupted = [&signals]
            {
                return signals.arrived();
            };
            PlanPointer result;
            {
                const py::gil_scoped_release release;
                if (const ScenarioPlanner *planner = scenario->planner(question.limits.interrupted))
                    result = std::make_shared<const PlanHandle>(
                        scenario, planner->plan(question.parameters, question.limits), question.parameters);
            }
            signals.raise();
            return result;
        }

        /** Plans many scenarios in its own threads, while the calling thread handles signals. */
        class Batch
        {
        public:
            Batch(std::vector<ScenarioPointer> scenarios, Question question)
              : scenarios_(std::move(scenarios)),
                question_(std::move(question)),
                results_(scenarios_.size()),
                errors_(scenarios_.size())
            {
                question_.limits.interrupted = [this]
                {
                    return stop_.load(std::memory_order_relaxed);
                };
            }

            /** Call it without the interpreter's lock. */
            void run(std::size_t threads, Signals &signals)
            {
                const std::size_t count = std::max<std::size_t>(1, std::min(threads, scenarios_.size()));
                std::vector<std::thread> workers;
                workers.reserve(count);
                working_ = count;
                try
                {
                    while (workers.size() < count)
                        workers.emplace_back([this] { work(); });
                }
                catch (const std::exception &)
                {
                    // The system refuses more threads: the running ones, or this one, do all of the work.
                    const std::lock_guard<std::mutex> lock(mutex_);
                    working_ -= count - workers.size();
                }
                if (workers.empty())
                {
                    question_.limits.interrupted = [this, &signals]
                    {
                        return stop_ = signals.arrived();
                    };
                    working_ = 1;
                    work();
                }
                {
                    std::unique_lock<std::mutex> lock(mutex_);
                    while (!done_.wait_for(lock, std::chrono::milliseconds(3), [this] { return working_ == 0; }))
                    {
                        lock.unlock();
                        if (signals.ask())
                            stop_ = true;
                        lock.lock();
                    }
                }
                for (std::thread &worker : workers)
                    worker.join();
            }

            std::vector<PlanPointer> results() const
            {
                for (std::size_t i = 0; i < errors_.size(); ++i)
                    if (!errors_[i].empty())
                        throw Error("scenarios[" + std::to_string(i) + "]: " + errors_[i]);
                return results_;
            }

        private:
            void work()
            {
                for (std::size_t i = next_++; i < scenarios_.size() && !stop_; i = next_++)
                    try
                    {
                        if (const ScenarioPlanner *planner = scenarios_[i]->planner(question_.limits.interrupted))
                            results_[i] = std::make_shared<const PlanHandle>(
                                scenarios_[i], planner->plan(question_.parameters, question_.limits),
                                question_.parameters);
                    }
                    catch (const std::exception &error)
                    {
                        errors_[i] = error.what();
                    }
                const std::lock_guard<std::mutex> lock(mutex_);
                --working_;
                done_.notify_one();
            }

            std::vector<ScenarioPointer> scenarios_;
            Question question_;
            std::vector<PlanPointer> results_;
            std::vector<std::string> errors_;
            std::atomic<std::size_t> next_{0};
            std::atomic<bool> stop_{false};
            std::size_t working_{0};
            std::mutex mutex_;
            std::condition_variable done_;
        };

        std::vector<PlanPointer> planBatch(const py::object &scenarios, const py::object &threads,
                                           const py::object &timeLimit, const py::object &anytime,
                                           const py::object &maxExpansions, const py::kwargs &parameters)
        {
            std::vector<ScenarioPointer> list;
            if (!py::isinstance<py::iterable>(scenarios) || py::isinstance<py::str>(scenarios))
                throw Error("scenarios must be a list of Scenario");
            for (const py::handle each : scenarios)
                list.push_back(scenarioFrom(each, "scenarios[" + std::to_string(list.size()) + "]"));
            const std::size_t wanted = countFrom(threads, "threads");
            Batch batch(std::move(list), questionFrom(timeLimit, anytime, maxExpansions, parameters));
            Signals signals;
            {
                const std::size_t count = wanted > 0 ? wanted : std::max(1U, std::thread::hardware_concurrency());
                const py::gil_scoped_release release;
                batch.run(count, signals);
            }
            signals.raise();
            return batch.results();
        }

        py::dict searchStatistics(const PlanHandle &self)
        {
            const ScenarioPlan &plan = self.plan();
            py::dict result;
            result["expanded"] = plan.statistics.expanded;
            result["generated"] = plan.statistics.generated;
            result["connections"] = plan.statistics.connections;
            result["heuristic_cells"] = plan.statistics.heuristicCells;
            result["open_list_operations"] = plan.statistics.openListOperations;
            result["open_list_comparisons"] = plan.statistics.openListComparisons;
            result["state_checks"] = plan.checks.states;
            result["exact_checks"] = plan.checks.byContactTest;
            result["planning_time"] = plan.planningTime;
            result["map_loading_time"] = self.scenario().loadingTime() + plan.loadingTime;
            return result;
        }
    }  // namespace

    void addPlans(py::module_ &module)
    {
        py::class_<PathHandle, std::shared_ptr<PathHandle>> path(module, "Drive",
                                                                 "A path in a scenario, common base of Result and "
                                                                 "ParkingPlan.");
        addPathProperties(path);

        py::class_<PlanHandle, PathHandle, std::shared_ptr<PlanHandle>>(module, "Result", R"(Result of plan().

It is True if the path reaches a goal exactly. Arrays are created on first use and then kept.)")
            .def_property_readonly(
                "status", [](const PlanHandle &self) { return statusName(self.plan().outcome); },
                "Status: exact, approximate, timeout, infeasible, invalid_start, invalid_goal or escaped (a path to a "
                "goal "
                "that begins with an escape from contact).")
            .def_property_readonly(
                "reason", [](const PlanHandle &self) { return self.plan().reason; },
                "Reason why there is no exact solution; empty otherwise.")
            .def_property_readonly(
                "notice", [](const PlanHandle &self) { return self.plan().notice; },
                "One line on an escape, or on straights shorter than the parameters require; empty otherwise.")
            .def_property_readonly(
                "escape",
                [](const PlanHandle &self) -> py::object
                {
                    if (!self.plan().escape)
                        return py::none();
                    const Escape &escape = *self.plan().escape;
                    py::dict result;
                    result["depth"] = escape.depth;
                    result["length"] = escape.arc.length;
                    result["curvature"] = escape.arc.curvature;
                    return result;
                },
                "Escape from contact with which the path begins, a dict: depth of the contact and signed length in "
                "metres, curvature in 1/m. None without an escape.")
            .def_property_readonly(
                "cost", [](const PlanHandle &self) { return self.plan().cost; },
                "Cost in metres: length and penalties; infinite without a solution.")
            .def_property_readonly(
                "bound", [](const PlanHandle &self) { return self.plan().suboptimalityBound; },
                "Ratio of the cost to a lower bound of the cost of any path (see docs/planner.md); infinite if "
                "unknown.")
            .def_property_readonly(
                "goal",
                [](const PlanHandle &self) -> py::object
                {
                    if (!self.hasPath())
                        return py::none();
                    const Scenario &scenario = self.scenario().scenario();
                    return toPython(scenario.toWorld(scenario.goals.at(self.plan().goal)));
                },
                "Goal pose that the path reaches or approaches; None without a path.")
            .def_property_readonly("statistics", &searchStatistics,
                                   "Statistics of the search, a dict: expanded, generated, connections, "
                                   "heuristic_cells, open_list_operations, "
                                   "open_list_comparisons, state_checks, exact_checks, "
                                   "planning_time and map_loading_time in seconds.")
            .def_property_readonly(
                "parameters", [](const PlanHandle &self) { return toPython(self.parameters()); },
                "All parameters of the planner, as a dict.")
            .def(py::pickle([](const PlanHandle &self) { return stateOf(self); }, &planOf))
            .def("__bool__", [](const PlanHandle &self) { return self.plan().outcome == search::PlanOutcome::Solved; })
            .def("__repr__",
                 [](const PlanHandle &self)
                 {
                     const std::string status = statusName(self.plan().outcome);
                     if (!self.hasPath())
                         return "Result(" + status + ")";
                     return "Result(" + status + ", " + formatNumber(std::round(100.0 * self.path().length()) / 100.0) +
                            " m, " + std::to_string(self.path().cusps()) + " cusps)";
                 });

        static const std::string ABOUT_PLAN =
            "Plans a path from the start of a scenario to its goal, or to the nearest of several.\n\n"
            "time_limit : seconds\n"
            "anytime : whether to improve the path until the time limit\n"
            "max_expansions : limit of the number of expansions, independent of any clock; 0: no limit\n\n"
            "Other Python threads continue during the search, and Ctrl-C interrupts it. Parameters:\n\n" +
            parameterLines() + "\nReturns a Result. Raises Error for an invalid value.";
        module.def("plan", &planScenario, py::arg("scenario"), py::arg("time_limit") = 1.0, py::arg("anytime") = false,
                   py::arg("max_expansions") = 0, ABOUT_PLAN.c_str());
        module.def(
            "plan_batch", &planBatch, py::arg("scenarios"), py::arg("threads") = 0, py::arg("time_limit") = 1.0,
            py::arg("anytime") = false, py::arg("max_expansions") = 0,
            "Plans many scenarios in parallel and returns their Results in the same order.\n\nthreads : number of "
            "threads; 0 for one per core\n\nThe other arguments are those of plan().");
        module.def("_parameter_table",
                   []
                   {
                       py::list table;
                       const py::dict defaults = toPython(PlannerParameters());
                       for (const Parameter &row : parameterTable())
                           table.append(py::make_tuple(row.name, defaults[py::str(row.name)], row.allowed(), row.unit,
                                                       row.meaning));
                       return table;
                   });
    }
}  // namespace parking::python
