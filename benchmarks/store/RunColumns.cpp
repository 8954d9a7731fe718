#include "benchmarks/store/RunColumns.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <map>

namespace parking
{
    namespace
    {
        constexpr ColumnType Boolean = ColumnType::Boolean, Integer = ColumnType::Integer, Real = ColumnType::Real,
                             Enum = ColumnType::Enum;
        constexpr Statistic Median = Statistic::Median, Share = Statistic::Share;
        constexpr std::nullopt_t None = std::nullopt;

        const std::vector<RunColumn> COLUMNS{
            {"run", Integer, "", "number of the run, from 0"},
            {"seed", Integer, "", "seed of the run's random numbers"},

            {"outcome", Integer, "",
             "0 exact, 1 approximate, 2 time limit, 3 invalid start, 4 invalid goal, 5 infeasible: search "
             "exhausted; failures of the planner: 6 exception, 7 crash, 8 hang, 9 memory limit, 10 invalid "
             "answer; the table `outcomes` has the names"},
            {"success", Boolean, "", "exact, valid in the second check, and in time"},
            {"late", Boolean, "",
             "the first solution came more than 0.05 s after the limit (some planners of OMPL check the clock "
             "too seldom)"},
            {"solvable", Boolean, "",
             "false: the start or every goal is in collision or outside, so that no path exists; a planner must not "
             "claim one"},

            {"first solution time", Real, "s", "until the first exact solution, without the planner's map loading",
             InSummary{"first solution", Statistic::Distribution, 0}},
            {"planning time", Real, "s", "of the planner, without its map loading"},
            {"cpu time", Real, "s", "processor time of all threads, with the planner's map loading"},
            {"map loading time", Real, "s",
             "building obstacles and distance field, and computing the free cells if that is done first", None,
             InReport{"map loading", 1e3, "ms"}},
            {"peak memory", Real, "MB", "with `--isolate`: maximum growth of the process while the planner worked",
             InSummary{"peak memory", Median, 1, false}, InReport{"peak memory", 1.0, "MB", true}},
            {"nodes expanded", Integer, "", "for OMPL's planners the vertices of their graph"},
            {"motions generated", Integer, "", "for OMPL's planners the edges of their graph"},
            {"states checked", Integer, "", "poses, those along motions included; not counted for discs"},
            {"exact checks", Integer, "", "poses of `states_checked` that required the exact check"},
            {"open list operations", Integer, "", "entries pushed to and popped from the open lists of improved A*"},
            {"open list comparisons", Integer, "", "comparisons of entries in these open lists"},

            {"path length", Real, "m", "of the path as it is driven",
             InSummary{"length", Statistic::MedianWithInterval, 2}},
            {"path cost", Real, "m", "of the path by the `objective`, if one is set",
             InSummary{"cost", Median, 3, false}, InReport{"cost", 1.0, "m"}},
            {"cusps", Integer, "", "changes of direction", InSummary{"changes of direction", Median, 0}},
            {"least clearance", Real, "m", "minimum distance between the body (or disc) and obstacles along the path",
             InSummary{"clearance", Median, 3}},
            {"distance to goal", Real, "m", "from the end of the path to the nearest goal"},
            {"densely valid", Boolean, "", "result of the second check"},
            {"dense collisions", Integer, "", "poses in collision in the second check"},

            {"attains goal", Boolean, "", "ends within 1 cm (in x and in y) and 1 degree of a goal",
             InSummary{"attains goal", Share, 3, false}, InReport{"attains goal", 100.0, "%", true}},
            {"angle over length", Real, "rad/m",
             "sum of turns of the direction of travel over the length; a cusp is half a turn",
             InSummary{"angle over length", Median, 3, false}, InReport{"angle over length", 1.0, "rad/m", true}},
            {"max curvature", Real, "1/m", "maximum absolute value", InSummary{"max curvature", Median, 3, false},
             InReport{"max curvature", 1.0, "1/m", true}},
            {"normalized curvature", Real, "rad", "absolute curvature, integrated over the length",
             InSummary{"normalized curvature", Median, 3, false}, InReport{"normalized curvature", 1.0, "rad", true}},
            {"smoothness", Real, "1/m^2", "OMPL's measure, every 0.1 m; 0 for a straight line",
             InSummary{"smoothness", Median, 3, false}, InReport{"smoothness", 1.0, "1/m²", true}},
            {"reverse share", Real, "", "share of the length driven in reverse",
             InSummary{"reverse share", Median, 3, false}, InReport{"in reverse", 100.0, "%", true}},
            {"mean clearance", Real, "m", "along the path; more than 5 m count as 5 m",
             InSummary{"mean clearance", Median, 3, false}, InReport{"mean clearance", 1.0, "m", true}},
            {"median clearance", Real, "m", "along the path; more than 5 m count as 5 m",
             InSummary{"median clearance", Median, 3, false}, InReport{"median clearance", 1.0, "m", true}},
            {"cusp to cusp time", Real, "s",
             "fastest drive that stops only where the direction changes, with immediate steering",
             InSummary{"cusp to cusp time", Median, 0, false},
             InReport{"between changes of direction", 1.0, "s", true}},
            {"cusp to cusp cost", Real, "", "TPCAP's J of that drive", InSummary{"cusp to cusp cost", Median, 0, false},
             InReport{"J, between changes", 1.0, "", true}},
            {"cusp to cusp jerk", Real, "m/s^3", "of that drive: mean of the absolute value",
             InSummary{"cusp to cusp jerk", Median, 3, false}, InReport{"jerk, between changes", 1.0, "m/s³", true}},
            {"steering at standstill time", Real, "s",
             "steering of that drive where the curvature jumps; not included in the time above",
             InSummary{"steering at standstill", Median, 0, false}, InReport{"steering at standstill", 1.0, "s", true}},
            {"steerings at standstill", Integer, "", "number of places where the curvature jumps",
             InSummary{"steerings at standstill", Median, 0, false}},

            {"simplification time", Real, "s", "OMPL's simplification, with `simplify`"},
            {"simplified path length", Real, "m", "after simplification", None, InReport{"simplified", 1.0, "m"}},
            {"simplified cusps", Integer, "", "after simplification"},
            {"simplified least clearance", Real, "m", "after simplification"},
            {"simplified densely valid", Boolean, "", "after simplification"},
            {"simplified dense collisions", Integer, "", "after simplification"},

            {"driven to the end", Boolean, "", "with `track`: the controller reached the end"},
            {"travel time", Real, "s", "of the drive", InSummary{"travel time", Median, 0, false},
             InReport{"travel time", 1.0, "s"}},
            {"driven length", Real, "m", "of the drive"},
            {"mean acceleration", Real, "m/s^2", "of the drive: mean of the absolute value", None,
             InReport{"mean acceleration", 1.0, "m/s²"}},
            {"mean steering angle", Real, "degrees", "of the drive: mean of the absolute value", None,
             InReport{"mean steering", 1.0, "°"}},
            {"greatest position error", Real, "m", "of the drive, from the path"},
            {"final position error", Real, "m", "between the ends of drive and path"},
            {"final yaw error", Real, "rad", "between the ends of drive and path"},
            {"collisions while driving", Integer, "", "poses of the drive that collide"},
            {"median MPC time", Real, "s", "of a step of the controller"},

            {"drive attains goal", Boolean, "", "of the drive: as `attains_goal`",
             InSummary{"drive attains goal", Share, 3, false}, InReport{"drive attains goal", 100.0, "%", true}},
            {"drive colliding frames", Real, "", "of the drive: share of its frames of 1 ms",
             InSummary{"drive colliding frames", Median, 4, false},
             InReport{"colliding frames, driven", 100.0, "%", true}},
            {"drive standing time", Real, "s", "of the drive, at less than 1 mm/s",
             InSummary{"drive standing time", Median, 0, false}, InReport{"standing", 1.0, "s", true}},
            {"drive jerk", Real, "m/s^3", "of the drive: mean of the absolute value",
             InSummary{"drive jerk", Median, 3, false}, InReport{"jerk", 1.0, "m/s³", true}},

            {"known drive time", Real, "s", "with `perceive`: of a drive by improved A* that knows the map",
             InSummary{"known drive time", Median, 0, false}, InReport{"drive, known map", 1.0, "s"}},
            {"perceived drive time", Real, "s", "by what a sensor sees, with new motions while the car drives",
             InSummary{"perceived drive time", Median, 0, false}, InReport{"drive, perceived map", 1.0, "s"}},
            {"stopping drive time", Real, "s", "by what a sensor sees, with a stop for each new plan",
             InSummary{"stopping drive time", Median, 0, false}, InReport{"drive that stops to plan", 1.0, "s", true}},
            {"perceived parked", Boolean, "", "of the perceived drive: the car stands at the goal",
             InSummary{"perceived parked", Share, 3, false}, InReport{"parked, perceived map", 100.0, "%", true}},
            {"perceived stops", Integer, "", "of the perceived drive: stops to plan",
             InSummary{"perceived stops", Median, 0, false}, InReport{"stops to plan", 1.0, ""}},
            {"stopping stops", Integer, "", "of the drive that stops to plan",
             InSummary{"stopping stops", Median, 0, false}, InReport{"its stops to plan", 1.0, "", true}},
            {"perceived new motions", Integer, "", "of the perceived drive: motions that have replaced the driven one",
             InSummary{"perceived new motions", Median, 0, false}, InReport{"new motions", 1.0, "", true}},
            {"perceived least clearance", Real, "m", "of the perceived drive, from the true obstacles",
             InSummary{"perceived clearance", Median, 3, false}, InReport{"clearance, perceived map", 1.0, "m", true}},
            {"median reaction time", Real, "s",
             "of the perceived drive: to take over a frame and to check the driven motion",
             InSummary{"reaction", Median, 0, false}, InReport{"reaction", 1e3, "ms", true}},
            {"p99 reaction time", Real, "s", "the same, 99th percentile of the drive", None,
             InReport{"reaction, 99 %", 1e3, "ms", true}},
            {"median new motion time", Real, "s", "of the perceived drive: the same with a new motion",
             InSummary{"new motion", Median, 0, false}, InReport{"new motion found in", 1e3, "ms", true}},
            {"max new motion time", Real, "s", "the same, slowest of the drive", None,
             InReport{"slowest new motion", 1e3, "ms", true}},

            {"trajectory duration", Real, "s", "with `trajectory`: of the fastest trajectory near the path",
             InSummary{"trajectory duration", Median, 0, false}, InReport{"trajectory", 1.0, "s"}},
            {"trajectory cost", Real, "",
             "its cost in the competition of TPCAP: J = 100 T + 10 (control effort + steering integral) + 5 gear "
             "changes",
             InSummary{"trajectory cost", Median, 0, false}, InReport{"J", 1.0, ""}},
            {"trajectory control effort", Real, "", "integral of a^2 + (v w)^2, in SI units",
             InSummary{"trajectory control effort", Median, 3, false}, InReport{"control effort", 1.0, "", true}},
            {"trajectory steering integral", Real, "rad^2 s", "of the squared steering angle",
             InSummary{"trajectory steering integral", Median, 3, false},
             InReport{"steering integral", 1.0, "rad² s", true}},
            {"trajectory gear changes", Integer, "", "between forwards and reverse",
             InSummary{"trajectory gear changes", Median, 0, false},
             InReport{"its changes of direction", 1.0, "", true}},
            {"trajectory stops to steer", Boolean, "", "the result is the path itself with stops to steer"},
            {"trajectory attains goal", Boolean, "", "as `attains_goal`",
             InSummary{"trajectory attains goal", Share, 3, false},
             InReport{"trajectory attains goal", 100.0, "%", true}},
            {"trajectory colliding frames", Real, "", "share of its frames of 1 ms",
             InSummary{"trajectory colliding frames", Median, 4, false},
             InReport{"colliding frames", 100.0, "%", true}},
            {"trajectory standing time", Real, "s", "at less than 1 mm/s",
             InSummary{"trajectory standing time", Median, 0, false}, InReport{"trajectory standing", 1.0, "s", true}},
            {"trajectory jerk", Real, "m/s^3", "mean of the absolute value",
             InSummary{"trajectory jerk", Median, 3, false}, InReport{"trajectory jerk", 1.0, "m/s³", true}},
            {"trajectory time", Real, "s", "processor time of the optimisation"},

            {"time", Real, "s", "of `solve()`"},
            {"memory", Real, "MB", "OMPL: of the process"},
            {"status", Enum, "", "OMPL: what `solve()` returned; the table `enums` has the names"},
            {"solved", Boolean, "", "OMPL: the planner reports an exact solution"},
            {"approximate solution", Boolean, "", "OMPL: the planner reports an approximate solution"},
            {"correct solution", Boolean, "", "OMPL: the path passes its check"},
            {"correct solution strict", Boolean, "", "OMPL: the path passes its stricter check"},
            {"solution length", Real, "m", "OMPL: by the space's distances"},
            {"solution difference", Real, "", "OMPL: distance of an approximate solution to the goal"},
            {"solution clearance", Real, "m", "OMPL: mean over the path's states"},
            {"solution smoothness", Real, "", "OMPL: of the path's states"},
            {"solution segments", Integer, "", "OMPL: motions of the path"},
            {"graph states", Integer, "", "OMPL: vertices of the planner's graph"},
            {"graph motions", Integer, "", "OMPL: edges of the planner's graph"},
            {"valid segment fraction", Real, "", "OMPL: share of the motions found free"},
        };

