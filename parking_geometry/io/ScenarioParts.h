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

    /** \brief A TPCAP case, see readScenario().

        \param file named in errors
        \param vehicle as for readVehicle(); empty: the car of TPCAP */
    Scenario parseTpcapCase(const std::string &file, const std::string &text, const std::string &vehicle);

    /** \brief A scenario in YAML, see readScenario().

        \param file named in errors, and where a vehicle file that it names is looked for
        \param vehicle as for readVehicle(), in the place of the one that the text names; empty: that one */
    Scenario parseYamlScenario(const std::string &file, const std::string &text, const std::string &vehicle);
}  // namespace parking
