// Each switch of the planner has the effect that it names.

#include "state_validity/FootprintChecker.h"
#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>

namespace
{
    using namespace parking_test;
    using parking::Path;
    using parking::PathPiece;
    using parking::Pose;
    using Status = ob::PlannerStatus;

    class PlannerSwitches : public Silent<testing::Test>
    {
    protected:
        /** Plans into the slot, or wherever else, with some parameters changed. */
        static PlanningProblem planned(Space kind, const Site &site, const Pose &start, const Pose &goal,
                                       const std::map<std::string, std::string> &parameters)
        {
            PlanningProblem problem(kind, site);
            EXPECT_TRUE(problem.planner->params().setParams(parameters));
            problem.from(start).to({goal});
            EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            return problem;
        }

        static PlanningProblem parked(const std::map<std::string, std::string> &parameters)
        {
            return planned(Space::ReedsShepp, slotSite(), AISLE, SLOT, parameters);
        }

        static double reverse(const Path &path)
        {
            double sum = 0.0;
            for (const PathPiece &segment : path.pieces)
                sum += std::max(0.0, -segment.length);
            return sum;
        }

        static double steering(const Path &path)
        {
            double sum = 0.0;
            for (std::size_t i = 1; i < path.pieces.size(); ++i)
                sum += std::abs(path.pieces[i].curvature - path.pieces[i - 1].curvature);
            return sum;
        }

        static Site gridSite()
        {
            return {{box(-3.0, -10.0, -2.0, 6.0), box(3.0, -6.0, 4.0, 10.0)}, {{-15.0, -15.0}, {15.0, 15.0}}};
        }

        static PlanningProblem onGrid(std::map<std::string, std::string> parameters)
        {
            parameters.emplace("motion_model", "grid8");
            return planned(Space::SE2, gridSite(), {-9.0, -5.0, 0.0}, {9.0, 5.0, 0.0}, parameters);
        }
    };

    /** A checker as most have it says what is valid and no more: all motions are asked for then, whatever clearance is
        preferred. (Once they were taken for clear of obstacles, and the tree grew through them.) */
    TEST_F(PlannerSwitches, RoomCostsNothingWhereTheCheckerKnowsNoClearance)
    {
        const auto checker = std::make_shared<parking::FootprintChecker>(slotSite().set(), parking::Vehicle());
        const auto planned = [&](const char *clearance)
        {
            PlanningProblem problem(Space::ReedsShepp, slotSite().bounds,
                                    [checker](const Pose &pose) { return checker->isFree(pose); });
            problem.set("preferred_clearance", std::string(clearance));
            problem.from(AISLE).to({SLOT});
            EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            return problem;
        };
        const PlanningProblem none = planned("0"), priced = planned("0.1");
        EXPECT_EQ(priced.planner->statistics().expanded, none.planner->statistics().expanded);
        EXPECT_EQ(priced.planner->checkedStates(), none.planner->checkedStates());
        EXPECT_EQ(priced.pdef->getSolutionPath()->length(), none.pdef->getSolutionPath()->length());
        EXPECT_EQ(priced.planner->suboptimalityBound(), none.planner->suboptimalityBound());
    }

    TEST_F(PlannerSwitches, PenaltiesAreAvoided)
    {
        // A longer way round saves reverse, a wide turn changes of gear.
        const Pose start{0.0, 0.0, 0.0}, aslant{-5.0, 5.0, 1.57}, turned{0.5, 0.5, parking::PI};
        const auto plan = [&](const Pose &goal, const std::string &name, const std::string &value)
        {
            PlanningProblem problem(Space::ReedsShepp, openSite(20.0));
            problem.planner->params().setParam(name, value);
            problem.from(start).to({goal});
            EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            return *problem.planner->solutionPath();
        };
        EXPECT_GT(reverse(plan(aslant, "reverse_penalty", "0")), 7.0);
        EXPECT_LT(reverse(plan(aslant, "reverse_penalty", "10")), 4.0);
        EXPECT_EQ(plan(turned, "gear_change_penalty", "1").cusps(), 2u);
        EXPECT_LT(plan(turned, "gear_change_penalty", "20").cusps(), 2u);
        // Two metres to the side: four pieces with the wheels turned to and fro, or three longer ones.
        const auto shift = [&](const std::string &penalty)
        {
            return steering(plan({0.0, 2.0, 0.0}, "steering_change_penalty", penalty));
        };
        EXPECT_LT(shift("10"), 0.8 * shift("0"));
    }

