#pragma once

#include "parking_geometry/MakeScenario.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/io/Yaml.h"

#include <cstddef>
#include <string>

namespace parking
{
    /** \brief Size limit in bytes of a text file: case, scenario, vehicle or map description. */
    constexpr std::size_t TEXT_FILE_LIMIT = std::size_t(16) << 20;

    /** \brief Default name of a scenario: the last part of \e file without its extension. */
    std::string scenarioName(const std::string &file);

    /** \brief Reads a vehicle from the keys of \e map: name and the fields of Vehicle in snake case. */
    Vehicle vehicleFromYaml(const YamlMap &map);

    /** \brief Parses a TPCAP case, see readScenario().

        \param file name in errors
        \param vehicle as for readVehicle(); empty for the car of TPCAP */
    Scenario parseTpcapCase(const std::string &file, const std::string &text, const std::string &vehicle);

    /** \brief Parses a scenario in YAML, see readScenario().

        \param file name in errors; relative paths in the text start at its folder
        \param vehicle replaces the vehicle of the text, as for readVehicle(); empty for that of the text */
    Scenario parseYamlScenario(const std::string &file, const std::string &text, const std::string &vehicle);
}  // namespace parking
