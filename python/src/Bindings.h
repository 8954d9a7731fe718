#pragma once

#include "python/src/Handles.h"

#include <memory>
#include <string>

#include <pybind11/pybind11.h>

// The parts of the module, in the order in which they must be added.
namespace parking::python
{
    void addVehicles(pybind11::module_ &module);      ///< adds Vehicle, Slot, vehicles()
    void addScenarios(pybind11::module_ &module);     ///< adds Scenario
    void addPlans(pybind11::module_ &module);         ///< adds Drive, Result, plan()
    void addParking(pybind11::module_ &module);       ///< adds ParkingPlan, ParkingPlanner
    void addReferee(pybind11::module_ &module);       ///< adds Verdict, check()
    void addOmplPlanning(pybind11::module_ &module);  ///< adds what improved_astar.ompl is made of
    void addDrivingCosts(pybind11::module_ &module);  ///< adds the costs of its DrivingCostObjective

    /** \brief Adds the properties of Drive, the common base of both kinds of results. */
    void addPathProperties(pybind11::class_<PathHandle, std::shared_ptr<PathHandle>> &type);

    /** \brief Returns the scenario of a Python object. Throws parking::Error naming \e field for other objects. */
    ScenarioPointer scenarioFrom(const pybind11::handle &value, const std::string &field);
}  // namespace parking::python
