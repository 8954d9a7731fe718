#pragma once

#include "ompl_improved_astar/search/HeuristicWeights.h"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace parking
{
    /** \brief All parameters of the planner, with their defaults.

        parameterTable() documents each and limits its values: a new parameter is a member here and a row there. */
    struct PlannerParameters
    {
        std::string parameterSet{"default"};  ///< only a name: parameterSet() returns its values
        std::string motionModel{"car"};       ///< motion_model: name of a search::MotionModel
        std::string heuristic{"default"};     ///< heuristic: name of a search::Heuristic, or `default`
        double turningRadius{3.0};            ///< turning_radius: metres, on a plain SE2 space only
        double xyResolution{0.0};             ///< xy_resolution: metres, side of a cell; 0: chosen
        unsigned int headingBins{72};         ///< heading_bins: cells round the circle
        unsigned int steeringAngles{3};       ///< steering_angles: odd, straight included
        bool bidirectional{true};             ///< bidirectional: search from both ends
        std::string searchFrom{"goal"};       ///< search_from: goal or start, when from one end
        std::string openList{"binary_heap"};  ///< open_list: name of a search::OpenList
        double heuristicWeightFar{2.5};       ///< heuristic_weight_far: w far from the target
        double heuristicWeightNear{2.5};      ///< heuristic_weight_near: w near it
        double nearGoalDistance{5.0};         ///< near_goal_distance: metres, where w changes
        double tieBreak{1e-3};                ///< tie_break: p, added to w
        bool obstacleHeuristic{true};         ///< obstacle_heuristic: guide round obstacles
        bool detours{true};                   ///< detours: drive ahead, spread out, try other routes when stuck
        std::string obstacleLoading{"lazy"};  ///< obstacle_loading: lazy or eager
        bool adaptiveResolution{true};        ///< adaptive_resolution: refine where needed
        bool analyticExpansion{true};         ///< analytic_expansion: join by curves
        double reversePenalty{0.0};           ///< reverse_penalty: extra cost per metre
        double gearChangePenalty{0.5};        ///< gear_change_penalty: metres, per change
        double steeringChangePenalty{0.1};    ///< steering_change_penalty: metres, straight to full lock
        double preferredClearance{0.1};       ///< preferred_clearance: metres
        double clearanceCost{10.0};           ///< clearance_cost: extra cost per metre nearer
        std::string smoothing{"bspline"};     ///< smoothing: bspline or none (grid models)
        bool shortening{true};                ///< shortening: by curves
        bool approximate{true};               ///< approximate: end near an unreachable goal
        bool anytime{false};                  ///< anytime: improve until terminated
        unsigned int maxMemoryMb{512};        ///< max_memory_mb: MB of the search
        double goalTolerance{1e-5};           ///< goal_tolerance: metres and radians
        double initialStraight{0.0};          ///< initial_straight: metres; 0: none
        double finalStraight{0.0};            ///< final_straight: metres; 0: none
        bool escape{false};                   ///< escape: leave a shallow contact at the start
        double maxEscapeDepth{0.05};          ///< max_escape_depth: metres

        /** \brief The four weights in the form of the search. */
        search::HeuristicWeights weights() const
        {
            return {heuristicWeightFar, heuristicWeightNear, nearGoalDistance, tieBreak};
        }
    };

    /** \brief Whether all parameters are equal. */
    bool operator==(const PlannerParameters &a, const PlannerParameters &b);

    /** \brief Whether any parameter differs. */
    inline bool operator!=(const PlannerParameters &a, const PlannerParameters &b)
    {
        return !(a == b);
    }

    /** \brief The values that a parameter may have: a range of numbers, or a list of names. */
    struct ParameterValues
    {
        double min{0.0};         ///< smallest number
        double max{0.0};         ///< largest number
        double step{0.0};        ///< between values: fixed for integers, a suggestion for sliders otherwise
        bool allowsZero{false};  ///< whether zero is allowed even below the smallest number
        /** Lists the values of a text; nullptr for a number or a switch. */
        std::vector<std::string> (*names)(){nullptr};
    };

    /** \brief One row of the parameter table. */
    struct Parameter
    {
        /** \brief A member of PlannerParameters. */
        using Member = std::variant<bool PlannerParameters::*, unsigned int PlannerParameters::*,
                                    double PlannerParameters::*, std::string PlannerParameters::*>;

        std::string name;        ///< in ParamSet, in `.cfg` files and for `--set`
        Member member;           ///< member with its value
        ParameterValues values;  ///< none for a switch
        std::string unit;        ///< of a number; empty for none
        std::string meaning;     ///< one line of Markdown, for docs/parameters.md

        /** \brief Valid values for messages and tables: "between 0 and 10", "car, grid8, grid16". */
        std::string allowed() const;

        /** \brief Throws parking::Error with parameter, value and valid values if its value in \e parameters is
            invalid. */
        void check(const PlannerParameters &parameters) const;

        /** \brief Sets it in \e parameters to the value in \e text: true or false, a number, or a name.

            Throws parking::Error as check() does for an invalid text or value and then leaves \e parameters unchanged.
            For `parameter_set` only the name is set, see parameterSet(). */
        void setText(PlannerParameters &parameters, const std::string &text) const;

        /** \brief Sets a number without checking its range. Throws parking::Error for a count that is not an integer.
            Not for switches and names. */
        void setNumber(PlannerParameters &parameters, double value) const;
    };

    /** \brief Every parameter, in the order in which docs/parameters.md lists them. */
    const std::vector<Parameter> &parameterTable();

    /** \brief The row of this name. Throws parking::Error with the nearest name, or as checkNotRemoved(). */
    const Parameter &parameterNamed(std::string_view name);

    /** \brief Throws parking::Error with the replacement if \e name is a removed parameter. */
    void checkNotRemoved(std::string_view name);

    /** \brief Throws parking::Error for the first invalid parameter, see Parameter::check(). */
    void checkParameters(const PlannerParameters &parameters);

    /** \brief Names of the parameter sets: `default`, the paper's `basic_astar`, `experiment_1` to `experiment_6` and
        `paper_improved_astar` (its ablation, on the grid model), and `hybrid_astar` (the car model with the
        improvements off). */
    std::vector<std::string> parameterSetNames();

    /** \brief The current name of a parameter set: `paper_improved_astar` for its alias `improved_astar`, otherwise
        \e name. */
    std::string parameterSetName(const std::string &name);

    /** \brief The parameters of a named set; turning radius, resolution and headings are kept from \e current.

        Throws parking::Error with the known names for an unknown one. */
    PlannerParameters parameterSet(const std::string &name, const PlannerParameters &current);
}  // namespace parking
