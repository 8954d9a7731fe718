// Parameters by name: set, read, refused, in sets, and what each promises.

#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <variant>

#include <ompl/util/Exception.h>

namespace
{
    using namespace parking_test;
    using parking::Parameter;
    using parking::PlannerParameters;
    using Values = std::map<std::string, std::string>;

    bool isSwitch(const Parameter &row)
    {
        return std::holds_alternative<bool PlannerParameters::*>(row.member);
    }

    /** The last value of a row, which is never the default, as ParamSet writes it. */
    std::string lastValue(const Parameter &row)
    {
        if (isSwitch(row))
            return PlannerParameters().*std::get<bool PlannerParameters::*>(row.member) ? "0" : "1";
        return row.values.names ? row.values.names().back() : parking::formatNumber(row.values.max);
    }

    std::string rangeOf(const Parameter &row)
    {
        std::ostringstream range;
        if (isSwitch(row))
            range << "0,1";
        else if (row.values.names)
            for (const std::string &name : row.values.names())
                range << (range.str().empty() ? "" : ",") << name;
        else
            range << (row.values.allowsZero ? 0.0 : row.values.min) << ':' << row.values.step << ':'
                  << std::setprecision(9) << row.values.max;
        return range.str();
    }

    Values valuesOf(const og::ImprovedAStar &planner)
    {
        Values result;
        planner.params().getParams(result);
        return result;
    }

    TEST(PlannerParameters, HaveRangeAndValueOfEveryRowAndRefuseOthers)
    {
        og::ImprovedAStar planner(PlanningProblem(Space::SE2, square()).si);
        ob::ParamSet &params = planner.params();
        const Values defaults = valuesOf(planner);
        EXPECT_EQ(defaults.size(), parking::parameterTable().size());
        for (const Parameter &row : parking::parameterTable())
        {
            SCOPED_TRACE(row.name);
            ASSERT_TRUE(params.hasParam(row.name));
            EXPECT_EQ(params[row.name].getRangeSuggestion(), rangeOf(row));
            Values expected = defaults;
            expected[row.name] = lastValue(row);
            EXPECT_NE(expected, defaults);
            EXPECT_TRUE(params.setParam(row.name, lastValue(row)));
            // This one sets others, too.
            EXPECT_TRUE(valuesOf(planner) == expected || row.name == "parameter_set");
            EXPECT_TRUE(planner.parameters() != PlannerParameters());
            EXPECT_TRUE(params.setParam(row.name, defaults.at(row.name)));
            EXPECT_TRUE(planner.parameters() == PlannerParameters());
            if (isSwitch(row))
                continue;
            const std::string wrong = row.values.names ? "hovercraft" : parking::formatNumber(row.values.max + 1.0);
            try
            {
                params.setParam(row.name, wrong);
                ADD_FAILURE() << "not refused";
            }
            catch (const ompl::Exception &error)
            {
                const std::string message = error.what();
                for (const std::string &part : {row.name, wrong})
                    EXPECT_NE(message.find(part), std::string::npos) << message;
                // Of many names it says the nearest.
                EXPECT_TRUE(message.find(row.allowed()) != std::string::npos ||
                            message.find("; the nearest of ") != std::string::npos)
                    << message;
                EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            }
        }
        // OMPL answers false or throws for these, depending on the release and the type.
        for (const auto &[name, value] : settings("turning_radius=wide heading_bins=many steering=3"))
            try
            {
                EXPECT_FALSE(params.setParam(name, value)) << name;
            }
            catch (const std::exception &)
            {
            }
        PlannerParameters bad;
        bad.headingBins = 36;
        bad.reversePenalty = std::nan("");
        EXPECT_THROW(planner.setParameters(bad), ompl::Exception);
        EXPECT_EQ(valuesOf(planner), defaults) << "what is refused changes nothing";
        // Names that users' configurations have.
        for (const auto &[name, range] : settings("xy_resolution=0:0.05:100 steering_angles=3:2:21 anytime=0,1 "
                                                  "open_list=binary_heap,linear gear_change_penalty=0:0.1:100"))
            EXPECT_EQ(params[name].getRangeSuggestion(), range);
    }

