#include "ompl_improved_astar/search/planning/Parameters.h"

#include "ompl_improved_astar/search/Heuristic.h"
#include "ompl_improved_astar/search/MotionModel.h"
#include "ompl_improved_astar/search/OpenList.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <type_traits>
#include <utility>

namespace parking
{
    namespace
    {
        using P = PlannerParameters;
        using Names = std::vector<std::string>;

        constexpr ParameterValues YES_OR_NO{};

        ParameterValues between(double min, double max, double step)
        {
            return {min, max, step, false, nullptr};
        }

        ParameterValues zeroOrBetween(double min, double max, double step)
        {
            return {min, max, step, true, nullptr};
        }

        ParameterValues oneOf(Names (*names)())
        {
            return {0.0, 0.0, 0.0, false, names};
        }

        Names heuristicNames()
        {
            Names names = search::heuristics().names();
            names.insert(names.begin(), "default");
            return names;
        }

        Names sides()
        {
            return {"goal", "start"};
        }

        Names obstacleLoadings()
        {
            return {"lazy", "eager"};
        }

        Names smoothings()
        {
            return {"bspline", "none"};
        }

        std::string listed(const Names &names)
        {
            std::string text;
            for (const std::string &name : names)
                text += (text.empty() ? "" : ", ") + name;
            return text;
        }

        Error refused(const Parameter &row, const std::string &value)
        {
            return Error(row.name + " must be " + row.allowed() + ", not " + value);
        }

        /** Names of removed parameters, and what to use instead. */
        constexpr std::pair<std::string_view, std::string_view> REMOVED[]{
            {"look_ahead", "it is always on with detours"},
            {"spread_out", "it is always on with detours"},
            {"clearance_weight", "use preferred_clearance and clearance_cost"}};

        /** The set of this name, which is one of parameterSetNames(). */
        P namedSet(const std::string &name)
        {
            P set;
            set.parameterSet = name;
            if (name == "default")
                return set;
            if (name == "hybrid_astar")
            {
                set.bidirectional = set.adaptiveResolution = set.detours = set.shortening = false;
                set.searchFrom = "start";
                return set;
            }
            const auto isOneOf = [&name](std::initializer_list<const char *> names)
            {
                return std::find(names.begin(), names.end(), name) != names.end();
            };
            // The paper's best set has every improvement but the neighbourhood expansion (section "Discussion").
            set.motionModel = isOneOf({"experiment_4"}) ? "grid16" : "grid8";
            set.heuristicWeightFar = 1.5;
            set.heuristicWeightNear = 0.9;
            if (isOneOf({"basic_astar", "experiment_1"}))
            {
                set.heuristicWeightFar = set.heuristicWeightNear = 1.0;
                set.nearGoalDistance = set.tieBreak = 0.0;
            }
            if (isOneOf({"basic_astar", "experiment_2"}))
                set.obstacleLoading = "eager";
            if (isOneOf({"basic_astar", "experiment_3", "experiment_6"}))
            {
                set.bidirectional = false;
                set.searchFrom = "start";
                set.openList = "linear";
            }
            if (isOneOf({"basic_astar", "experiment_5", "experiment_6"}))
                set.smoothing = "none";
            set.approximate = name != "basic_astar";
            return set;
        }
    }  // namespace