    namespace
    {
        /** A box beside the straight way from (-9, 0) to (9, 0), which passes it at so many metres. */
        Site besideABox(double clearance)
        {
            const parking::Vehicle car;
            Site site = openSite(15.0);
            site.obstacles.push_back(box(-2.0, 0.5 * car.width + clearance, 2.0, 4.0));
            return site;
        }

        double closestOf(const PlanningProblem &problem, const Site &site)
        {
            const parking::FootprintChecker checker(site.set(), problem.vehicle);
            double least = 1e9;
            for (const parking::PathState &state : problem.planner->solutionPath()->sample(0.02))
                least = std::min(least, checker.exactClearance(state.pose));
            return least;
        }
    }  // namespace

    TEST_F(PlannerSwitches, ThePreferredClearanceIsKeptWhereThatIsCheap)
    {
        const Site site = besideABox(0.02);
        const auto plan = [&](const std::map<std::string, std::string> &parameters)
        {
            return planned(Space::ReedsShepp, site, {-9.0, 0.0, 0.0}, {9.0, 0.0, 0.0}, parameters);
        };
        const PlanningProblem usual = plan({}), none = plan({{"preferred_clearance", "0"}}),
                              more = plan({{"preferred_clearance", "0.5"}}),
                              worthless = plan({{"clearance_cost", "0"}});
        EXPECT_GE(closestOf(usual, site), 0.1 - 1e-9);
        EXPECT_GE(closestOf(more, site), 0.5 - 1e-9);
        EXPECT_LT(closestOf(none, site), 0.03);
        EXPECT_LT(closestOf(worthless, site), 0.03);
        EXPECT_LT(usual.planner->solutionPath()->length(), 1.02 * none.planner->solutionPath()->length());
    }

    TEST_F(PlannerSwitches, ThePreferredClearanceGivesWayWhereItIsNarrower)
    {
        // 5 cm on each side, the whole width of the world; and a preference that is larger than the world.
        const parking::Vehicle car;
        const double side = 0.5 * car.width + 0.05;
        const Site site{{box(-2.0, side, 2.0, 15.0), box(-2.0, -15.0, 2.0, -side)}, {{-15.0, -15.0}, {15.0, 15.0}}};
        for (const char *preferred : {"0.1", "1", "10"})
        {
            const PlanningProblem problem = planned(Space::ReedsShepp, site, {-9.0, 1.0, 0.0}, {9.0, -1.0, 0.0},
                                                    {{"preferred_clearance", preferred}});
            EXPECT_GT(closestOf(problem, site), 0.0);
            EXPECT_LE(closestOf(problem, site), 0.05);
        }
    }

    TEST_F(PlannerSwitches, ThePreferredClearanceHoldsForAnytime)
    {
        const Site site = besideABox(0.02);
        PlanningProblem problem(Space::ReedsShepp, site);
        problem.set("anytime", true);
        problem.from({-9.0, 0.0, 0.0}).to({{9.0, 0.0, 0.0}});
        ASSERT_EQ(problem.solveForQuestions(4000), Status::EXACT_SOLUTION);
        EXPECT_GE(closestOf(problem, site), 0.1 - 1e-9);
    }

    TEST_F(PlannerSwitches, BidirectionalGrowsBothTreesOtherwiseOnlyOne)
    {
        const auto trees = [](const PlanningProblem &problem)
        {
            ob::PlannerData data(problem.si);
            problem.planner->getPlannerData(data);
            std::pair<int, int> sizes{0, 0};
            for (unsigned int i = 0; i < data.numVertices(); ++i)
            {
                sizes.first += data.getVertex(i).getTag() == 1;
                sizes.second += data.getVertex(i).getTag() == 2;
            }
            return sizes;
        };
        const auto both = trees(parked({{"bidirectional", "1"}}));
        EXPECT_GT(both.first, 1);
        EXPECT_GT(both.second, 1);
        const auto fromGoal = trees(parked({{"bidirectional", "0"}, {"search_from", "goal"}}));
        EXPECT_EQ(fromGoal.first, 1);
        EXPECT_GT(fromGoal.second, 1);
        const auto fromStart = trees(parked({{"bidirectional", "0"}, {"search_from", "start"}}));
        EXPECT_GT(fromStart.first, 1);
        EXPECT_EQ(fromStart.second, 1);

        const auto grid = trees(onGrid({{"bidirectional", "1"}}));
        EXPECT_GT(grid.second, 1);
        EXPECT_EQ(trees(onGrid({{"bidirectional", "0"}, {"search_from", "goal"}})).first, 1);
        EXPECT_EQ(trees(onGrid({{"bidirectional", "0"}, {"search_from", "start"}})).second, 1);
    }

