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
    module.doc() = "Extension module of the package improved_astar. Use the package instead.";
    module.attr("__version__") = PARKING_VERSION;
    py::register_exception<parking::Error>(module, "Error", PyExc_ValueError).doc() =
        "Invalid value or file. The one-line message names the field or file and a valid alternative.";
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
    parking::python::addDrivingCosts(module);
    // For the project's Python programs, so that they read, write and report errors as those in C++ do.
    module.def("_read_file", [](const std::filesystem::path &file, std::size_t limit)
               { return py::bytes(parking::readFile(file.string(), limit)); });
    module.def("_write_file", [](const std::filesystem::path &file, const std::string &content)
               { parking::writeFileAtomically(file.string(), content); });
    module.def("_unknown_name", &parking::unknownName);
    // Imported here: the first plan would wait for it, and Ctrl-C could interrupt the import.
    py::module_::import("numpy");
    py::module_::import("atexit").attr("register")(
        py::cpp_function(&parking::python::finishBackgroundWork, py::call_guard<py::gil_scoped_release>()));
}
