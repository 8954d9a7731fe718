// Every parameter of the planner: by name, out of range, in sets, and its effect.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include <ompl/util/Console.h>
#include <ompl/util/Exception.h>

namespace
{
    using namespace parking_test;
    using parking::MotionModel;
    using parking::PlannerParameters;
    using parking::Pose;
    using parking::search::OpenListKind;
    using Status = ob::PlannerStatus;

    class PlannerParametersByName : public testing::Test
    {
    protected:
        void SetUp() override
        {
            ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
        }

        PlannerParametersByName()
        {
            problem.planner->setParameters({});
        }

        PlanningProblem problem{Space::SE2, slotSite()};
        ob::ParamSet &params{problem.planner->params()};
    };

    /** A value other than the default for each parameter, as text. */
    const std::map<std::string, std::string> OTHER{{"adaptive_resolution", "0"},
                                                   {"analytic_expansion", "0"},
                                                   {"anytime", "1"},
                                                   {"approximate", "0"},
                                                   {"bidirectional", "0"},
                                                   {"clearance_weight", "0.75"},
                                                   {"gear_change_penalty", "2.5"},
                                                   {"heading_bins", "96"},
                                                   {"heuristic_weight_far", "1.25"},
                                                   {"heuristic_weight_near", "1.5"},
                                                   {"motion_model", "grid16"},
                                                   {"near_goal_distance", "7"},
                                                   {"obstacle_heuristic", "0"},
                                                   {"obstacle_loading", "eager"},
                                                   {"open_list", "linear"},
                                                   {"reverse_penalty", "0.5"},
                                                   {"search_from", "start"},
                                                   {"shortening", "0"},
                                                   {"smoothing", "none"},
                                                   {"steering_angles", "7"},
                                                   {"steering_change_penalty", "0.25"},
                                                   {"tie_break", "0.01"},
                                                   {"turning_radius", "4.5"},
                                                   {"xy_resolution", "0.4"}};

    TEST_F(PlannerParametersByName, AllAreThereAndNoneElse)
    {
        std::set<std::string> names;
        for (const auto &[name, parameter] : params.getParams())
            names.insert(name);
        std::set<std::string> expected{"parameter_set"};
        for (const auto &[name, value] : OTHER)
            expected.insert(name);
        EXPECT_EQ(names, expected);
        for (const auto &[name, parameter] : params.getParams())
            EXPECT_FALSE(parameter->getRangeSuggestion().empty()) << name;
    }

    TEST_F(PlannerParametersByName, EachIsSetAndReadAndChangesNoOther)
    {
        for (const auto &[changed, value] : OTHER)
        {
            og::ImprovedAStar planner(problem.si);
            std::map<std::string, std::string> before, after;
            planner.params().getParams(before);
            ASSERT_TRUE(planner.params().setParam(changed, value)) << changed;
            planner.params().getParams(after);
            for (const auto &[name, text] : before)
                EXPECT_TRUE(name == changed || after[name] == text) << changed << " changed " << name;
            EXPECT_NE(after[changed], before[changed]) << changed;
            if (value.find_first_not_of("0123456789.") == std::string::npos)
                EXPECT_DOUBLE_EQ(std::stod(after[changed]), std::stod(value)) << changed;
            else
                EXPECT_EQ(after[changed], value);
            // Back again, by what was read.
            ASSERT_TRUE(planner.params().setParam(changed, before[changed]));
            EXPECT_TRUE(planner.parameters() == PlannerParameters()) << changed;
        }
    }

    TEST_F(PlannerParametersByName, OutOfRangeIsAnErrorThatSaysSo)
    {
        struct Bad
        {
            const char *name, *value, *range;
        };
        const Bad all[] = {{"turning_radius", "0", "positive number of metres"},
                           {"turning_radius", "-1", "positive number of metres"},
                           {"xy_resolution", "-0.1", "at least 0"},
                           {"xy_resolution", "100.5", "at most 100"},
                           {"heading_bins", "7", "between 8 and 1440"},
                           {"heading_bins", "1441", "between 8 and 1440"},
                           {"steering_angles", "1", "odd number between 3 and 21"},
                           {"steering_angles", "4", "odd number between 3 and 21"},
                           {"steering_angles", "23", "odd number between 3 and 21"},
                           {"heuristic_weight_far", "-1", "at least 0"},
                           {"heuristic_weight_near", "-0.5", "at least 0"},
                           {"near_goal_distance", "-2", "at least 0"},
                           {"tie_break", "-0.001", "at least 0"},
                           {"reverse_penalty", "-1", "at least 0"},
                           {"gear_change_penalty", "-1", "at least 0"},
                           {"steering_change_penalty", "-1", "at least 0"},
                           {"clearance_weight", "-1", "at least 0"},
                           {"motion_model", "hovercraft", "car, grid8, grid16"},
                           {"open_list", "stack", "binary_heap, linear"},
                           {"obstacle_loading", "never", "lazy, eager"},
                           {"smoothing", "some", "bspline, none"},
                           {"search_from", "middle", "goal, start"},
                           {"parameter_set", "experiment_7", "experiment_6"}};
        for (const Bad &bad : all)
        {
            const PlannerParameters before = problem.planner->parameters();
            try
            {
                params.setParam(bad.name, bad.value);
                ADD_FAILURE() << bad.name << " = " << bad.value << " was taken";
            }
            catch (const ompl::Exception &error)
            {
                const std::string text = error.what();
                const std::string name = std::string(bad.name) == "parameter_set" ? "parameter set" : bad.name;
                EXPECT_NE(text.find(name), std::string::npos) << text;
                EXPECT_NE(text.find(bad.value), std::string::npos) << text;
                EXPECT_NE(text.find(bad.range), std::string::npos) << text;
                EXPECT_EQ(text.find('\n'), std::string::npos) << text;
            }
            EXPECT_TRUE(problem.planner->parameters() == before) << bad.name;
        }
    }

