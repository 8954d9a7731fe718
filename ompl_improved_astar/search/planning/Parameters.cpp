#include "ompl_improved_astar/search/planning/Parameters.h"

#include "ompl_improved_astar/search/Heuristic.h"
#include "ompl_improved_astar/search/MotionModel.h"
#include "ompl_improved_astar/search/openlists/OpenList.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace parking
{
    namespace
    {
        using P = PlannerParameters;
        using Names = std::vector<std::string>;

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

        ParameterValues yesOrNo()
        {
            return {};
        }

        Names motionModelNames()
        {
            return search::motionModels().names();
        }

        Names heuristicNames()
        {
            Names names = search::heuristics().names();
            names.insert(names.begin(), "default");
            return names;
        }

        Names openListNames()
        {
            return search::openLists().names();
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

        bool isWithin(const ParameterValues &values, double value)
        {
            return (value >= values.min && value <= values.max) || (values.allowsZero && value == 0.0);
        }

        std::string listed(const Names &names)
        {
            std::string text;
            for (const std::string &name : names)
                text += (text.empty() ? "" : ", ") + name;
            return text;
        }

        // The sets differ from the defaults in this and that.

        void onGrid(P &set)
        {
            set.motionModel = "grid8";
        }

        void weighted(P &set, double far, double near, double nearDistance, double tieBreak)
        {
            set.heuristicWeightFar = far;
            set.heuristicWeightNear = near;
            set.nearGoalDistance = nearDistance;
            set.tieBreak = tieBreak;
        }

        void unweighted(P &set)
        {
            weighted(set, 1.0, 1.0, 0.0, 0.0);
        }

        void fromStartOnly(P &set)
        {
            set.bidirectional = false;
            set.searchFrom = "start";
        }

        /** The paper's best set: every improvement but the neighbourhood expansion (section "Discussion"). */
        void improvedGrid(P &set)
        {
            onGrid(set);
            weighted(set, 1.5, 0.9, 5.0, 1e-3);
        }

        void withoutBidirectionalSearchAndHeap(P &set)
        {
            improvedGrid(set);
            fromStartOnly(set);
            set.openList = "linear";
        }

        struct NamedSet
        {
            const char *name;
            void (*change)(P &);  ///< of the defaults
        };

        const std::vector<NamedSet> SETS{{"default",
                                          [](P &) {
                                          }},
                                         {"basic_astar",
                                          [](P &set)
                                          {
                                              onGrid(set);
                                              unweighted(set);
                                              fromStartOnly(set);
                                              set.openList = "linear";
                                              set.obstacleLoading = "eager";
                                              set.smoothing = "none";
                                              set.approximate = false;
                                          }},
                                         {"experiment_1",  // without the weighted heuristic
                                          [](P &set)
                                          {
                                              onGrid(set);
                                              unweighted(set);
                                          }},
                                         {"experiment_2",  // without dynamic obstacle loading
                                          [](P &set)
                                          {
                                              improvedGrid(set);
                                              set.obstacleLoading = "eager";
                                          }},
                                         {"experiment_3", withoutBidirectionalSearchAndHeap},
                                         {"experiment_4",  // with neighbourhood expansion
                                          [](P &set)
                                          {
                                              improvedGrid(set);
                                              set.motionModel = "grid16";
                                          }},
                                         {"experiment_5",  // without smoothing
                                          [](P &set)
                                          {
                                              improvedGrid(set);
                                              set.smoothing = "none";
                                          }},
                                         {"experiment_6",  // and without bidirectional search and binary heap
                                          [](P &set)
                                          {
                                              withoutBidirectionalSearchAndHeap(set);
                                              set.smoothing = "none";
                                          }},
                                         {"improved_astar", improvedGrid},
                                         {"hybrid_astar",  // the car model without what this project adds to it
                                          [](P &set)
                                          {
                                              fromStartOnly(set);
                                              set.adaptiveResolution = false;
                                              set.lookAhead = set.spreadOut = set.detours = false;
                                              set.shortening = false;
                                          }}};
    }  // namespace

    const std::vector<Parameter> &parameterTable()
    {
        static const std::vector<Parameter> table{
            {"parameter_set", &P::parameterSet, oneOf(parameterSetNames), "",
             "sets the others but for `turning_radius`, `xy_resolution` and `heading_bins`; the `experiment_` sets are "
             "the paper's ablation, `hybrid_astar` is the car model without this project's additions"},
            {"motion_model", &P::motionModel, oneOf(motionModelNames), "",
             "`car`: drivable motions; the `grid` models: the paper's moves between grid cells, for a plain SE2 space"},
            {"turning_radius", &P::turningRadius, between(0.01, 1000.0, 0.1), "m",
             "on a plain SE2 space only, others bring their own"},
            {"xy_resolution", &P::xyResolution, zeroOrBetween(0.001, 100.0, 0.05), "m",
             "side of a cell: of the grid, or (car model) of the cells at steps of a metre; 0 chooses 0.5 m on grids "
             "and a tenth of the turning radius for the car"},
            {"heading_bins", &P::headingBins, between(8.0, 1440.0, 1.0), "",
             "cells of heading round the circle, at steps of a metre (car model)"},
            {"steering_angles", &P::steeringAngles, between(3.0, 21.0, 2.0), "", "of the car model, straight included"},
            {"bidirectional", &P::bidirectional, yesOrNo(), "", "search from the start and from the goal"},
            {"search_from", &P::searchFrom, oneOf(sides), "", "the side of a search that is not bidirectional"},
            {"open_list", &P::openList, oneOf(openListNames), "",
             "how the best node is found; `linear` is that of the plain A* of the paper's comparison"},
            {"heuristic_weight_far", &P::heuristicWeightFar, between(0.0, 10.0, 0.1), "",
             "w of f = g + (w + p) h, farther from the target than `near_goal_distance`"},
            {"heuristic_weight_near", &P::heuristicWeightNear, between(0.0, 10.0, 0.1), "", "w nearer to the target"},
            {"near_goal_distance", &P::nearGoalDistance, between(0.0, 1000.0, 1.0), "m", "where w changes"},
            {"tie_break", &P::tieBreak, between(0.0, 1.0, 0.001), "", "p of f = g + (w + p) h"},
            {"heuristic", &P::heuristic, oneOf(heuristicNames), "",
             "what is thought to lie ahead: `curves` (Reeds-Shepp or Dubins), `straight` distance, `octile` (steps to "
             "eight neighbours), `manhattan` (to four); `default` chooses what suits the motion model"},
            {"obstacle_heuristic", &P::obstacleHeuristic, yesOrNo(), "",
             "guide the search round obstacles (car model)"},
            {"look_ahead", &P::lookAhead, yesOrNo(), "",
             "drive on along the way round obstacles while there is room, without looking at each step (car model)"},
            {"spread_out", &P::spreadOut, yesOrNo(), "",
             "while no path is known, rather search where less has been searched, by place and heading (car model)"},
            {"detours", &P::detours, yesOrNo(), "",
             "when the search is stuck: try ways through wider gaps, explore, and look for a proof that there is no "
             "way (car "
             "model)"},
            {"obstacle_loading", &P::obstacleLoading, oneOf(obstacleLoadings), "",
             "when to find out which cells are free: as the search asks, or all of them beforehand"},
            {"adaptive_resolution", &P::adaptiveResolution, yesOrNo(), "",
             "search finely where coarse steps do not get through (car model)"},
            {"analytic_expansion", &P::analyticExpansion, yesOrNo(), "",
             "join the two frontiers by Reeds-Shepp or Dubins curves (car model); without it nothing ends exactly at "
             "the "
             "goal"},
            {"reverse_penalty", &P::reversePenalty, between(0.0, 100.0, 0.1), "", "extra cost per metre in reverse"},
            {"gear_change_penalty", &P::gearChangePenalty, between(0.0, 100.0, 0.1), "m",
             "cost of a change of direction"},
            {"steering_change_penalty", &P::steeringChangePenalty, between(0.0, 100.0, 0.1), "m",
             "cost of turning the wheels from straight to full lock"},
            {"clearance_weight", &P::clearanceWeight, between(0.0, 100.0, 0.1), "",
             "extra cost per metre driven in touch with an obstacle, falling to none at 1 m of clearance; needs a "
             "checker that knows clearances"},
            {"preferred_clearance", &P::preferredClearance, between(0.0, 10.0, 0.01), "m",
             "the path keeps so far from obstacles where that is cheap; 0: it may graze them (car model, with a "
             "checker "
             "that knows clearances)"},
            {"clearance_cost", &P::clearanceCost, between(0.0, 100.0, 0.5), "m",
             "what a metre driven nearer than `preferred_clearance` is worth, in metres of detour"},
            {"smoothing", &P::smoothing, oneOf(smoothings), "", "B-spline through the path (grid models)"},
            {"shortening", &P::shortening, yesOrNo(), "",
             "replace parts of the solution by cheaper curves, move its cusps, and drive parts of it the other way "
             "round (car model)"},
            {"approximate", &P::approximate, yesOrNo(), "",
             "end as near to the goal as possible when it cannot be reached"},
            {"anytime", &P::anytime, yesOrNo(), "", "after the first solution go on improving until terminated"},
            {"max_memory_mb", &P::maxMemoryMb, between(16.0, 1048576.0, 1.0), "MB",
             "of the search: with more it ends as when the time is up, and says so"}};
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
        const auto checkValue = [this](const auto &value)
        {
            using Value = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, std::string>)
            {
                const Names known = values.names();
                if (std::find(known.begin(), known.end(), value) == known.end())
                    throw Error(unknownName("value for " + name, value, known));
            }
            else if constexpr (!std::is_same_v<Value, bool>)
            {
                const double number = value;
                const bool isStep =
                    !std::is_same_v<Value, unsigned int> || std::fmod(number - values.min, values.step) == 0.0;
                if (!isWithin(values, number) || !isStep)
                    throw Error(name + " must be " + allowed() + ", not " + formatNumber(number));
            }
        };
        std::visit([&](const auto at) { checkValue(parameters.*at); }, member);
    }

    void Parameter::setNumber(PlannerParameters &parameters, double value) const
    {
        if (const auto *number = std::get_if<double P::*>(&member))
            parameters.*(*number) = value;
        else
        {
            constexpr double MAX = std::numeric_limits<unsigned int>::max();
            if (!(value >= 0.0 && value <= MAX) || value != std::floor(value))
                throw Error(name + " must be " + allowed() + ", not " + formatNumber(value));
            parameters.*std::get<unsigned int P::*>(member) = static_cast<unsigned int>(value);
        }
    }

    void Parameter::setText(PlannerParameters &parameters, const std::string &text) const
    {
        PlannerParameters changed = parameters;
        double number = 0.0;
        const bool isSwitch = std::holds_alternative<bool P::*>(member);
        if (const auto *at = std::get_if<std::string P::*>(&member))
            changed.*(*at) = text;
        else if (isSwitch && (text == "true" || text == "false"))
            changed.*std::get<bool P::*>(member) = text == "true";
        else if (!isSwitch && parseNumber(text, number))
            setNumber(changed, number);
        else
            throw Error(name + " must be " + allowed() + ", not " + inQuotes(text));
        check(changed);
        parameters = std::move(changed);
    }

    const Parameter &parameterNamed(std::string_view name)
    {
        const auto &table = parameterTable();
        const auto row =
            std::find_if(table.begin(), table.end(), [&](const Parameter &each) { return each.name == name; });
        if (row == table.end())
        {
            Names names;
            for (const Parameter &each : table)
                names.push_back(each.name);
            throw Error(unknownName("parameter", std::string(name), names));
        }
        return *row;
    }

    void checkParameters(const PlannerParameters &parameters)
    {
        for (const Parameter &row : parameterTable())
            row.check(parameters);
    }

    std::vector<std::string> parameterSetNames()
    {
        Names names;
        for (const NamedSet &set : SETS)
            names.emplace_back(set.name);
        return names;
    }

    PlannerParameters parameterSet(const std::string &name, const PlannerParameters &current)
    {
        const auto found =
            std::find_if(SETS.begin(), SETS.end(), [&](const NamedSet &set) { return set.name == name; });
        if (found == SETS.end())
            throw Error(unknownName("parameter set", name, parameterSetNames()));
        PlannerParameters set;
        found->change(set);
        set.parameterSet = name;
        set.turningRadius = current.turningRadius;
        set.xyResolution = current.xyResolution;
        set.headingBins = current.headingBins;
        return set;
    }
}  // namespace parking
