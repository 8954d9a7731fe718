#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace parking
{
    /** \brief Versions and machine as experiment parameters of OMPL's database: "name TYPE" and value. */
    nlohmann::json machineParameters();

    /** \brief The same and more in words. */
    std::string machineText();
}  // namespace parking
