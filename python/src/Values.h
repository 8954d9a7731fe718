#pragma once

#include "ompl_improved_astar/search/planning/Parameters.h"
#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Polygon.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"

#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

// Conversions between values of Python and of the project. Invalid values throw parking::Error naming the field.
namespace parking::python
{
    namespace py = pybind11;

    /** \brief An array of doubles. It shares the memory of an argument of the same type. */
    using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

    /** \brief Throws "FIELD must be RIGHT, not VALUE". */
    [[noreturn]] void failFor(const py::handle &value, const std::string &field, const std::string &right);

    /** \brief Throws unless \e value is a number. */
    double numberFrom(const py::handle &value, const std::string &field);

    /** \brief Throws unless \e value is True or False. */
    bool flagFrom(const py::handle &value, const std::string &field);

    /** \brief Throws unless \e value is a whole number that is not negative. */
    std::size_t countFrom(const py::handle &value, const std::string &field);

    /** \brief Throws unless \e value is a str. */
    std::string textFrom(const py::handle &value, const std::string &field);

    /** \brief Throws unless \e value is three numbers: x and y in metres, yaw in radians. */
    Pose poseFrom(const py::handle &value, const std::string &field);

    /** \brief Throws unless \e value is an array of n rows x, y, in metres. */
    Polygon polygonFrom(const py::handle &value, const std::string &field);

    /** \brief Creates a map from a 2-D array of whole numbers or bool, the first row lowest: 0 free, 1 occupied, -1 or
        2 unknown. \param resolution metres per cell \param origin of the lower left corner */
    OccupancyGrid gridFrom(const py::handle &cells, double resolution, const Pose &origin);

    /** \brief Converts \e value to an array of n rows x, y, yaw. */
    Doubles posesFrom(const py::handle &value, const std::string &field);

    /** \brief Creates a path from rows x, y, yaw; further columns are ignored. One arc joins two states. Throws
        parking::Error for rows that no arc joins. */
    Path pathFrom(const py::handle &value, const Scenario &scenario);

    /** \brief Converts a pose to the tuple x, y, yaw. */
    py::tuple toPython(const Pose &pose);

    /** \brief A read-only array that shares memory of \e owner. */
    template <class Value>
    py::array view(const Value *data, std::vector<py::ssize_t> shape, const py::handle &owner)
    {
        py::array_t<Value> array(std::move(shape), data, owner);
        py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
        return std::move(array);
    }

    /** \brief Reads parameters by the names of parameterTable(). */
    PlannerParameters parametersFrom(const py::dict &values);

    /** \brief Returns all parameters by the names of parameterTable(). */
    py::dict toPython(const PlannerParameters &parameters);

    /** \brief The parameters as lines of a docstring. */
    std::string parameterLines();
}  // namespace parking::python
