// The same parking problem in ever larger maps: what depends on the size of the map, and what does not?
//
// A car park of 0.2 m cells, its aisles and rows of parked cars repeated in all directions; the car starts in the
// middle and parks 15 m away. Written are a table for the terminal, a figure and, on demand, CSV.

#include "ompl_improved_astar/ImprovedAStar.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/drawing/Svg.h"
#include "parking_geometry/text/WriteFile.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplPose.h"
#include "state_validity/ompl/SweptMotionValidator.h"

#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/util/Console.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <random>
#include <sstream>

namespace ob = ompl::base;
namespace po = boost::program_options;
using namespace parking;

namespace
{
    constexpr double RESOLUTION = 0.2;  // metres
    constexpr double SLOT_WIDTH = 2.6, SLOT_DEPTH = 5.0, AISLE = 6.0;
    constexpr double ROW = 2.0 * SLOT_DEPTH + AISLE;
    constexpr double OCCUPIED_SHARE = 0.8;

    struct Row
    {
        std::size_t side;
        double buildMs, planMs, fromRawMs;
        std::uint64_t expanded, heuristicCells;
        double length, memoryMb;
    };

    double now()
    {
        using namespace std::chrono;
        return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
    }

    double median(std::vector<double> values)
    {
        std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
        return values[values.size() / 2];
    }

    /** The most memory that the process has ever held. */
    double peakMemoryMb()
    {
        std::ifstream file("/proc/self/status");
        for (std::string line; std::getline(file, line);)
            if (line.compare(0, 6, "VmHWM:") == 0)
                return std::stod(line.substr(6)) / 1024.0;
        return std::nan("");
    }

    /** The map's middle is the origin; an aisle runs along y = 0, rows of slots on both sides of it, and so on. */
    OccupancyGrid carPark(std::size_t side)
    {
        const double half = 0.5 * RESOLUTION * static_cast<double>(side);
        OccupancyGrid grid(side, side, RESOLUTION, {-half, -half, 0.0});
        const auto fill = [&](double x0, double y0, double x1, double y1)
        {
            const auto cell = [&](double v)
            {
                return static_cast<std::size_t>(
                    std::clamp((v + half) / RESOLUTION, 0.0, static_cast<double>(side - 1)));
            };
            for (std::size_t row = cell(y0); row <= cell(y1); ++row)
                for (std::size_t column = cell(x0); column <= cell(x1); ++column)
                    grid.set(column, row, Cell::Occupied);
        };
        const int rows = static_cast<int>(half / ROW) + 1, slots = static_cast<int>(half / SLOT_WIDTH) + 1;
        for (int row = -rows; row <= rows; ++row)
            for (int slot = -slots; slot <= slots; ++slot)
                for (const double direction : {-1.0, 1.0})
                {
                    // The same cars whatever the size of the map; a cross aisle every 16 slots; the goal's slot is
                    // free.
                    std::seed_seq seed{row + 1000, slot + 10000, direction > 0.0 ? 1 : 0};
                    std::minstd_rand random(seed);
                    const bool crossAisle = (slot % 16 + 16) % 16 < 3;
                    const bool goal = row == 0 && slot == 6 && direction > 0.0;
                    const double x = slot * SLOT_WIDTH, near = row * ROW + direction * (0.5 * AISLE + 0.3);
                    if (goal || crossAisle || random() > OCCUPIED_SHARE * static_cast<double>(random.max()))
                        continue;
                    const double far = near + direction * 4.4;
                    if (std::max(std::abs(x) + 1.0, std::max(std::abs(near), std::abs(far))) < half)
                        fill(x - 0.9, std::min(near, far), x + 0.9, std::max(near, far));
                }
        return grid;
    }

    /** From a raw grid to a solution. */
    struct Query
    {
        ob::SpaceInformationPtr si;
        std::shared_ptr<ompl::geometric::ImprovedAStar> planner;
        double buildMs, planMs, length;
    };

    Query plan(const OccupancyGrid &grid, const Vehicle &car)
    {
        const double begin = now();
        const double half = 0.5 * RESOLUTION * static_cast<double>(grid.width());
        auto space = std::make_shared<ob::ReedsSheppStateSpace>(car.minTurningRadius());
        ob::RealVectorBounds bounds(2);
        bounds.setLow(-half);
        bounds.setHigh(half);
        space->setBounds(bounds);
        Query query{std::make_shared<ob::SpaceInformation>(space), nullptr, 0.0, 0.0, 0.0};
        query.si->setStateValidityChecker(
            std::make_shared<FclFootprintChecker>(query.si, ObstacleSet::fromGrid(grid), car));
        query.si->setMotionValidator(std::make_shared<SweptMotionValidator>(query.si));
        query.si->setup();
        ob::ScopedState<> start(space), goal(space);
        setPose(start.get(), {0.0, 0.0, 0.0});
        setPose(goal.get(), {6.0 * SLOT_WIDTH, 0.5 * AISLE + 0.3 + 4.4 - car.rearOverhang, -0.5 * PI});
        auto problem = std::make_shared<ob::ProblemDefinition>(query.si);
        problem->setStartAndGoalStates(start, goal);
        query.planner = std::make_shared<ompl::geometric::ImprovedAStar>(query.si);
        query.planner->setProblemDefinition(problem);
        query.planner->setup();
        const double built = now();
        if (query.planner->solve(10.0) != ob::PlannerStatus::EXACT_SOLUTION)
            throw Error("a map of " + std::to_string(grid.width()) + " cells a side: no solution");
        query.planMs = now() - built;
        query.buildMs = built - begin;
        query.length = problem->getSolutionPath()->length();
        return query;
    }