    // The sets of the paper (its section "Discussion"), told apart by what their names leave out.
    TEST(PlannerParameters, HaveNamedSets)
    {
        og::ImprovedAStar planner(PlanningProblem(Space::SE2, square()).si), wanted(planner.getSpaceInformation());
        const std::string unweighted = " heuristic_weight_far=1 heuristic_weight_near=1 tie_break=0";
        const std::string weighted = " heuristic_weight_far=1.5 heuristic_weight_near=0.9",
                          grid8 = "motion_model=grid8";
        const std::string fromStart = " bidirectional=0 search_from=start",
                          simple = grid8 + fromStart + " open_list=linear";
        const std::map<std::string, std::string> expected{
            {"default", "motion_model=car bidirectional=1 open_list=binary_heap"},
            {"paper_improved_astar", grid8 + weighted + " smoothing=bspline obstacle_loading=lazy bidirectional=1"},
            {"basic_astar", simple + unweighted + " obstacle_loading=eager smoothing=none approximate=0"},
            {"experiment_1", grid8 + unweighted + " smoothing=bspline obstacle_loading=lazy bidirectional=1"},
            {"experiment_2", grid8 + weighted + " obstacle_loading=eager"},
            {"experiment_3", simple + weighted + " smoothing=bspline"},
            {"experiment_4", "motion_model=grid16" + weighted},
            {"experiment_5", grid8 + weighted + " smoothing=none bidirectional=1"},
            {"experiment_6", simple + weighted + " smoothing=none"},
            {"hybrid_astar", "motion_model=car detours=0 shortening=0 adaptive_resolution=0" + fromStart},
        };
        EXPECT_EQ(parking::parameterSetNames().size(), expected.size());
        for (const std::string &name : parking::parameterSetNames())
        {
            SCOPED_TRACE(name);
            planner.setParameters({});
            ASSERT_TRUE(planner.params().setParam("parameter_set", name));
            Values set = valuesOf(planner);
            ASSERT_TRUE(wanted.params().setParams(settings(expected.at(name))));
            for (const auto &[parameter, value] : settings(expected.at(name)))
                EXPECT_EQ(set[parameter], wanted.params()[parameter].getValue()) << parameter;
            // It replaces whatever was set before, except what belongs to the problem.
            for (const Parameter &row : parking::parameterTable())
                planner.params().setParam(row.name, lastValue(row));
            planner.params().setParam("parameter_set", name);
            for (const char *kept : {"turning_radius", "xy_resolution", "heading_bins"})
                set[kept] = lastValue(parking::parameterNamed(kept));
            EXPECT_EQ(valuesOf(planner), set);

            PlanningProblem open(Space::SE2, square(), "parameter_set=" + name);
            ASSERT_EQ(open.from({{-8.0, -3.0, 0.0}}).to({{8.0, 5.0, 0.5}}).solve(), Status::EXACT_SOLUTION);
            open.expectSound();
        }
    }

    struct Totals
    {
        double length{0.0}, reverse{0.0}, gearChanges{0.0}, steering{0.0};
    };

    // Not on every path, but in total.
    TEST(PlannerParameters, LessenWhatTheyPenalise)
    {
        const std::tuple<const char *, const char *, double Totals::*> CASES[] = {
            {"reverse_penalty=5", "reverse_penalty=0", &Totals::reverse},
            {"gear_change_penalty=20", "gear_change_penalty=0", &Totals::gearChanges},
            {"steering_change_penalty=10", "steering_change_penalty=0", &Totals::steering},
            {"shortening=1 clearance_cost=0", "shortening=0 clearance_cost=0", &Totals::length},
            {"turning_radius=2", "turning_radius=5", &Totals::length}};
        for (const auto &[set, unset, what] : CASES)
        {
            Totals with, without;
            for (std::uint64_t seed = 1; seed <= 20; ++seed)
            {
                Random random(seed);
                const Pose start{-9.0, random.between(-9.0, 9.0), random.between(-3.0, 3.0)};
                const Pose goal{9.0, random.between(-9.0, 9.0), random.between(-3.0, 3.0)};
                for (Totals *totals : {&with, &without})
                {
                    PlanningProblem problem(Space::SE2, GAPS, totals == &with ? set : unset);
                    ASSERT_EQ(problem.from({start}).to({goal}).solve(), Status::EXACT_SOLUTION);
                    const parking::Path &path = *problem.planner->solutionPath();
                    totals->gearChanges += static_cast<double>(path.cusps());
                    double curvature = 0.0;
                    for (const parking::PathPiece &piece : path.pieces)
                    {
                        totals->length += piece.driven();
                        totals->reverse += std::max(0.0, -piece.length);
                        totals->steering += std::abs(piece.curvature - std::exchange(curvature, piece.curvature));
                    }
                }
            }
            EXPECT_LT(with.*what, without.*what) << set;
        }
    }

