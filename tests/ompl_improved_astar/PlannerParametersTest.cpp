// Every parameter of the planner: by name, out of range, in sets, and its effect.

#include "parking_geometry/text/Text.h"
#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <variant>

#include <ompl/util/Exception.h>

namespace
{
    using namespace parking_test;
    using parking::Parameter;
    using parking::PlannerParameters;
    using parking::Pose;
    using Status = ob::PlannerStatus;

    class PlannerParametersByName : public Silent<testing::Test>
    {
    protected:
        PlannerParametersByName()
        {
            problem.planner->setParameters({});
        }

        PlanningProblem problem{Space::SE2, slotSite()};
        ob::ParamSet &params{problem.planner->params()};
    };

    /** Every parameter with a value other than the default, as ParamSet writes it. */
    std::map<std::string, std::string> others()
    {
        std::map<std::string, std::string> values;
        for (const Parameter &row : parking::parameterTable())
            std::visit(
                [&](const auto member)
                {
                    using Value = std::decay_t<decltype(PlannerParameters().*member)>;
                    if constexpr (std::is_same_v<Value, bool>)
                        values[row.name] = PlannerParameters().*member ? "0" : "1";
                    else if constexpr (std::is_same_v<Value, std::string>)
                        values[row.name] = row.values.names().back();
                    else
                        values[row.name] = parking::formatNumber(row.values.max);
                },
                row.member);
        values.erase("parameter_set");  // which sets the others
        return values;
    }

    TEST_F(PlannerParametersByName, AllAreThereAndNoneElse)
    {
        std::set<std::string> names, expected;
        for (const auto &[name, parameter] : params.getParams())
            names.insert(name);
        for (const Parameter &row : parking::parameterTable())
            expected.insert(row.name);
        EXPECT_EQ(names, expected);
        EXPECT_EQ(params["preferred_clearance"].getRangeSuggestion(), "0:0.01:10");
        EXPECT_EQ(params["xy_resolution"].getRangeSuggestion(), "0:0.05:100");
        EXPECT_EQ(params["steering_angles"].getRangeSuggestion(), "3:2:21");
        EXPECT_EQ(params["anytime"].getRangeSuggestion(), "0,1");
        EXPECT_EQ(params["open_list"].getRangeSuggestion(), "binary_heap,linear");
    }

    // They are an interface: configurations of others use them.
    TEST_F(PlannerParametersByName, NamesAndDefaultsStay)
    {
        const std::map<std::string, std::string> expected{{"adaptive_resolution", "1"},
                                                          {"analytic_expansion", "1"},
                                                          {"anytime", "0"},
                                                          {"approximate", "1"},
                                                          {"bidirectional", "1"},
                                                          {"clearance_cost", "10"},
                                                          {"detours", "1"},
                                                          {"gear_change_penalty", "0.5"},
                                                          {"heading_bins", "72"},
                                                          {"heuristic_weight_far", "2.5"},
                                                          {"heuristic_weight_near", "2.5"},
                                                          {"motion_model", "car"},
                                                          {"near_goal_distance", "5"},
                                                          {"obstacle_heuristic", "1"},
                                                          {"obstacle_loading", "lazy"},
                                                          {"open_list", "binary_heap"},
                                                          {"parameter_set", "default"},
                                                          {"preferred_clearance", "0.1"},
                                                          {"reverse_penalty", "0"},
                                                          {"search_from", "goal"},
                                                          {"shortening", "1"},
                                                          {"smoothing", "bspline"},
                                                          {"steering_angles", "3"},
                                                          {"turning_radius", "3"},
                                                          {"xy_resolution", "0"}};
        std::map<std::string, std::string> values;
        params.getParams(values);
        for (const auto &[name, value] : expected)
            EXPECT_EQ(values[name], value) << name;
        EXPECT_DOUBLE_EQ(std::stod(values["tie_break"]), 1e-3);
        EXPECT_DOUBLE_EQ(std::stod(values["steering_change_penalty"]), 0.1);
    }

    TEST_F(PlannerParametersByName, EachIsSetAndReadAndChangesNoOther)
    {
        for (const auto &[changed, value] : others())
        {
            og::ImprovedAStar planner(problem.si);
            std::map<std::string, std::string> before, after;
            planner.params().getParams(before);
            ASSERT_TRUE(planner.params().setParam(changed, value)) << changed;
            planner.params().getParams(after);
            for (const auto &[name, text] : before)
                EXPECT_TRUE(name == changed || after[name] == text) << changed << " changed " << name;
            EXPECT_EQ(after[changed], value);
            EXPECT_NE(after[changed], before[changed]) << changed;
            // Back again, by what was read.
            ASSERT_TRUE(planner.params().setParam(changed, before[changed]));
            EXPECT_TRUE(planner.parameters() == PlannerParameters()) << changed;
        }
    }

