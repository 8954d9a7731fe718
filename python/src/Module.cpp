// The extension module improved_astar._core.
#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/WriteFile.h"
#include "python/src/Background.h"
#include "python/src/Bindings.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <string>

#ifndef PARKING_VERSION
#define PARKING_VERSION "unknown"
#endif

PYBIND11_MODULE(_core, module)
{
    namespace py = pybind11;
    py::options options;
    options.disable_function_signatures();  // the stubs have them
    module.doc() = "The planner's core. Use the package improved_astar.";
    module.attr("__version__") = PARKING_VERSION;
    py::register_exception<parking::Error>(module, "Error", PyExc_ValueError).doc() =
        "A bad value or file: one line that names the field or the file and says what would be right.";
    py::register_exception_translator(
        [](std::exception_ptr thrown)
        {
            try
            {
                if (thrown)
                    std::rethrow_exception(thrown);
            }
            catch (const parking::Error &error)
            {
                // Names of files may hold anything; the message is one line all the same.
                std::string text = error.what();
                std::replace_if(
                    text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, '?');
                PyErr_SetString(py::module_::import("improved_astar._core").attr("Error").ptr(), text.c_str());
            }
        });
    parking::python::addVehicles(module);
    parking::python::addScenarios(module);
    parking::python::addPlans(module);
    parking::python::addParking(module);
    parking::python::addReferee(module);
    parking::python::addOmplPlanning(module);
    // For the project's programs in Python, which so read, write and complain as those in C++ do.
    module.def("_read_file", [](const std::filesystem::path &file, std::size_t limit)
               { return py::bytes(parking::readFile(file.string(), limit)); });
    module.def("_write_file", [](const std::filesystem::path &file, const std::string &content)
               { parking::writeFileAtomically(file.string(), content); });
    module.def("_unknown_name", &parking::unknownName);
    // At once: within the first plan it would take its time, and be left half read by Ctrl-C.
    py::module_::import("numpy");
    py::module_::import("atexit").attr("register")(
        py::cpp_function(&parking::python::finishBackgroundWork, py::call_guard<py::gil_scoped_release>()));
}
