#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioParts.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/Text.h"

namespace parking
{
    namespace
    {
        /** The numbers of a case, taken one after another. */
        class Numbers
        {
        public:
            Numbers(const std::string &file, std::string_view text) : file_(file)
            {
                // A case is one line by definition, but line breaks are accepted too.
                std::size_t begin = 0;
                while (begin <= text.size())
                {
                    const std::size_t end = std::min(text.find_first_of(",\n", begin), text.size());
                    const std::string_view field = trimmed(text.substr(begin, end - begin));
                    const bool betweenLines = field.empty() && (end == text.size() || text[end] == '\n');
                    if (!betweenLines)
                        add(field);
                    begin = end + 1;
                }
            }

            std::size_t left() const
            {
                return values_.size() - next_;
            }
            std::size_t size() const
            {
                return values_.size();
            }

            double take(const std::string &what)
            {
                if (left() == 0)
                    throw Error(file_ + ": too few numbers: the " + std::to_string(values_.size()) +
                                " in the file end before " + what);
                return values_[next_++];
            }

            std::size_t takeCount(const std::string &what)
            {
                const double value = take(what);
                // The bound keeps the conversion defined. The limit on the file's size excludes larger counts.
                constexpr double MAX_COUNT = 1e9;
                if (value < 0.0 || value > MAX_COUNT || value != std::floor(value))
                    throw Error(file_ + ": number " + std::to_string(next_) + " is " + formatNumber(value) + "; " +
                                what + " must be a whole number from 0 to " + formatNumber(MAX_COUNT));
                return static_cast<std::size_t>(value);
            }

        private:
            void add(std::string_view field)
            {
                double value = 0.0;
                if (!parseNumber(field, value))
                    throw Error(file_ + ": number " + std::to_string(values_.size() + 1) + " is " + inQuotes(field) +
                                "; it must be a finite decimal number");
                values_.push_back(value);
            }

            const std::string &file_;
            std::vector<double> values_;
            std::size_t next_{0};
        };

        Pose takePose(Numbers &numbers, const std::string &what)
        {
            Pose pose;
            pose.x = numbers.take(what + " x");
            pose.y = numbers.take(what + " y");
            pose.yaw = wrapAngle(numbers.take(what + " yaw"));
            return pose;
        }

        std::vector<std::size_t> takeVertexCounts(const std::string &file, Numbers &numbers)
        {
            const std::size_t obstacles = numbers.takeCount("the number of obstacles");
            if (obstacles > numbers.left())
                throw Error(file + ": too few numbers: " + std::to_string(obstacles) + " obstacles are announced and " +
                            std::to_string(numbers.left()) + " numbers follow");
            std::vector<std::size_t> counts;
            std::size_t vertices = 0;
            for (std::size_t i = 1; i <= obstacles; ++i)
            {
                const std::string which = "obstacle " + std::to_string(i);
                const std::size_t count = numbers.takeCount("the vertex count of " + which);
                if (count < 3)
                    throw Error(file + ": " + which + " has " + std::to_string(count) +
                                " corners; a polygon needs at least 3");
                counts.push_back(count);
                vertices += count;
            }
            if (numbers.left() != 2 * vertices)
                throw Error(file + ": too " + (numbers.left() < 2 * vertices ? "few" : "many") +
                            " numbers: the vertex counts require " + std::to_string(2 * vertices) +
                            " coordinates and the file holds " + std::to_string(numbers.left()));
            return counts;
        }
    }  // namespace

    Scenario parseTpcapCase(const std::string &file, const std::string &text, const std::string &vehicle)
    {
        Numbers numbers(file, text);
        Scenario scenario;
        scenario.name = scenarioName(file);
        scenario.files = {file};
        if (!vehicle.empty())
            scenario.vehicle = readVehicle(vehicle, &scenario.files);
        const Pose start = takePose(numbers, "the start's");
        const Pose goal = takePose(numbers, "the goal's");

        // Coordinates become relative to the start before any arithmetic, because some cases lie at 4e9 m.
        scenario.worldOffset = {start.x, start.y};
        scenario.start = {0.0, 0.0, start.yaw};
        scenario.goals = {{goal.x - start.x, goal.y - start.y, goal.yaw}};
        for (const std::size_t count : takeVertexCounts(file, numbers))
        {
            Polygon polygon;
            polygon.reserve(count);
            for (std::size_t i = 0; i < count; ++i)
            {
                const double x = numbers.take("a vertex"), y = numbers.take("a vertex");
                polygon.emplace_back(x - start.x, y - start.y);
            }
            scenario.polygons.push_back(std::move(polygon));
        }
        completeScenario(scenario, file);
        return scenario;
    }
}  // namespace parking