        std::string textOf(const FigureValue &value)
        {
            return std::visit([](auto each) { return formatNumber(static_cast<double>(each)); }, value);
        }
    }  // namespace

    std::string toString(ColumnType type)
    {
        switch (type)
        {
            case ColumnType::Boolean:
                return "BOOLEAN";
            case ColumnType::Integer:
                return "INTEGER";
            case ColumnType::Real:
                return "REAL";
            case ColumnType::Enum:
                break;
        }
        return "ENUM";
    }

    FigureValue RunColumn::checked(const FigureValue &value) const
    {
        const auto *whole = std::get_if<std::int64_t>(&value);
        if (type == ColumnType::Real && whole != nullptr)
            return static_cast<double>(*whole);
        const bool fits = type == ColumnType::Boolean ? std::holds_alternative<bool>(value)
                          : type == ColumnType::Real  ? std::holds_alternative<double>(value)
                                                      : whole != nullptr && *whole >= 0;
        const bool isNamed = name != std::string("outcome") || (fits && *whole < static_cast<int>(PLAN_STATUSES));
        if (!fits || !isNamed)
            throw Error("the column " + inQuotes(name) + " of type " + toString(type) + " cannot hold " +
                        textOf(value));
        return value;
    }

    const std::vector<RunColumn> &runColumns()
    {
        return COLUMNS;
    }

    const RunColumn *findRunColumn(const std::string &name)
    {
        static const std::map<std::string, const RunColumn *> BY_NAME = []
        {
            std::map<std::string, const RunColumn *> columns;
            for (const RunColumn &column : COLUMNS)
                columns.emplace(column.name, &column);
            return columns;
        }();
        const auto found = BY_NAME.find(name);
        return found == BY_NAME.end() ? nullptr : found->second;
    }

    const RunColumn &runColumn(const std::string &name)
    {
        const RunColumn *column = findRunColumn(name);
        if (column == nullptr)
            throw Error("there is no column " + inQuotes(name));
        return *column;
    }
}  // namespace parking
