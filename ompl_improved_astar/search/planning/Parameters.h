#pragma once

#include "ompl_improved_astar/search/SearchParameters.h"

#include <string>
#include <variant>
#include <vector>

namespace parking
{
    /** \brief All parameters of the planner, with their defaults.

        What each means, and which values it may have, stands in parameterTable(): a new parameter is a member here and
        a row there. */
    struct PlannerParameters
    {
        std::string parameterSet{"default"};  ///< a name only: parameterSet() makes the values that belong to it
        std::string motionModel{"car"};
        std::string heuristic{"default"};
        double turningRadius{3.0};
        double xyResolution{0.0};
        unsigned int headingBins{72};
        unsigned int steeringAngles{3};
        bool bidirectional{true};
        std::string searchFrom{"goal"};
        std::string openList{"binary_heap"};
        double heuristicWeightFar{2.5};
        double heuristicWeightNear{2.5};
        double nearGoalDistance{5.0};
        double tieBreak{1e-3};
        bool obstacleHeuristic{true};
        bool detours{true};
        std::string obstacleLoading{"lazy"};
        bool adaptiveResolution{true};
        bool analyticExpansion{true};
        double reversePenalty{0.0};
        double gearChangePenalty{0.5};
        double steeringChangePenalty{0.1};
        double clearanceWeight{0.0};
        double preferredClearance{0.1};
        double clearanceCost{10.0};
        std::string smoothing{"bspline"};
        bool shortening{true};
        bool approximate{true};
        bool anytime{false};
        unsigned int maxMemoryMb{512};

        search::HeuristicWeights weights() const
        {
            return {heuristicWeightFar, heuristicWeightNear, nearGoalDistance, tieBreak};
        }
    };

    bool operator==(const PlannerParameters &a, const PlannerParameters &b);
    inline bool operator!=(const PlannerParameters &a, const PlannerParameters &b)
    {
        return !(a == b);
    }

    /** \brief The values that a parameter may have: a range of numbers, or a list of names. */
    struct ParameterValues
    {
        double least{0.0};
        double most{0.0};
        double step{0.0};                              ///< between whole numbers; for others what suits a slider
        bool zeroToo{false};                           ///< zero may lie below least
        std::vector<std::string> (*names)(){nullptr};  ///< of a text
    };

    /** \brief One row of the table: all that there is to know of a parameter. */
    struct Parameter
    {
        using Member = std::variant<bool PlannerParameters::*, unsigned int PlannerParameters::*,
                                    double PlannerParameters::*, std::string PlannerParameters::*>;

        std::string name;        ///< in ParamSet, in `.cfg` files and for `--set`
        Member member;           ///< where its value is
        ParameterValues values;  ///< none for a switch
        std::string unit;        ///< of a number; empty for none
        std::string meaning;     ///< one line of Markdown, for the README's table

        /** \brief What is right, for error messages and tables: "between 0 and 10", "car, grid8, grid16". */
        std::string allowed() const;

        /** \brief Throws parking::Error, naming the parameter, its value and what is right, when the value that it has
            in \e parameters is not allowed. */
        void check(const PlannerParameters &parameters) const;

        /** \brief Gives it, in \e parameters, the value that is written in \e text: true or false, a number, a name.

            Throws parking::Error as check() does when the text means none, or one that is not allowed; \e parameters
            are then as before. `parameter_set` gets its name only, see parameterSet(). */
        void setText(PlannerParameters &parameters, const std::string &text) const;

        /** \brief Gives a number its value, unchecked but for what its type cannot hold: throws parking::Error for a
            count that is not whole, as check() does. Not for switches and names. */
        void setNumber(PlannerParameters &parameters, double value) const;
    };

    /** \brief Every parameter, in the order in which the README lists them. */
    const std::vector<Parameter> &parameterTable();

    /** \brief The row of this name; throws parking::Error naming the nearest one otherwise. */
    const Parameter &parameterNamed(const std::string &name);

    /** \brief Throws parking::Error for the first parameter whose value is not allowed, see Parameter::check(). */
    void checkParameters(const PlannerParameters &parameters);

    /** \brief Names of the parameter sets: `default`, the paper's `basic_astar`, `experiment_1` to `experiment_6` and
        `improved_astar` (its ablation, on the grid model), and `hybrid_astar` (the car model with the improvements
        off). */
    std::vector<std::string> parameterSetNames();

    /** \brief The parameters of a named set; turning radius, resolution and headings are kept from \e current.

        Throws parking::Error listing the known names otherwise. */
    PlannerParameters parameterSet(const std::string &name, const PlannerParameters &current);
}  // namespace parking
