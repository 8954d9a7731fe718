#pragma once

#include "python/src/Handles.h"

#include <memory>

#include <pybind11/pybind11.h>

namespace parking::python
{
    /** \brief What both kinds of result show of their paths. */
    void addPathProperties(pybind11::class_<PathHandle, std::shared_ptr<PathHandle>> &type);
}  // namespace parking::python