    TEST_F(PlannerSwitches, TheOpenListChangesTheTimeOnly)
    {
        for (const char *model : {"car", "grid8"})
        {
            const auto plan = [&](const char *list)
            {
                return planned(Space::SE2, gridSite(), {-9.0, -5.0, 0.0}, {9.0, 5.0, 0.0},
                               {{"motion_model", model}, {"open_list", list}});
            };
            const PlanningProblem heap = plan("binary_heap"), linear = plan("linear");
            EXPECT_TRUE(areSame(heap.poses(), linear.poses())) << model;
            EXPECT_EQ(heap.planner->statistics().expanded, linear.planner->statistics().expanded) << model;
        }
    }

    TEST_F(PlannerSwitches, LoadingBeforehandFindsTheSamePathAndTakesMapLoadingTime)
    {
        for (const char *model : {"car", "grid8"})
        {
            const auto plan = [&](const char *loading)
            {
                return planned(Space::SE2, gridSite(), {-9.0, -5.0, 0.0}, {9.0, 5.0, 0.0},
                               {{"motion_model", model}, {"obstacle_loading", loading}});
            };
            const PlanningProblem lazy = plan("lazy"), eager = plan("eager");
            EXPECT_TRUE(areSame(lazy.poses(), eager.poses())) << model;
            EXPECT_EQ(lazy.planner->mapLoadingTime(), 0.0);
            EXPECT_GT(eager.planner->mapLoadingTime(), 0.0);
        }
        // On grids the checks of states are what is loaded.
        EXPECT_GT(onGrid({{"obstacle_loading", "eager"}}).planner->checkedStates(),
                  onGrid({{"obstacle_loading", "lazy"}}).planner->checkedStates());
    }

    TEST_F(PlannerSwitches, SmoothingRoundsTheCornersOfGridPaths)
    {
        Site site = openSite(15.0);
        const auto sharpest = [&](const char *smoothing)
        {
            const PlanningProblem problem =
                planned(Space::SE2, site, {-9.0, -5.0, 0.0}, {9.0, 4.0, 0.0},
                        {{"motion_model", "grid8"}, {"smoothing", smoothing}, {"turning_radius", "1.5"}});
            const std::vector<Pose> poses = problem.poses();
            double angle = 0.0;
            for (std::size_t i = 2; i + 1 < poses.size(); ++i)
                angle = std::max(angle, std::abs(parking::wrapAngle(poses[i].yaw - poses[i - 1].yaw)));
            EXPECT_TRUE(problem.path().check());
            return angle;
        };
        EXPECT_GT(sharpest("none"), 0.7);
        EXPECT_LT(sharpest("bspline"), 0.3);
    }

    TEST_F(PlannerSwitches, GridModelsMoveBetweenNeighbours)
    {
        for (const auto &[model, directions] : {std::pair{"grid8", 8}, {"grid16", 16}})
        {
            const PlanningProblem problem =
                planned(Space::SE2, openSite(15.0), {-9.25, -5.25, 0.0}, {9.25, 4.25, 0.0},
                        {{"motion_model", model}, {"smoothing", "none"}, {"xy_resolution", "0.5"}});
            std::set<int> steps;
            const std::vector<Pose> poses = problem.poses();
            for (std::size_t i = 1; i < poses.size(); ++i)
            {
                const double dx = (poses[i].x - poses[i - 1].x) / 0.5, dy = (poses[i].y - poses[i - 1].y) / 0.5;
                EXPECT_NEAR(dx, std::round(dx), 1e-9);
                EXPECT_NEAR(dy, std::round(dy), 1e-9);
                // Steps in the same direction are one motion.
                const long columns = std::lround(dx), rows = std::lround(dy), count = std::gcd(columns, rows);
                steps.insert(count == 0 ? 0 : static_cast<int>((columns * columns + rows * rows) / (count * count)));
            }
            // Turns on the spot, straight, diagonal, knight's moves.
            for (const int square : steps)
                EXPECT_TRUE(square <= 2 || (directions == 16 && square == 5)) << model << " " << square;
            EXPECT_EQ(steps.count(5), directions == 16 ? 1u : 0u);
        }
    }

