#pragma once

#include "parking_geometry/MakeScenario.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/io/Yaml.h"

#include <cstddef>
#include <string>

namespace parking
{
    /** \brief Most bytes of a text file (case, scenario, vehicle, map description) that are read. */
    constexpr std::size_t TEXT_FILE_LIMIT = std::size_t(16) << 20;

    /** \brief The last part of \e file without its extension: what a scenario is called that has no name. */
    std::string scenarioName(const std::string &file);

    /** \brief The keys of a vehicle in files: name and the fields of Vehicle in snake case. */
    Vehicle vehicleFromYaml(const YamlMap &map);

    // Readers of the formats, from text that is already in memory. \e file is named in errors.
    Scenario parseTpcapCase(const std::string &file, const std::string &text, const std::string &vehicle);
    Scenario parseYamlScenario(const std::string &file, const std::string &text, const std::string &vehicle);
}  // namespace parking
