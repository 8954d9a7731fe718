#pragma once

#include "python/src/Handles.h"

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

    /** \brief The scenario that a Python object is; throws parking::Error naming \e field otherwise. */
    ScenarioPointer scenarioFrom(const pybind11::handle &value, const std::string &field);
}  // namespace parking::python
