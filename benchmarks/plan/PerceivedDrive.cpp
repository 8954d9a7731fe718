#include "benchmarks/plan/PerceivedDrive.h"

#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <memory>
#include <string_view>

namespace parking
{
    namespace
    {
        constexpr std::size_t MAX_PLANS = 10;              // with the car at rest: it may see obstacles on every way
        constexpr double MAX_RANGE = 1e3, MAX_RATE = 1e3;  // metres; frames per second
    }                                                      // namespace

    SensorParameters sensorOf(const std::string &name, const std::string &text)
    {
        SensorParameters sensor;
        const std::size_t comma = text.find(',');
        const std::string range(trimmed(std::string_view(text).substr(0, comma)));
        if (range.empty() || (comma != std::string::npos && text.find(',', comma + 1) != std::string::npos))
            throw Error(name + " must be RANGE or RANGE,RATE, for example 20,10, not " + inQuotes(text));
        sensor.range = positiveNumber(name + ": the range in metres", range, MAX_RANGE);
        if (comma != std::string::npos)
            sensor.rate = positiveNumber(name + ": the rate in frames per second",
                                         std::string(trimmed(std::string_view(text).substr(comma + 1))), MAX_RATE);
        return sensor;
    }

    ParkingResult perceivedDrive(const Scenario &scenario, const SensorParameters &sensor, bool stopsToPlan)
    {
        ParkingParameters parameters;
        if (stopsToPlan)
            parameters.reactionTime = 0.0;
        parameters.maxReplans = MAX_PLANS;
        AutomaticParking parking(parameters);
        parking.setPerception(std::make_shared<SimulatedSensor>(scenario, sensor));
        return parking.park(scenario);
    }
}  // namespace parking