    const std::vector<Parameter> &parameterTable()
    {
        static const std::vector<Parameter> table{
            {"parameter_set", &P::parameterSet, oneOf(parameterSetNames), "",
             "sets all others except `turning_radius`, `xy_resolution` and `heading_bins`; the `experiment_` sets are "
             "the paper's ablation, `hybrid_astar` is the car model without this project's additions"},
            {"motion_model", &P::motionModel, oneOf([] { return search::motionModels().names(); }), "",
             "`car`: drivable motions; the `grid` models: the paper's moves between grid cells, for a plain SE2 space"},
            {"turning_radius", &P::turningRadius, between(0.01, 1000.0, 0.1), "m",
             "on a plain SE2 space only; curve spaces define their own"},
            {"xy_resolution", &P::xyResolution, zeroOrBetween(0.001, 100.0, 0.05), "m",
             "side of a cell: of the grid, or (car model) of the cells at steps of a metre; 0 chooses 0.5 m on grids "
             "and a tenth of the turning radius for the car"},
            {"heading_bins", &P::headingBins, between(8.0, 1440.0, 1.0), "",
             "cells of heading round the circle, at steps of a metre (car model)"},
            {"steering_angles", &P::steeringAngles, between(3.0, 21.0, 2.0), "", "of the car model, straight included"},
            {"bidirectional", &P::bidirectional, YES_OR_NO, "", "search from the start and from the goal"},
            {"search_from", &P::searchFrom, oneOf(sides), "", "side of a search that is not bidirectional"},
            {"open_list", &P::openList, oneOf([] { return search::openLists().names(); }), "",
             "data structure of the open nodes; `linear` is that of the paper's basic A*"},
            {"heuristic_weight_far", &P::heuristicWeightFar, between(0.0, 10.0, 0.1), "",
             "w of f = g + (w + p) h, farther from the target than `near_goal_distance`"},
            {"heuristic_weight_near", &P::heuristicWeightNear, between(0.0, 10.0, 0.1), "", "w nearer to the target"},
            {"near_goal_distance", &P::nearGoalDistance, between(0.0, 1000.0, 1.0), "m", "where w changes"},
            {"tie_break", &P::tieBreak, between(0.0, 1.0, 0.001), "", "p of f = g + (w + p) h"},
            {"heuristic", &P::heuristic, oneOf(heuristicNames), "",
             "estimate of the remaining cost: `curves` (Reeds-Shepp or Dubins), `straight` distance, `octile` (steps "
             "to eight neighbours), `manhattan` (to four); `default` chooses what suits the motion model"},
            {"obstacle_heuristic", &P::obstacleHeuristic, YES_OR_NO, "",
             "guide the search around obstacles (car model)"},
            {"detours", &P::detours, YES_OR_NO, "",
             "until the first solution, look ahead along the route and spread out the search; when stuck, try routes "
             "through wider gaps and seek a proof that no path exists (car model)"},
            {"obstacle_loading", &P::obstacleLoading, oneOf(obstacleLoadings), "",
             "when cells are classified: `lazy` on demand, or `eager` before the search"},
            {"adaptive_resolution", &P::adaptiveResolution, YES_OR_NO, "",
             "search finely where coarse steps fail (car model)"},
            {"analytic_expansion", &P::analyticExpansion, YES_OR_NO, "",
             "join the frontiers by Reeds-Shepp or Dubins curves (car model); required to end exactly at the goal"},
            {"reverse_penalty", &P::reversePenalty, between(0.0, 100.0, 0.1), "", "extra cost per metre in reverse"},
            {"gear_change_penalty", &P::gearChangePenalty, between(0.0, 100.0, 0.1), "m",
             "cost of a change of direction"},
            {"steering_change_penalty", &P::steeringChangePenalty, between(0.0, 100.0, 0.1), "m",
             "cost of turning the wheels from straight to full lock"},
            {"preferred_clearance", &P::preferredClearance, between(0.0, 10.0, 0.01), "m",
             "clearance kept where that is cheap; 0: the path may graze obstacles (car model, with a checker that "
             "provides clearances)"},
            {"clearance_cost", &P::clearanceCost, between(0.0, 100.0, 0.5), "m",
             "extra cost per metre driven closer than `preferred_clearance`"},
            {"smoothing", &P::smoothing, oneOf(smoothings), "", "B-spline through the path (grid models)"},
            {"shortening", &P::shortening, YES_OR_NO, "",
             "replace parts of the solution by cheaper curves, move its cusps, and drive parts of it in the other "
             "direction (car model)"},
            {"approximate", &P::approximate, YES_OR_NO, "",
             "if the goal cannot be reached, return a path that ends as near to it as possible"},
            {"anytime", &P::anytime, YES_OR_NO, "", "improve the solution until terminated"},
            {"max_memory_mb", &P::maxMemoryMb, between(16.0, 1048576.0, 1.0), "MB",
             "memory limit of the search; above it planning ends as at a time limit, with this reason"},
            {"goal_tolerance", &P::goalTolerance, between(0.0, 0.01, 1e-5), "m and rad",
             "a start that deviates from a goal by at most this counts as at the goal: the path has no motion"},
            {"initial_straight", &P::initialStraight, zeroOrBetween(0.01, 100.0, 0.1), "m",
             "length of a straight at the beginning of the path, in either direction, as far as it is free (car "
             "model)"},
            {"final_straight", &P::finalStraight, zeroOrBetween(0.01, 100.0, 0.1), "m",
             "length of a straight at the end of the path, in either direction, as far as it is free (car model)"},
            {"escape", &P::escape, YES_OR_NO, "",
             "if no start is free, leave a shallow contact by a motion that does not deepen it (car model, with "
             "`FclFootprintChecker`)"},
            {"max_escape_depth", &P::maxEscapeDepth, between(0.0, 0.5, 0.01), "m",
             "largest depth of a contact that `escape` leaves"}};
        return table;
    }