    Row measure(std::size_t side, std::size_t repetitions, const Vehicle &car)
    {
        const OccupancyGrid grid = carPark(side);
        std::vector<double> build, planning, whole;
        Row row{};
        row.side = side;
        for (std::size_t i = 0; i < repetitions; ++i)
        {
            const Query query = plan(grid, car);
            build.push_back(query.buildMs);
            planning.push_back(query.planMs);
            whole.push_back(query.buildMs + query.planMs);
            row.expanded = query.planner->statistics().expanded;
            row.heuristicCells = query.planner->statistics().heuristicCells;
            row.length = query.length;
        }
        row.buildMs = median(build);
        row.planMs = median(planning);
        row.fromRawMs = median(whole);
        row.memoryMb = peakMemoryMb();
        return row;
    }

    void writeFigure(const std::vector<Row> &rows, const std::string &file)
    {
        SvgFigure figure("The same parking problem in ever larger maps",
                         "Maps of 0.2 m cells; the car parks 15 m away from their middle");
        SvgSeries planning{"planning", {}, {}, "", false}, building{"distance field and obstacles", {}, {}, "", false};
        SvgSeries memory{"", {}, {}, "", false};
        for (const Row &row : rows)
        {
            const double side = static_cast<double>(row.side);
            for (SvgSeries *each : {&planning, &building, &memory})
                each->x.push_back(side);
            planning.y.push_back(std::log10(row.planMs));
            building.y.push_back(std::log10(row.buildMs));
            memory.y.push_back(row.memoryMb);
        }
        SvgPlot times;
        times.title = "Time";
        times.xLabel = "cells a side";
        times.yLabel = "log10 of ms";
        times.series = {planning, building};
        figure.addPlot(times);
        SvgPlot space;
        space.title = "Most memory of the whole process";
        space.xLabel = "cells a side";
        space.yLabel = "MB";
        space.series = {memory};
        figure.addPlot(space);
        figure.write(file);
    }

    std::string table(const std::vector<Row> &rows)
    {
        std::ostringstream text;
        text << "| cells a side | map to checker (ms) | planning (ms) | raw map to path (ms) | expanded | heuristic "
                "cells "
                "| length (m) | peak memory (MB) |\n| --: | --: | --: | --: | --: | --: | --: | --: |\n"
             << std::fixed;
        for (const Row &row : rows)
            text << "| " << row.side << " | " << std::setprecision(2) << row.buildMs << " | " << row.planMs << " | "
                 << row.fromRawMs << " | " << row.expanded << " | " << row.heuristicCells << " | " << row.length
                 << " | " << std::setprecision(0) << row.memoryMb << " |\n";
        return text.str();
    }
}  // namespace

int main(int argc, char **argv)
{
    po::options_description options("Options");
    std::vector<std::size_t> sides;
    std::size_t repetitions = 0;
    std::string svg, markdown;
    options.add_options()("help", "show this help")(
        "sides",
        po::value(&sides)->multitoken()->default_value({200, 400, 800, 1200, 2000, 3000, 4000}, "200 ... 4000"),
        "cells a side, smallest first (100 to 10000)")("repetitions", po::value(&repetitions)->default_value(11),
                                                       "medians are of so many")(
        "svg", po::value(&svg), "write the figure to this file")("table", po::value(&markdown), "write the table, too");
    try
    {
        po::variables_map values;
        po::store(po::parse_command_line(argc, argv, options), values);
        po::notify(values);
        if (values.count("help") > 0)
        {
            std::cout << "usage: map_size_study [options]\n\nPlans the same parking problem in ever larger maps.\n\n"
                      << options << "\nExample: map_size_study --svg map_size.svg\n";
            return 0;
        }
        for (const std::size_t side : sides)
            if (side < 100 || side > 10000)
                throw Error("--sides: " + std::to_string(side) + " is not between 100 and 10000");
        if (repetitions == 0)
            throw Error("--repetitions: must be at least 1");
        ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
        std::vector<Row> rows;
        for (const std::size_t side : sides)
        {
            rows.push_back(measure(side, repetitions, vehicleByName("vw_golf8")));
            std::cerr << side << " cells a side: " << rows.back().planMs << " ms\n";
        }
        std::cout << table(rows);
        if (!markdown.empty())
            writeFileAtomically(markdown, table(rows));
        if (!svg.empty())
            writeFigure(rows, svg);
    }
    catch (const std::exception &error)
    {
        std::cerr << "map_size_study: " << error.what() << std::endl;
        return 2;
    }
    return 0;
}