    // What else there is to refuse, the table's own tests have.
    TEST_F(PlannerParametersByName, OutOfRangeIsAnErrorThatSaysSo)
    {
        for (const Parameter &row : parking::parameterTable())
        {
            if (std::holds_alternative<bool PlannerParameters::*>(row.member))
                continue;  // has no values out of range
            const std::string bad =
                row.values.names != nullptr ? "hovercraft" : parking::formatNumber(row.values.max + 1.0);
            try
            {
                params.setParam(row.name, bad);
                ADD_FAILURE() << row.name << " = " << bad << " was taken";
            }
            catch (const ompl::Exception &error)
            {
                const std::string text = error.what();
                EXPECT_NE(text.find(row.name), std::string::npos) << text;
                EXPECT_NE(text.find(bad), std::string::npos) << text;
                EXPECT_NE(text.find(row.allowed()), std::string::npos) << text;
                EXPECT_EQ(text.find('\n'), std::string::npos) << text;
            }
            EXPECT_TRUE(problem.planner->parameters() == PlannerParameters()) << row.name;
        }
    }

    TEST_F(PlannerParametersByName, WhatIsNoNumberOrNoParameterIsRefused)
    {
        // OMPL answers false or throws, by the release and the type.
        const auto isRefused = [this](const char *name, const char *value)
        {
            try
            {
                return !params.setParam(name, value);
            }
            catch (const std::exception &)
            {
                return true;
            }
        };
        EXPECT_TRUE(isRefused("turning_radius", "wide"));
        EXPECT_TRUE(isRefused("turning_radius", "nan"));
        EXPECT_TRUE(isRefused("heading_bins", "many"));
        EXPECT_TRUE(isRefused("steering", "3"));
        EXPECT_FALSE(params.hasParam("steering"));
        EXPECT_TRUE(problem.planner->parameters() == PlannerParameters());
    }

    TEST_F(PlannerParametersByName, AllAtOnceAreCheckedToo)
    {
        PlannerParameters good;
        good.headingBins = 36;
        good.heuristicWeightFar = 2.0;
        problem.planner->setParameters(good);
        EXPECT_TRUE(problem.planner->parameters() == good);
        for (const double wrong : {-1.0, std::nan("")})
        {
            PlannerParameters bad = good;
            bad.anytime = true;
            bad.preferredClearance = wrong;
            EXPECT_THROW(problem.planner->setParameters(bad), ompl::Exception);
            EXPECT_TRUE(problem.planner->parameters() == good);
        }
    }

    void weigh(PlannerParameters &set, const parking::search::HeuristicWeights &weights)
    {
        set.heuristicWeightFar = weights.far;
        set.heuristicWeightNear = weights.near;
        set.nearGoalDistance = weights.nearDistance;
        set.tieBreak = weights.tieBreak;
    }

    // The sets of the paper (its section "Discussion"), told apart from the full one by what their names leave out.
    TEST_F(PlannerParametersByName, NamedSetsChangeWhatTheySay)
    {
        PlannerParameters improved;
        improved.motionModel = "grid8";
        weigh(improved, {1.5, 0.9, 5.0, 1e-3});
        std::map<std::string, PlannerParameters> expected{{"default", {}}, {"improved_astar", improved}};

        PlannerParameters set = improved;
        weigh(set, {1.0, 1.0, 0.0, 0.0});
        expected["experiment_1"] = set;
        set = improved;
        set.obstacleLoading = "eager";
        expected["experiment_2"] = set;
        set = improved;
        set.bidirectional = false;
        set.searchFrom = "start";
        set.openList = "linear";
        expected["experiment_3"] = set;
        set.smoothing = "none";
        expected["experiment_6"] = set;
        weigh(set, {1.0, 1.0, 0.0, 0.0});
        set.obstacleLoading = "eager";
        set.approximate = false;
        expected["basic_astar"] = set;
        set = improved;
        set.motionModel = "grid16";
        expected["experiment_4"] = set;
        set = improved;
        set.smoothing = "none";
        expected["experiment_5"] = set;
        set = {};
        set.bidirectional = set.adaptiveResolution = set.shortening = false;
        set.searchFrom = "start";
        set.detours = false;
        expected["hybrid_astar"] = set;

        EXPECT_EQ(parking::parameterSetNames().size(), expected.size());
        for (const std::string &name : parking::parameterSetNames())
        {
            // Whatever was set before, but for what belongs to the problem.
            for (const auto &[other, value] : others())
                params.setParam(other, value);
            ASSERT_TRUE(params.setParam("parameter_set", name));
            ASSERT_TRUE(expected.count(name)) << name;
            PlannerParameters wanted = expected[name];
            wanted.parameterSet = name;
            wanted.turningRadius = 1000.0;
            wanted.xyResolution = 100.0;
            wanted.headingBins = 1440;
            EXPECT_TRUE(problem.planner->parameters() == wanted) << name;
        }
    }

    TEST_F(PlannerParametersByName, EverySetPlansInTheOpen)
    {
        for (const std::string &name : parking::parameterSetNames())
        {
            PlanningProblem open(Space::SE2, openSite(15.0));
            open.set("parameter_set", name);
            open.from({-8.0, -3.0, 0.0}).to({{8.0, 5.0, 0.5}});
            EXPECT_EQ(open.solve(), Status::EXACT_SOLUTION) << name;
            EXPECT_TRUE(open.path().check()) << name;
        }
    }
}  // namespace