    TEST_F(PlannerSwitches, ShorteningShortens)
    {
        EXPECT_LT(parked({{"shortening", "1"}}).path().length(), parked({{"shortening", "0"}}).path().length() + 1e-9);
        Site site = gridSite();
        const auto length = [&](const char *value)
        {
            return planned(Space::ReedsShepp, site, {-9.0, -5.0, 0.0}, {9.0, 5.0, 0.0}, {{"shortening", value}})
                .path()
                .length();
        };
        EXPECT_LT(length("1"), length("0") - 0.1);
    }

    TEST_F(PlannerSwitches, WithoutCurvesNothingEndsExactly)
    {
        PlanningProblem problem(Space::ReedsShepp, openSite(12.0));
        problem.set("analytic_expansion", false);
        problem.from(AISLE).to({{4.0, 2.0, 0.0}});
        EXPECT_EQ(problem.solve(0.3), Status::APPROXIMATE_SOLUTION);
        EXPECT_EQ(problem.planner->statistics().connections, 0u);
        // Near is meant by distance between the rear axles; the headings may still differ, which the difference counts.
        const parking::Pose end = problem.poses().back();
        EXPECT_LT(std::hypot(end.x - 4.0, end.y - 2.0), 0.5);
    }

    TEST_F(PlannerSwitches, AdaptiveResolutionGetsOutOfANarrowSlot)
    {
        // Parallel, 30 cm at each end.
        const parking::Vehicle car;
        const Site site{{box(-15.0, -1.2, -car.rearOverhang - 0.3, 1.2),
                         box(car.wheelbase + car.frontOverhang + 0.3, -1.2, 15.0, 1.2), box(-15.0, -2.0, 15.0, -1.2)},
                        {{-15.0, -4.0}, {15.0, 12.0}}};
        const auto solves = [&](const char *value)
        {
            PlanningProblem problem(Space::ReedsShepp, site);
            problem.planner->params().setParam("adaptive_resolution", value);
            problem.planner->params().setParam("detours", "0");  // exploration finds its way out, too
            problem.from({-8.0, 4.0, 0.0}).to({{0.0, 0.0, 0.0}});
            return problem.solve(20.0) == Status::EXACT_SOLUTION;
        };
        EXPECT_TRUE(solves("1"));
        EXPECT_FALSE(solves("0"));
    }

    TEST_F(PlannerSwitches, TheObstacleHeuristicSavesExpansionsInDeadEnds)
    {
        // A cul-de-sac in the straight way.
        Site site = openSite(20.0);
        site.obstacles = {box(3.0, -5.0, 4.0, 5.0), box(-4.0, 4.0, 3.0, 5.0), box(-4.0, -5.0, 3.0, -4.0)};
        const auto plan = [&](const char *value)
        {
            return planned(Space::ReedsShepp, site, {-1.0, 0.0, 0.0}, {12.0, 0.0, 0.0}, {{"obstacle_heuristic", value}})
                .planner->statistics();
        };
        EXPECT_GT(plan("1").heuristicCells, 0u);
        EXPECT_EQ(plan("0").heuristicCells, 0u);
        EXPECT_LT(plan("1").expanded, plan("0").expanded);
    }

    TEST_F(PlannerSwitches, DetoursSaveExpansionsOnLongRoutes)
    {
        // Three lanes, joined at alternate ends.
        const Site site{{box(0.0, 8.9, 70.0, 9.1), box(10.0, 17.9, 80.0, 18.1)}, {{0.0, 0.0}, {80.0, 27.0}}};
        const auto expanded = [&](const char *value)
        {
            return planned(Space::ReedsShepp, site, {6.0, 4.5, 0.0}, {70.0, 22.5, 0.0}, {{"detours", value}})
                .planner->statistics()
                .expanded;
        };
        EXPECT_LT(2 * expanded("1"), expanded("0"));
    }