    TEST(PlannerParameters, PreferredClearanceIsKeptWhereItIsCheap)
    {
        const double half = 0.5 * parking::Vehicle().width;
        const Scene beside = square({box(-2.0, half + 0.02, 2.0, 4.0)});
        const Scene between = square({box(-2.0, half + 0.1, 2.0, 15.0), box(-2.0, -15.0, 2.0, -half)});
        const struct
        {
            const char *settings;
            Scene scene;
            double least, most;  // of the path's clearance
        } CASES[] = {
            {"anytime=0", beside, 0.1, 1.0},
            {"anytime=1", beside, 0.1, 1.0},
            {"preferred_clearance=0.5", beside, 0.5, 2.0},
            {"preferred_clearance=0", beside, 0.0, 0.03},
            {"clearance_cost=0", beside, 0.0, 0.03},
            {"preferred_clearance=1", between, 0.0, 0.05},
            {"preferred_clearance=10", between, 0.0, 0.05},
        };
        for (const auto &each : CASES)
        {
            SCOPED_TRACE(each.settings);
            PlanningProblem problem(Space::ReedsShepp, each.scene, each.settings);
            problem.from({{-9.0, 0.0, 0.0}}).to({{9.0, 0.0, 0.0}});
            ASSERT_EQ(problem.solveWithPolls(20000), Status::EXACT_SOLUTION);
            const PolygonOracle oracle(each.scene.obstacles, each.scene.bounds);
            double closest = HUGE_VAL;
            for (const parking::PathState &state : problem.planner->solutionPath()->sample(0.02))
                closest = std::min(closest, oracle.clearance(state.pose, problem.vehicle));
            EXPECT_GE(closest, each.least - 1e-9);
            EXPECT_LE(closest, each.most);
        }
    }

    TEST(PlannerParameters, OpenListAndLoadingOfObstaclesDoNotChangeThePath)
    {
        for (const char *model : {"motion_model=car", "motion_model=grid8", "motion_model=grid16"})
        {
            std::vector<Pose> first;
            for (const char *option : {"open_list=binary_heap", "open_list=linear", "obstacle_loading=eager"})
            {
                PlanningProblem problem(Space::SE2, GAPS, model);
                problem.set(option);
                ASSERT_EQ(problem.from({LEFT}).to({RIGHT}).solve(), Status::EXACT_SOLUTION);
                EXPECT_EQ(problem.planner->mapLoadingTime() > 0.0, std::string(option) == "obstacle_loading=eager");
                first = first.empty() ? problem.poses() : first;
                EXPECT_TRUE(areEqual(problem.poses(), first)) << model << ' ' << option;
            }
        }
    }

    TEST(PlannerParameters, SmoothingRoundsTheCornersOfGridPaths)
    {
        for (const char *smoothing : {"smoothing=none", "smoothing=bspline"})
        {
            PlanningProblem problem(Space::SE2, square(), "motion_model=grid8 turning_radius=1.5");
            problem.set(smoothing);
            ASSERT_EQ(problem.from({{-9.0, -5.0, 0.0}}).to({{9.0, 4.0, 0.0}}).solve(), Status::EXACT_SOLUTION);
            problem.expectSound();
            const std::vector<Pose> poses = problem.poses();
            double sharpest = 0.0;
            for (std::size_t i = 2; i + 1 < poses.size(); ++i)
                sharpest = std::max(sharpest, std::abs(parking::wrapAngle(poses[i].yaw - poses[i - 1].yaw)));
            EXPECT_EQ(sharpest > 0.3, std::string(smoothing) == "smoothing=none");
        }
    }
}  // namespace