    // As text OMPL itself refuses them.
    TEST_F(PlannerParametersByName, NotANumberAndInfinityAreOutOfRange)
    {
        using P = og::ImprovedAStar;
        const std::map<std::string, void (P::*)(double)> setters{
            {"turning_radius", &P::setTurningRadius},
            {"xy_resolution", &P::setXyResolution},
            {"heuristic_weight_far", &P::setHeuristicWeightFar},
            {"heuristic_weight_near", &P::setHeuristicWeightNear},
            {"near_goal_distance", &P::setNearGoalDistance},
            {"tie_break", &P::setTieBreak},
            {"reverse_penalty", &P::setReversePenalty},
            {"gear_change_penalty", &P::setGearChangePenalty},
            {"steering_change_penalty", &P::setSteeringChangePenalty},
            {"clearance_weight", &P::setClearanceWeight}};
        for (const auto &[name, set] : setters)
            for (const double value :
                 {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()})
            {
                try
                {
                    ((*problem.planner).*set)(value);
                    ADD_FAILURE() << name << " = " << value << " was taken";
                }
                catch (const ompl::Exception &error)
                {
                    const std::string text = error.what();
                    EXPECT_NE(text.find(name), std::string::npos) << text;
                    EXPECT_NE(text.find(std::isnan(value) ? "nan" : "inf"), std::string::npos) << text;
                }
                EXPECT_TRUE(problem.planner->parameters() == PlannerParameters()) << name;
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
        good.weights.far = 2.0;
        problem.planner->setParameters(good);
        EXPECT_TRUE(problem.planner->parameters() == good);
        for (int i = 0; i < 5; ++i)
        {
            PlannerParameters bad = good;
            bad.anytime = true;
            (i == 0   ? bad.turningRadius
             : i == 1 ? bad.xyResolution
             : i == 2 ? bad.weights.tieBreak
             : i == 3 ? bad.gearChangePenalty
                      : bad.clearanceWeight) = -1.0;
            EXPECT_THROW(problem.planner->setParameters(bad), ompl::Exception);
            EXPECT_TRUE(problem.planner->parameters() == good);
        }
    }

    // The sets of the paper (its section "Discussion"), told apart from the full one by what their names leave out.
    TEST_F(PlannerParametersByName, NamedSetsChangeWhatTheySay)
    {
        PlannerParameters improved;
        improved.motionModel = MotionModel::Grid8;
        improved.weights = {1.5, 0.9, 5.0, 1e-3};
        std::map<std::string, PlannerParameters> expected{{"default", {}}, {"improved_astar", improved}};

        PlannerParameters set = improved;
        set.weights = {1.0, 1.0, 0.0, 0.0};
        expected["experiment_1"] = set;
        set = improved;
        set.eagerObstacles = true;
        expected["experiment_2"] = set;
        set = improved;
        set.bidirectional = set.searchFromGoal = false;
        set.openList = OpenListKind::Linear;
        expected["experiment_3"] = set;
        set.bsplineSmoothing = false;
        expected["experiment_6"] = set;
        set.weights = {1.0, 1.0, 0.0, 0.0};
        set.eagerObstacles = true;
        set.approximate = false;
        expected["basic_astar"] = set;
        set = improved;
        set.motionModel = MotionModel::Grid16;
        expected["experiment_4"] = set;
        set = improved;
        set.bsplineSmoothing = false;
        expected["experiment_5"] = set;
        set = {};
        set.bidirectional = set.searchFromGoal = set.adaptiveResolution = set.shortening = false;
        expected["hybrid_astar"] = set;

        EXPECT_EQ(parking::parameterSetNames().size(), expected.size());
        for (const std::string &name : parking::parameterSetNames())
        {
            // Whatever was set before, but for what belongs to the problem.
            for (const auto &[other, value] : OTHER)
                params.setParam(other, value);
            ASSERT_TRUE(params.setParam("parameter_set", name));
            ASSERT_TRUE(expected.count(name)) << name;
            PlannerParameters wanted = expected[name];
            wanted.turningRadius = 4.5;
            wanted.xyResolution = 0.4;
            wanted.headingBins = 96;
            EXPECT_TRUE(problem.planner->parameters() == wanted) << name;
            EXPECT_EQ(problem.planner->getParameterSet(), name);
        }
    }

    TEST_F(PlannerParametersByName, EverySetPlansInTheOpen)
    {
        for (const std::string &name : parking::parameterSetNames())
        {
            PlanningProblem open(Space::SE2, openSite(15.0));
            open.planner->setParameterSet(name);
            open.from({-8.0, -3.0, 0.0}).to({{8.0, 5.0, 0.5}});
            EXPECT_EQ(open.solve(), Status::EXACT_SOLUTION) << name;
            EXPECT_TRUE(open.path().check()) << name;
        }
    }
}  // namespace