    TEST_F(PlannerSwitches, DetoursSaveExpansionsWhereTheCarMustTurnRoundOnTheWay)
    {
        // A narrow aisle with a bay; the car faces the closed end at the start, and away from it at the goal.
        std::uint64_t with = 0, without = 0;
        for (const double length : {80.0, 120.0, 160.0})
            for (const double bay : {10.0, 20.0, 30.0, 40.0, 50.0, 60.0})
            {
                const Site site{{box(0.0, 3.6, bay, 11.0), box(bay + 6.0, 3.6, length, 11.0)},
                                {{0.0, 0.0}, {length, 11.0}}};
                const auto expanded = [&](const char *value)
                {
                    return planned(Space::ReedsShepp, site, {length - 6.0, 1.8, parking::PI}, {5.0, 1.8, 0.0},
                                   {{"detours", value}})
                        .planner->statistics()
                        .expanded;
                };
                with += expanded("1");
                without += expanded("0");
            }
        EXPECT_LT(10 * with, 9 * without);
    }

    TEST_F(PlannerSwitches, WeightsTradeWorkForLength)
    {
        const auto plan = [](const char *weight)
        {
            return onGrid({{"heuristic_weight_far", weight},
                           {"heuristic_weight_near", weight},
                           {"smoothing", "none"},
                           {"bidirectional", "0"}});
        };
        const PlanningProblem exact = plan("1"), greedy = plan("3"), blind = plan("0");
        EXPECT_LT(greedy.planner->statistics().expanded, exact.planner->statistics().expanded);
        EXPECT_LT(exact.planner->statistics().expanded, blind.planner->statistics().expanded);
        const auto driven = [](const PlanningProblem &problem)
        {
            double sum = 0.0;  // without the turns on the spot, which OMPL counts
            const std::vector<Pose> poses = problem.poses();
            for (std::size_t i = 1; i < poses.size(); ++i)
                sum += positionDistance(poses[i], poses[i - 1]);
            return sum;
        };
        EXPECT_LE(driven(exact), driven(greedy) + 1e-9);
        EXPECT_NEAR(driven(exact), driven(blind), 1e-3 * driven(exact));  // tie_break
    }

    TEST_F(PlannerSwitches, ResolutionAndHeadingsSetTheNumberOfCells)
    {
        EXPECT_GT(onGrid({{"xy_resolution", "0.25"}}).planner->statistics().expanded,
                  onGrid({{"xy_resolution", "0.5"}}).planner->statistics().expanded);
        const auto generated = [](const std::map<std::string, std::string> &parameters)
        {
            PlanningProblem problem(Space::ReedsShepp, closedSite());
            problem.planner->params().setParams(parameters);
            problem.set("adaptive_resolution", false);
            problem.set("obstacle_heuristic", false);
            problem.set("approximate", false);
            problem.set("bidirectional", false);
            problem.set("detours", false);  // else the proof that there is no way comes first
            problem.from({-8.0, 0.0, 0.0}).to({{8.0, 0.0, 0.0}});
            EXPECT_EQ(problem.solve(20.0), nothingLeft());
            return problem.planner->statistics().expanded;
        };
        const auto usual = generated({{"xy_resolution", "1"}, {"heading_bins", "24"}});
        EXPECT_GT(generated({{"xy_resolution", "0.5"}, {"heading_bins", "24"}}), usual);
        EXPECT_GT(generated({{"xy_resolution", "1"}, {"heading_bins", "48"}}), usual);
    }

    TEST_F(PlannerSwitches, SteeringAnglesGiveMoreMotions)
    {
        const auto ratio = [](const char *count)
        {
            PlanningProblem problem(Space::ReedsShepp, slotSite());
            problem.planner->params().setParam("steering_angles", count);
            problem.from(AISLE).to({SLOT});
            EXPECT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            const auto statistics = problem.planner->statistics();
            return static_cast<double>(statistics.generated) / static_cast<double>(statistics.expanded);
        };
        EXPECT_GT(ratio("7"), 1.3 * ratio("3"));
    }

    TEST_F(PlannerSwitches, TheTurningRadiusIsKept)
    {
        for (const double radius : {2.0, 3.5, 6.0})
        {
            PlanningProblem problem(Space::SE2, openSite(25.0));
            problem.set("turning_radius", radius);
            problem.from({0.0, 0.0, 0.0}).to({{0.0, 3.0, parking::PI}});
            ASSERT_EQ(problem.solve(), Status::EXACT_SOLUTION);
            double sharpest = 0.0;
            for (const PathPiece &segment : problem.planner->solutionPath()->pieces)
                sharpest = std::max(sharpest, std::abs(segment.curvature));
            EXPECT_NEAR(sharpest, 1.0 / radius, 1e-9);
        }
    }
}  // namespace
