#pragma once

#include "parking_geometry/ParkingSlot.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/Vehicle.h"
#include "python/src/Handles.h"

#include <pybind11/pybind11.h>

// What the module's objects are to pickle, and back: numbers stay the same to the last bit.
namespace parking::python
{
    pybind11::tuple stateOf(const Vehicle &vehicle);    ///< name and fields
    pybind11::tuple stateOf(const ParkingSlot &slot);   ///< its members
    pybind11::tuple stateOf(const Scenario &scenario);  ///< its members, in local coordinates
    pybind11::tuple stateOf(const PlanHandle &plan);    ///< the scenario, what was planned with and came out
    Vehicle vehicleOf(const pybind11::tuple &state);    ///< of stateOf()
    ParkingSlot slotOf(const pybind11::tuple &state);   ///< of stateOf()
    Scenario scenarioOf(const pybind11::tuple &state);  ///< of stateOf()
    std::shared_ptr<PlanHandle> planOf(const pybind11::tuple &state);  ///< of stateOf()
}  // namespace parking::python
