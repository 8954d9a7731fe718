// Scenes of Bench-MR (github.com/robot-motion/bench-mr, bin/polygon_mazes): SVG as Inkscape writes it, a path for each
// obstacle, a user unit for a metre.
//
// As Bench-MR reads them: the translation of the latest group applies, y points up, and an obstacle is the convex hull
// of its corners. Its poses are of the middle of the body, round which the car turns; that is a car whose rear axle is
// there. Start and goal are not in the scenes: they are options, or attributes data-start and data-goal of our own.

#include "benchmarks/formats/ScenarioFormat.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/MakeScenario.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/Text.h"
#include "parking_geometry/text/WriteFile.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace parking
{
    namespace
    {
        constexpr std::size_t LARGEST = std::size_t(16) << 20;  // bytes

        /** The body of bin/polygon_mazes/car.svg, and the turning radius of experiments/parking.cpp. */
        Vehicle benchMrCar()
        {
            Vehicle car;
            car.name = "bench_mr";
            car.wheelbase = 2.0;
            car.rearOverhang = 0.5 * 4.253328;
            car.frontOverhang = 0.5 * 4.253328 - car.wheelbase;
            car.width = 2.433862;
            car.maxSteeringAngle = std::atan(car.wheelbase / 4.0);
            return car;
        }

        /** The commands of a path's d and their numbers, one after another. */
        class PathData
        {
        public:
            PathData(const std::string &file, std::string_view text) : file_(file), text_(text)
            {
            }

            /** The next command; 0 at the end. */
            char command()
            {
                skip();
                if (place_ >= text_.size())
                    return 0;
                const char c = text_[place_];
                if (std::isalpha(static_cast<unsigned char>(c)) != 0)
                {
                    ++place_;
                    // Pairs after a move are lines.
                    last_ = c == 'm' ? 'l' : c == 'M' ? 'L' : c;
                    return c;
                }
                if (last_ == 0 || last_ == 'z')
                    throw Error(file_ + ": a path begins with " + inQuotes(text_.substr(0, 20)) +
                                "; it must begin with m or M");
                return last_;
            }

            double number()
            {
                skip();
                const std::size_t begin = place_;
                // A sign begins a new number but behind an exponent.
                while (place_ < text_.size() &&
                       (std::isdigit(static_cast<unsigned char>(text_[place_])) != 0 || text_[place_] == '.' ||
                        text_[place_] == 'e' || text_[place_] == 'E' ||
                        ((text_[place_] == '-' || text_[place_] == '+') &&
                         (place_ == begin || text_[place_ - 1] == 'e' || text_[place_ - 1] == 'E'))))
                    ++place_;
                double value = 0.0;
                if (!parseNumber(text_.substr(begin, place_ - begin), value))
                    throw Error(file_ + ": no number at " + inQuotes(text_.substr(begin, 20)) + " in a path");
                return value;
            }

        private:
            void skip()
            {
                while (place_ < text_.size() &&
                       (std::isspace(static_cast<unsigned char>(text_[place_])) != 0 || text_[place_] == ','))
                    ++place_;
            }

            const std::string &file_;
            std::string_view text_;
            std::size_t place_{0};
            char last_{0};
        };

        Polygon cornersOf(const std::string &file, std::string_view text)
        {
            PathData data(file, text);
            Polygon corners;
            Eigen::Vector2d at(0.0, 0.0);
            while (const char command = data.command())
            {
                switch (command)
                {
                    case 'm':
                    case 'l':
                        at.x() += data.number();
                        at.y() += data.number();
                        break;
                    case 'M':
                    case 'L':
                        at.x() = data.number();
                        at.y() = data.number();
                        break;
                    case 'h':
                        at.x() += data.number();
                        break;
                    case 'H':
                        at.x() = data.number();
                        break;
                    case 'v':
                        at.y() += data.number();
                        break;
                    case 'V':
                        at.y() = data.number();
                        break;
                    case 'z':
                    case 'Z':
                        continue;
                    default:
                        throw Error(file + ": the command " + inQuotes(std::string(1, command)) +
                                    " of a path is not understood; obstacles are made of straight lines (m l h v z)");
                }
                corners.push_back(at);
            }
            return corners;
        }

        /** Counter-clockwise (Andrew's monotone chain). */
        Polygon convexHull(Polygon points)
        {
            std::sort(points.begin(), points.end(),
                      [](const Eigen::Vector2d &a, const Eigen::Vector2d &b)
                      { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
            Polygon hull;
            for (int pass = 0; pass < 2; ++pass)
            {
                const std::size_t kept = hull.size();
                for (const Eigen::Vector2d &point : points)
                {
                    while (hull.size() >= kept + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0.0)
                        hull.pop_back();
                    hull.push_back(point);
                }
                hull.pop_back();
                std::reverse(points.begin(), points.end());
            }
            return hull;
        }

        /** The value of an attribute that begins at \e place; \e place moves behind it. */
        std::string_view valueAt(const std::string &file, std::string_view text, std::size_t &place)
        {
            const char quote = place < text.size() ? text[place] : '\0';
            const std::size_t end =
                quote == '"' || quote == '\'' ? text.find(quote, place + 1) : std::string_view::npos;
            if (end == std::string_view::npos)
                throw Error(file + ": an attribute is not closed");
            const std::string_view value = text.substr(place + 1, end - place - 1);
            place = end + 1;
            return value;
        }

        std::optional<Pose> poseOf(const std::string &file, std::string_view text, const std::string &attribute)
        {
            std::size_t place = text.find(attribute + "=");
            if (place == std::string_view::npos)
                return std::nullopt;
            place += attribute.size() + 1;
            PathData data(file, valueAt(file, text, place));
            const double x = data.number(), y = data.number();
            return Pose{x, y, data.number()};
        }

        Scenario parse(const std::string &file, const std::string &text, const FormatOptions &options)
        {
            Scenario scenario;
            scenario.files = {file};
            scenario.name = std::filesystem::path(file).stem().string();
            scenario.vehicle = options.vehicle.empty() ? benchMrCar() : readVehicle(options.vehicle, &scenario.files);
            Eigen::Vector2d shift(0.0, 0.0);
            const std::string move = "transform=", path = "d=";
            for (std::size_t place = 0; place < text.size();)
            {
                const bool begins = place > 0 && std::isspace(static_cast<unsigned char>(text[place - 1])) != 0;
                if (begins && text.compare(place, move.size(), move) == 0)
                {
                    place += move.size();
                    const std::string_view value = valueAt(file, text, place);
                    if (value.substr(0, 10) != "translate(")
                        throw Error(file + ": " + inQuotes(value) + " is not understood; groups are translated only");
                    PathData data(file, value.substr(10, value.find(')') - 10));
                    shift.x() = data.number();
                    shift.y() = data.number();
                }
                else if (begins && text.compare(place, path.size(), path) == 0)
                {
                    place += path.size();
                    Polygon corners = cornersOf(file, valueAt(file, text, place));
                    for (Eigen::Vector2d &corner : corners)
                        corner = {corner.x() + shift.x(), -(corner.y() + shift.y())};
                    Polygon hull = convexHull(std::move(corners));
                    if (hull.size() < 3)
                        throw Error(file + ": obstacle " + std::to_string(scenario.polygons.size() + 1) +
                                    " has no area");
                    scenario.polygons.push_back(std::move(hull));
                }
                else
                    ++place;
            }
            if (text.find("</svg>") == std::string::npos)
                throw Error(file + ": ends without </svg>, so that something is missing");
            if (scenario.polygons.empty())
                throw Error(file + ": holds no path, so no obstacle");
            const std::optional<Pose> start = options.start ? options.start : poseOf(file, text, "data-start");
            const std::optional<Pose> goal = options.goal ? options.goal : poseOf(file, text, "data-goal");
            if (!start || !goal)
            {
                // Whichever program reads it: this one has the options.
                const std::string point = options.vehicle.empty() ? "body" : "rear axle";
                throw Error(file + ": a scene of Bench-MR says " +
                            (start  ? "no goal; parking_convert takes --goal X,Y,YAW"
                             : goal ? "no start; parking_convert takes --start X,Y,YAW"
                                    : "neither start nor goal; parking_convert takes --start X,Y,YAW and --goal "
                                      "X,Y,YAW") +
                            " (of the middle of the " + point + ") and writes a file that says so");
            }
            scenario.start = *start;
            scenario.goals = {*goal};
            return makeScenario(std::move(scenario), file);
        }

        std::string attribute(const Pose &pose)
        {
            return formatNumber(pose.x) + " " + formatNumber(pose.y) + " " + formatNumber(pose.yaw);
        }

        void write(const Scenario &scenario, const std::string &file)
        {
            const std::vector<Polygon> polygons = obstaclePolygons(scenario);
            Eigen::Vector2d low(0.0, 0.0), high(0.0, 0.0);
            bool first = true;
            for (const Polygon &polygon : polygons)
                for (const Eigen::Vector2d &corner : polygon)
                {
                    low = first ? corner : low.cwiseMin(corner);
                    high = first ? corner : high.cwiseMax(corner);
                    first = false;
                }
            // An attribute a line, as Bench-MR's reader wants them.
            std::string text =
                "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"\n   "
                "viewBox=\"" +
                formatNumber(low.x()) + " " + formatNumber(-high.y()) + " " + formatNumber(high.x() - low.x()) + " " +
                formatNumber(high.y() - low.y()) + "\"\n   data-start=\"" +
                attribute(scenario.toWorld(scenario.start)) + "\"\n   data-goal=\"" +
                attribute(scenario.toWorld(scenario.goals.front())) + "\">\n  <g\n     transform=\"translate(0,0)\">\n";
            for (const Polygon &polygon : polygons)
            {
                text += "    <path\n       d=\"";
                for (std::size_t i = 0; i < polygon.size(); ++i)
                    text +=
                        (i == 0 ? "M " : " L ") + formatNumber(polygon[i].x()) + "," + formatNumber(-polygon[i].y());
                text += " z\"\n       style=\"fill:#c7c7c7\" />\n";
            }
            writeFileAtomically(file, text + "  </g>\n</svg>\n");
        }
    }  // namespace

    ScenarioFormat benchMrFormat()
    {
        return {"benchmr",
                ".svg",
                "polygon scenes of Bench-MR; obstacles are convex, start and goal are options of parking_convert",
                [](std::string_view begin) { return begin.find("<svg") != std::string_view::npos; },
                LARGEST,
                parse,
                write};
    }
}  // namespace parking
