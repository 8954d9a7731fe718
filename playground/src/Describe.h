#pragma once

#include <string>

namespace parking::playground
{
    /** \brief The table of parameters as JSON, see playground_parameters(). */
    std::string parametersJson();

    /** \brief The known cars as JSON. */
    std::string vehiclesJson();
}  // namespace parking::playground
