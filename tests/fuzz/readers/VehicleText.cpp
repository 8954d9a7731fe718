// Files of vehicles.

#include "parking_geometry/io/ScenarioParts.h"
#include "tests/fuzz/Fuzz.h"

#include <cmath>

namespace parking_test::fuzz
{
    void tryInput(const std::string &input)
    {
        accepts("fuzzed.yaml",
                [&input]
                {
                    const parking::Vehicle car = parking::vehicleFromYaml(parking::YamlMap("fuzzed.yaml", input));
                    car.validate();
                    if (!(car.minTurningRadius() > 0.0) || !(car.length() > 0.0) || !std::isfinite(car.length()))
                        fail("a car that cannot be");
                });
    }
}  // namespace parking_test::fuzz