    bool operator==(const PlannerParameters &a, const PlannerParameters &b)
    {
        const auto isSame = [&](const Parameter &row)
        {
            return std::visit([&](const auto member) { return a.*member == b.*member; }, row.member);
        };
        return std::all_of(parameterTable().begin(), parameterTable().end(), isSame);
    }

    std::string Parameter::allowed() const
    {
        if (std::holds_alternative<bool P::*>(member))
            return "true, false";
        if (values.names != nullptr)
            return listed(values.names());
        const bool inSteps = std::holds_alternative<unsigned int P::*>(member) && values.step != 1.0;
        return (values.allowsZero ? "0 or " : "") + ("between " + formatNumber(values.min)) + " and " +
               formatNumber(values.max) + (inSteps ? " in steps of " + formatNumber(values.step) : "") +
               (unit.empty() ? "" : " " + unit);
    }

    void Parameter::check(const PlannerParameters &parameters) const
    {
        const auto checkValue = [&](const auto at)
        {
            const auto &value = parameters.*at;
            using Value = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, std::string>)
            {
                const Names known = values.names();
                const bool isSet = values.names == parameterSetNames;
                if (std::find(known.begin(), known.end(), isSet ? parameterSetName(value) : value) == known.end())
                    throw Error(unknownName("value for " + name, value, known));
            }
            else if constexpr (!std::is_same_v<Value, bool>)
            {
                const double number = value;
                const bool isWithin =
                    (number >= values.min && number <= values.max) || (values.allowsZero && number == 0.0);
                const bool isStep = std::is_same_v<Value, double> || std::fmod(number - values.min, values.step) == 0.0;
                if (!isWithin || !isStep)
                    throw refused(*this, formatNumber(number));
            }
        };
        std::visit(checkValue, member);
    }

    void Parameter::setNumber(PlannerParameters &parameters, double value) const
    {
        if (const auto *number = std::get_if<double P::*>(&member))
        {
            parameters.*(*number) = value;
            return;
        }
        constexpr double MAX = std::numeric_limits<unsigned int>::max();
        if (!(value >= 0.0 && value <= MAX) || value != std::floor(value))
            throw refused(*this, formatNumber(value));
        parameters.*std::get<unsigned int P::*>(member) = static_cast<unsigned int>(value);
    }

    void Parameter::setText(PlannerParameters &parameters, const std::string &text) const
    {
        PlannerParameters changed = parameters;
        double number = 0.0;
        const bool isSwitch = std::holds_alternative<bool P::*>(member);
        if (const auto *at = std::get_if<std::string P::*>(&member))
            changed.*(*at) = values.names == parameterSetNames ? parameterSetName(text) : text;
        else if (isSwitch && (text == "true" || text == "false"))
            changed.*std::get<bool P::*>(member) = text == "true";
        else if (!isSwitch && parseNumber(text, number))
            setNumber(changed, number);
        else
            throw refused(*this, inQuotes(text));
        check(changed);
        parameters = std::move(changed);
    }

    const Parameter &parameterNamed(std::string_view name)
    {
        Names names;
        for (const Parameter &row : parameterTable())
        {
            if (row.name == name)
                return row;
            names.push_back(row.name);
        }
        checkNotRemoved(name);
        throw Error(unknownName("parameter", std::string(name), names));
    }

    void checkNotRemoved(std::string_view name)
    {
        for (const auto &[removed, instead] : REMOVED)
            if (removed == name)
                throw Error(std::string(name) + " was removed: " + std::string(instead));
    }

    void checkParameters(const PlannerParameters &parameters)
    {
        for (const Parameter &row : parameterTable())
            row.check(parameters);
    }

    std::vector<std::string> parameterSetNames()
    {
        return {"default",      "basic_astar",  "experiment_1", "experiment_2",         "experiment_3",
                "experiment_4", "experiment_5", "experiment_6", "paper_improved_astar", "hybrid_astar"};
    }

    std::string parameterSetName(const std::string &name)
    {
        return name == "improved_astar" ? "paper_improved_astar" : name;
    }

    PlannerParameters parameterSet(const std::string &name, const PlannerParameters &current)
    {
        const Names names = parameterSetNames();
        const std::string known = parameterSetName(name);
        if (std::find(names.begin(), names.end(), known) == names.end())
            throw Error(unknownName("parameter set", name, names));
        PlannerParameters set = namedSet(known);
        set.turningRadius = current.turningRadius;
        set.xyResolution = current.xyResolution;
        set.headingBins = current.headingBins;
        return set;
    }
}  // namespace parking
