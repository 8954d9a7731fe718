#include "benchmarks/comparison/RunColumns.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace parking
{
    namespace
    {
        constexpr double LARGEST = 9007199254740992.0;  // beyond it a double does not hold every whole number

        /** The type of a figure, whether it may be missing or not. */
        template <class Member>
        struct Held
        {
            using Type = Member;
        };
        template <class Type_>
        struct Held<std::optional<Type_>>
        {
            using Type = Type_;
        };

        std::vector<RunColumn> makeColumns()
        {
            using R = RunRecord;
            std::vector<RunColumn> columns;
            columns.reserve(128);  // of a vector that grows inline GCC 14 believes that it overflows
            const auto add = [&columns](const char *name, RunMember member, const char *unit, const char *text,
                                        std::optional<InSummary> summary = std::nullopt,
                                        std::optional<InReport> report = std::nullopt)
            {
                columns.push_back({name, member, unit, text, summary, report});
            };

            add("run", &R::run, "", "number of the run, from 0");
            add("seed", &R::seed, "", "of the run's random numbers");

            add("outcome", &R::outcome, "",
                "0 exact, 1 approximate, 2 time is up, 3 invalid start, 4 invalid goal, 5 gave up: nothing left to "
                "try; of the planner itself: 6 exception, 7 crash, 8 hang, 9 too much memory, 10 an answer that is "
                "none; "
                "the table `enums` has the names");
            add("success", &R::success, "", "exact, valid in the second check, and in time");
            add("late", &R::late, "",
                "the first solution came more than 0.05 s after the limit (some planners of OMPL look at the clock too "
                "seldom)");

            add("first solution time", &R::firstSolutionTime, "s",
                "until the first exact solution, map loading of the planner not included",
                InSummary{"first solution", Statistic::Distribution, 0});
            add("planning time", &R::planningTime, "s", "of the planner, its map loading not included");
            add("cpu time", &R::cpuTime, "s", "processor time of all threads, map loading of the planner included");
            add("map loading time", &R::mapLoadingTime, "s",
                "building obstacles and distance field, and finding out which cells are free where that is done first",
                std::nullopt, InReport{"map loading", 1e3, "ms"});
            add("peak memory", &R::peakMemory, "MB",
                "by which the process grew at most while the planner worked; of its own only with `--isolate`",
                InSummary{"peak memory", Statistic::Median, 1, false}, InReport{"peak memory", 1.0, "MB", true});
            add("nodes expanded", &R::nodesExpanded, "", "for OMPL's planners the vertices of their graph");
            add("motions generated", &R::motionsGenerated, "", "for OMPL's planners the edges of their graph");
            add("states checked", &R::statesChecked, "", "poses, those along motions included; not counted for discs");
            add("exact checks", &R::exactChecks, "", "of these poses, those that took the exact test");
            add("open list operations", &R::openListOperations, "",
                "entries pushed to, and popped from, the open lists of the improved A*");
            add("open list comparisons", &R::openListComparisons, "", "of their entries with each other, for that");

            add("path length", &R::pathLength, "m", "of the path as it is driven",
                InSummary{"length", Statistic::MedianWithInterval, 2});
            add("cusps", &R::cusps, "", "changes of direction", InSummary{"cusps", Statistic::Median, 0});
            add("least clearance", &R::leastClearance, "m", "between the body (or disc) and obstacles along the path",
                InSummary{"clearance", Statistic::Median, 3});
            add("distance to goal", &R::distanceToGoal, "m", "from the end of the path to the nearest goal");
            add("densely valid", &R::denselyValid, "", "what the second check says");
            add("dense collisions", &R::denseCollisions, "", "poses that collide in the second check");

            add("attains goal", &R::attainsGoal, "", "ends within 1 cm (in x and in y) and 1 degree of a goal",
                InSummary{"attains goal", Statistic::Share, 3, false}, InReport{"attains goal", 100.0, "%", true});
            add("angle over length", &R::angleOverLength, "rad/m",
                "turns of the direction of travel over the length; a cusp is half a turn",
                InSummary{"angle over length", Statistic::Median, 3, false},
                InReport{"angle over length", 1.0, "rad/m", true});
            add("max curvature", &R::maxCurvature, "1/m", "largest absolute value",
                InSummary{"max curvature", Statistic::Median, 3, false}, InReport{"max curvature", 1.0, "1/m", true});
            add("normalized curvature", &R::normalizedCurvature, "rad",
                "absolute curvature, integrated over the length",
                InSummary{"normalized curvature", Statistic::Median, 3, false},
                InReport{"normalized curvature", 1.0, "rad", true});
            add("smoothness", &R::smoothness, "1/m^2", "OMPL's measure, every 0.1 m; 0 for a straight line",
                InSummary{"smoothness", Statistic::Median, 3, false}, InReport{"smoothness", 1.0, "1/m²", true});
            add("reverse share", &R::reverseShare, "", "of the length, driven in reverse",
                InSummary{"reverse share", Statistic::Median, 3, false}, InReport{"in reverse", 100.0, "%", true});
            add("mean clearance", &R::meanClearance, "m", "along the path; more than 5 m count as 5 m",
                InSummary{"mean clearance", Statistic::Median, 3, false}, InReport{"mean clearance", 1.0, "m", true});
            add("median clearance", &R::medianClearance, "m", "likewise",
                InSummary{"median clearance", Statistic::Median, 3, false},
                InReport{"median clearance", 1.0, "m", true});
            add("cusp to cusp time", &R::profileTime, "s",
                "of the fastest drive that stops at cusps only, as if the wheels turned at once",
                InSummary{"cusp to cusp time", Statistic::Median, 0, false}, InReport{"cusp to cusp", 1.0, "s", true});
            add("cusp to cusp cost", &R::profileCost, "", "TPCAP's J of that drive",
                InSummary{"cusp to cusp cost", Statistic::Median, 0, false},
                InReport{"J, cusp to cusp", 1.0, "", true});
            add("cusp to cusp jerk", &R::profileJerk, "m/s^3", "of that drive: mean of the absolute value",
                InSummary{"cusp to cusp jerk", Statistic::Median, 3, false},
                InReport{"jerk, cusp to cusp", 1.0, "m/s³", true});
            add("steering at standstill time", &R::standingSteeringTime, "s",
                "in which the wheels of that drive turn where the curvature jumps; not in the time above",
                InSummary{"steering at standstill", Statistic::Median, 0, false},
                InReport{"steering at standstill", 1.0, "s", true});
            add("steerings at standstill", &R::standingSteerings, "", "places where the curvature jumps",
                InSummary{"steerings at standstill", Statistic::Median, 0, false});

            add("simplification time", &R::simplificationTime, "s", "of OMPL, with `simplify`");
            add("simplified path length", &R::simplifiedLength, "m", "after that", std::nullopt,
                InReport{"simplified", 1.0, "m"});
            add("simplified cusps", &R::simplifiedCusps, "", "after that");
            add("simplified least clearance", &R::simplifiedClearance, "m", "after that");
            add("simplified densely valid", &R::simplifiedDenselyValid, "", "after that");
            add("simplified dense collisions", &R::simplifiedDenseCollisions, "", "after that");

            add("driven to the end", &R::drivenToTheEnd, "", "with `track`: the controller got there");
            add("travel time", &R::travelTime, "s", "of the drive",
                InSummary{"travel time", Statistic::Median, 0, false}, InReport{"travel time", 1.0, "s"});
            add("driven length", &R::drivenLength, "m", "of the drive");
            add("mean acceleration", &R::meanAcceleration, "m/s^2", "of the drive: mean of the absolute value",
                std::nullopt, InReport{"mean acceleration", 1.0, "m/s²"});
            add("mean steering angle", &R::meanSteeringAngle, "degrees", "of the drive: mean of the absolute value",
                std::nullopt, InReport{"mean steering", 1.0, "°"});
            add("greatest position error", &R::greatestPositionError, "m", "of the drive, from the path");
            add("final position error", &R::finalPositionError, "m", "between the ends of drive and path");
            add("final yaw error", &R::finalYawError, "rad", "between the ends of drive and path");
            add("collisions while driving", &R::drivingCollisions, "", "poses of the drive that collide");
            add("median MPC time", &R::medianMpcTime, "s", "of a step of the controller");

            add("drive attains goal", &R::driveAttainsGoal, "", "of the drive: as `attains_goal`",
                InSummary{"drive attains goal", Statistic::Share, 3, false},
                InReport{"drive attains goal", 100.0, "%", true});
            add("drive colliding frames", &R::driveCollidingFrames, "", "of the drive: share of its frames of 1 ms",
                InSummary{"drive colliding frames", Statistic::Median, 4, false},
                InReport{"colliding frames, driven", 100.0, "%", true});
            add("drive standing time", &R::driveStandingTime, "s", "of the drive, at less than 1 mm/s",
                InSummary{"drive standing time", Statistic::Median, 0, false}, InReport{"standing", 1.0, "s", true});
            add("drive jerk", &R::driveJerk, "m/s^3", "of the drive: mean of the absolute value",
                InSummary{"drive jerk", Statistic::Median, 3, false}, InReport{"jerk", 1.0, "m/s³", true});

            add("trajectory duration", &R::trajectoryDuration, "s",
                "with `trajectory`: of the quickest trajectory near the path",
                InSummary{"trajectory duration", Statistic::Median, 0, false}, InReport{"trajectory", 1.0, "s"});
            add("trajectory cost", &R::trajectoryCost, "",
                "its cost in the competition of TPCAP: J = 100 T + 10 (control effort + steering integral) + 5 gear "
                "changes",
                InSummary{"trajectory cost", Statistic::Median, 0, false}, InReport{"J", 1.0, ""});
            add("trajectory control effort", &R::controlEffort, "", "integral of a^2 + (v w)^2, in SI units",
                InSummary{"trajectory control effort", Statistic::Median, 3, false},
                InReport{"control effort", 1.0, "", true});
            add("trajectory steering integral", &R::steeringIntegral, "rad^2 s", "of the squared steering angle",
                InSummary{"trajectory steering integral", Statistic::Median, 3, false},
                InReport{"steering integral", 1.0, "rad² s", true});
            add("trajectory gear changes", &R::trajectoryGearChanges, "", "between forwards and reverse",
                InSummary{"trajectory gear changes", Statistic::Median, 0, false},
                InReport{"gear changes", 1.0, "", true});
            add("trajectory stops to steer", &R::trajectoryStopsToSteer, "",
                "nothing better was found than the path itself with standstills");
            add("trajectory attains goal", &R::trajectoryAttainsGoal, "", "as `attains_goal`",
                InSummary{"trajectory attains goal", Statistic::Share, 3, false},
                InReport{"trajectory attains goal", 100.0, "%", true});
            add("trajectory colliding frames", &R::trajectoryCollidingFrames, "", "share of its frames of 1 ms",
                InSummary{"trajectory colliding frames", Statistic::Median, 4, false},
                InReport{"colliding frames", 100.0, "%", true});
            add("trajectory standing time", &R::trajectoryStandingTime, "s", "at less than 1 mm/s",
                InSummary{"trajectory standing time", Statistic::Median, 0, false},
                InReport{"trajectory standing", 1.0, "s", true});
            add("trajectory jerk", &R::trajectoryJerk, "m/s^3", "mean of the absolute value",
                InSummary{"trajectory jerk", Statistic::Median, 3, false},
                InReport{"trajectory jerk", 1.0, "m/s³", true});
            add("trajectory time", &R::trajectoryTime, "s", "processor time of optimising it");

            add("time", &R::time, "s", "of `solve()`");
            add("memory", &R::memory, "MB", "OMPL: of the process");
            add("status", &R::status, "", "OMPL: what `solve()` returned; the table `enums` has the names");
            add("solved", &R::solved, "", "OMPL: the planner calls its solution exact");
            add("approximate solution", &R::approximateSolution, "",
                "OMPL: the planner calls its solution approximate");
            add("correct solution", &R::correctSolution, "", "OMPL: the path passes its check");
            add("correct solution strict", &R::correctSolutionStrict, "", "OMPL: the path passes its stricter check");
            add("solution length", &R::solutionLength, "m", "OMPL: by the space's distances");
            add("solution difference", &R::solutionDifference, "", "OMPL: what an approximate solution lacks");
            add("solution clearance", &R::solutionClearance, "m", "OMPL: mean over the path's states");
            add("solution smoothness", &R::solutionSmoothness, "", "OMPL: of the path's states");
            add("solution segments", &R::solutionSegments, "", "OMPL: motions of the path");
            add("graph states", &R::graphStates, "", "OMPL: vertices of the planner's graph");
            add("graph motions", &R::graphMotions, "", "OMPL: edges of the planner's graph");
            add("valid segment fraction", &R::validSegmentFraction, "", "OMPL: share of the motions found free");
            return columns;
        }

        constexpr const char *typeOf(const FigureValue &value)
        {
            constexpr const char *TYPES[] = {"BOOLEAN", "INTEGER", "REAL"};
            return TYPES[value.index()];
        }

        std::string textOf(const FigureValue &value)
        {
            if (const auto *real = std::get_if<double>(&value))
                return formatNumber(*real);
            if (const auto *flag = std::get_if<bool>(&value))
                return *flag ? "1" : "0";
            return std::to_string(std::get<std::int64_t>(value));
        }

        /** A figure as OMPL writes it; nothing when it cannot be read. */
        std::optional<FigureValue> figureFrom(const std::string &text, const std::string &type)
        {
            double number = 0.0;
            if (!parseNumber(text, number))
            {
                if (type == "REAL" && text == "inf")
                    return FigureValue(std::numeric_limits<double>::infinity());
                return std::nullopt;
            }
            if (type == "BOOLEAN")
                return FigureValue(number != 0.0);
            if (type == "INTEGER" || type == "ENUM")
                return std::abs(number) < LARGEST ? std::optional<FigureValue>(static_cast<std::int64_t>(number))
                                                  : std::nullopt;
            return FigureValue(number);
        }
    }  // namespace

    const char *RunColumn::type() const
    {
        return std::visit(
            [](auto pointer) -> const char *
            {
                using Type = typename Held<std::decay_t<decltype(std::declval<RunRecord>().*pointer)>>::Type;
                return std::is_same_v<Type, ompl::base::PlannerStatus::StatusType> || std::is_same_v<Type, PlanStatus>
                           ? "ENUM"
                       : std::is_same_v<Type, bool>   ? "BOOLEAN"
                       : std::is_same_v<Type, double> ? "REAL"
                                                      : "INTEGER";
            },
            member);
    }

    std::string RunColumn::typedName() const
    {
        return std::string(name) + " " + type();
    }

    std::optional<FigureValue> RunColumn::valueOf(const RunRecord &record) const
    {
        return std::visit(
            [&record](auto pointer) -> std::optional<FigureValue>
            {
                using Member = std::decay_t<decltype(record.*pointer)>;
                using Type = typename Held<Member>::Type;
                using Shown =
                    std::conditional_t<std::is_same_v<Type, bool> || std::is_same_v<Type, double>, Type, std::int64_t>;
                if constexpr (std::is_same_v<Member, Type>)
                    return FigureValue(static_cast<Shown>(record.*pointer));
                else if ((record.*pointer).has_value())
                    return FigureValue(static_cast<Shown>(*(record.*pointer)));
                return std::nullopt;
            },
            member);
    }

    double RunColumn::numberOf(const RunRecord &record) const
    {
        const std::optional<FigureValue> value = valueOf(record);
        if (!value)
            return std::numeric_limits<double>::quiet_NaN();
        return std::visit([](auto each) { return static_cast<double>(each); }, *value);
    }

    void RunColumn::set(RunRecord &record, const FigureValue &value) const
    {
        const auto refuse = [&]
        {
            throw Error("the column " + inQuotes(name) + " of type " + type() + " cannot hold " + textOf(value));
        };
        std::visit(
            [&](auto pointer)
            {
                using Type = typename Held<std::decay_t<decltype(record.*pointer)>>::Type;
                const auto *whole = std::get_if<std::int64_t>(&value);
                if constexpr (std::is_same_v<Type, bool> || std::is_same_v<Type, double>)
                {
                    if (std::is_same_v<Type, double> && whole != nullptr)
                        record.*pointer = static_cast<Type>(*whole);
                    else if (std::holds_alternative<Type>(value))
                        record.*pointer = std::get<Type>(value);
                    else
                        refuse();
                }
                else
                {
                    if (whole == nullptr || *whole < 0)
                        refuse();
                    const auto converted = static_cast<Type>(*whole);
                    if (static_cast<std::int64_t>(converted) != *whole)
                        refuse();
                    if constexpr (std::is_same_v<Type, PlanStatus>)
                        if (converted > PlanStatus::Nonsense)
                            refuse();
                    record.*pointer = converted;
                }
            },
            member);
    }

    const std::vector<RunColumn> &runColumns()
    {
        static const std::vector<RunColumn> COLUMNS = makeColumns();
        return COLUMNS;
    }

    const RunColumn &runColumn(std::string_view name)
    {
        for (const RunColumn &column : runColumns())
            if (name == column.name)
                return column;
        throw Error("there is no column " + inQuotes(name));
    }

    std::map<std::string, std::string> omplProperties(const RunRecord &record)
    {
        std::map<std::string, std::string> properties;
        for (const auto &[name, value] : record.reported)
            properties[name + " " + typeOf(value)] = textOf(value);
        for (const RunColumn &column : runColumns())
            if (const std::optional<FigureValue> value = column.valueOf(record))
                properties[column.typedName()] = textOf(*value);
        return properties;
    }

    void takeOmplProperties(RunRecord &record, const std::map<std::string, std::string> &properties)
    {
        const std::vector<RunColumn> &columns = runColumns();
        for (const auto &[typedName, text] : properties)
        {
            const std::size_t blank = typedName.rfind(' ');
            if (blank == std::string::npos)
                continue;
            const std::string name = typedName.substr(0, blank), type = typedName.substr(blank + 1);
            const std::optional<FigureValue> value = figureFrom(text, type);
            if (!value)
                continue;
            const auto column =
                std::find_if(columns.begin(), columns.end(), [&](const RunColumn &each) { return name == each.name; });
            if (column == columns.end())
                record.reported[name] = *value;
            else if (type == column->type() && !column->valueOf(record))
                column->set(record, *value);
        }
    }
}  // namespace parking
