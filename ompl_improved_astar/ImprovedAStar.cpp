#include "ompl_improved_astar/ImprovedAStar.h"

#include "ompl_improved_astar/FootprintEnvironment.h"
#include "ompl_improved_astar/StateSpaceEnvironment.h"
#include "ompl_improved_astar/search/CarPlanner.h"
#include "ompl_improved_astar/search/GridSearch.h"
#include "parking_geometry/BsplineSmoother.h"
#include "state_validity/CircleValidityChecker.h"
#include "state_validity/CurveSpace.h"
#include "state_validity/FclFootprintChecker.h"
#include "state_validity/OmplPose.h"
#include "state_validity/SweptMotionValidator.h"

#include <ompl/base/goals/GoalLazySamples.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>
#include <ompl/util/Exception.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace ob = ompl::base;

namespace ompl::geometric
{
    namespace
    {
        using parking::ArcPath;
        using parking::MotionModel;
        using parking::Pose;
        using parking::search::CarPlanner;
        using parking::search::GridSearch;

        constexpr double INFINITE = std::numeric_limits<double>::infinity();
        constexpr double GRID_RESOLUTION = 0.5;  // metres, when the user leaves the choice

        // Between states of a path on a plain SE2 space, where OMPL interpolates along the chord: a hundredth of the
        // radius keeps the chord within a hundred-thousandth of the radius of the arc.
        constexpr double SPACING_ON_SE2 = 0.01;
        // Between states asked for along a motion with a checker that knows states only, in turning radii.
        constexpr double CHECK_STEP = 0.02;
        constexpr double SWEEP_TOLERANCE = 1e-3;  // metres kept from obstacles

        constexpr unsigned int MAX_GOALS = 16;        // of a region that offers ever more of them
        constexpr unsigned int GOAL_ATTEMPTS = 1000;  // to find a first valid one

        std::optional<Pose> anyGoal(const ob::Goal &goal, const ob::SpaceInformationPtr &si)
        {
            if (goal.hasType(ob::GOAL_STATE))
                return parking::poseOf(goal.as<ob::GoalState>()->getState());
            if (goal.hasType(ob::GOAL_STATES))
            {
                const auto *states = goal.as<ob::GoalStates>();
                if (!states->hasStates())
                    return std::nullopt;
                return parking::poseOf(states->getState(0));
            }
            const auto *region = goal.as<ob::GoalSampleableRegion>();
            if (!region->canSample())
                return std::nullopt;
            ob::ScopedState<> state(si->getStateSpace());
            region->sampleGoal(state.get());
            return parking::poseOf(state.get());
        }
    }  // namespace

    /** What belongs to one query, and the memory that outlives it. */
    struct ImprovedAStar::Query
    {
        std::optional<parking::CurveSpace> space;
        std::unique_ptr<parking::FootprintEnvironment> footprintEnvironment;
        std::unique_ptr<parking::StateSpaceEnvironment> stateEnvironment;
        CarPlanner car;
        GridSearch grid;
        bool begun{false};
        bool gridDone{false};
        std::vector<Pose> starts, goals;
        std::optional<Pose> fallbackTarget;
        ArcPath bestArcs;
        bool hasArcs{false};
        ob::Cost bestCost{INFINITE};
        std::vector<ob::State *> dataStates;
        ob::SpaceInformationPtr si;

        explicit Query(ob::SpaceInformationPtr information) : si(std::move(information))
        {
        }

        Query(const Query &) = delete;
        Query &operator=(const Query &) = delete;

        ~Query()
        {
            freeDataStates();
        }

        void freeDataStates()
        {
            for (ob::State *state : dataStates)
                si->freeState(state);
            dataStates.clear();
        }

        ob::State *dataState(const Pose &pose)
        {
            ob::State *state = si->allocState();
            parking::setPose(state, pose);
            dataStates.push_back(state);
            return state;
        }
    };

    ImprovedAStar::ImprovedAStar(const ob::SpaceInformationPtr &si)
      : ob::Planner(si, "ImprovedAStar"),
        query_(std::make_unique<Query>(si)),
        bestCost_(INFINITE)
    {
        specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
        specs_.approximateSolutions = true;
        specs_.optimizingPaths = true;
        specs_.directed = true;
        specs_.canReportIntermediateSolutions = true;
        declareParameters();
        // Read from other threads while solve() runs.
        addPlannerProgressProperty("best cost REAL", [this] { return std::to_string(bestCost_.load()); });
        addPlannerProgressProperty("iterations INTEGER", [this] { return std::to_string(expanded_.load()); });
    }

    ImprovedAStar::~ImprovedAStar() = default;

    void ImprovedAStar::setup()
    {
        Planner::setup();
        query_->space.emplace(*si_->getStateSpace());
        if (parameters_.motionModel != MotionModel::Car && query_->space->kind() != parking::SpaceKind::SE2)
            throw Exception(getName(), "motion_model " + getMotionModel() +
                                           " needs a plain SE2StateSpace: a Reeds-Shepp or Dubins space would turn its "
                                           "path into loops. Use motion_model car there");
        query_->begun = false;
    }

    void ImprovedAStar::clear()
    {
        Planner::clear();
        clearQuery();
        query_ = std::make_unique<Query>(si_);
        setup_ = false;
    }

    void ImprovedAStar::clearQuery()
    {
        pis_.restart();
        query_->freeDataStates();
        query_->begun = false;
        query_->gridDone = false;
        query_->starts.clear();
        query_->goals.clear();
        query_->fallbackTarget.reset();
        query_->hasArcs = false;
        query_->bestCost = ob::Cost(INFINITE);
        bestCost_ = INFINITE;
        expanded_ = 0;
    }

    void ImprovedAStar::prepareQuery()
    {
        if (query_->begun)
            return;
        query_->begun = true;
        const parking::Bounds bounds = parking::spaceBounds(*si_->getStateSpace());
        const bool plain = query_->space->kind() == parking::SpaceKind::SE2;
        const double radius = plain ? parameters_.turningRadius : query_->space->turningRadius();
        const auto *circle = dynamic_cast<const parking::CircleValidityChecker *>(si_->getStateValidityChecker().get());
        const auto *footprint =
            dynamic_cast<const parking::FclFootprintChecker *>(si_->getStateValidityChecker().get());
        query_->stateEnvironment = std::make_unique<parking::StateSpaceEnvironment>(
            si_, std::min(CHECK_STEP * radius, si_->getStateSpace()->getLongestValidSegmentLength()),
            plain ? SPACING_ON_SE2 * radius : 0.0, circle == nullptr);
        query_->footprintEnvironment.reset();

        if (parameters_.motionModel != MotionModel::Car)
        {
            parking::search::GridParameters grid;
            grid.resolution = parameters_.xyResolution > 0.0 ? parameters_.xyResolution : GRID_RESOLUTION;
            grid.sixteenNeighbours = parameters_.motionModel == MotionModel::Grid16;
            grid.low = bounds.min;
            grid.high = bounds.max;
            grid.weights = parameters_.weights;
            grid.openList = parameters_.openList;
            grid.bidirectional = parameters_.bidirectional;
            grid.eagerObstacles = parameters_.eagerObstacles;
            query_->grid.begin(*query_->stateEnvironment, grid);
            return;
        }

        parking::search::CarPlannerParameters car;
        car.shorten = parameters_.shortening;
        car.anytime = parameters_.anytime;
        car.search.turningRadius = radius;
        car.search.forwardOnly = query_->space->kind() == parking::SpaceKind::Dubins;
        car.search.steeringAngles = parameters_.steeringAngles;
        car.search.xyResolution = parameters_.xyResolution;
        car.search.headingBins = parameters_.headingBins;
        car.search.weights = parameters_.weights;
        car.search.openList = parameters_.openList;
        car.search.bidirectional = parameters_.bidirectional;
        car.search.searchFromGoal = parameters_.searchFromGoal;
        car.search.adaptiveResolution = parameters_.adaptiveResolution;
        car.search.analyticExpansion = parameters_.analyticExpansion;
        car.search.obstacleHeuristic = parameters_.obstacleHeuristic;
        car.search.eagerObstacles = parameters_.eagerObstacles;
        car.search.low = bounds.min;
        car.search.high = bounds.max;
        car.search.cost = {parameters_.reversePenalty,
                           parameters_.gearChangePenalty,
                           parameters_.steeringChangePenalty,
                           parameters_.clearanceWeight,
                           1.0,
                           1.0 / radius};
        parking::search::MotionEnvironment *environment = query_->stateEnvironment.get();
        if (footprint)
        {
            const parking::Vehicle &vehicle = footprint->footprint().vehicle();
            car.search.inscribedRadius =
                std::min({0.5 * vehicle.width, vehicle.rearOverhang, vehicle.wheelbase + vehicle.frontOverhang});
            // The motion validator has the last word unless it asks the same questions of the same checker.
            const bool swept = dynamic_cast<const parking::SweptMotionValidator *>(si_->getMotionValidator().get());
            query_->footprintEnvironment = std::make_unique<parking::FootprintEnvironment>(
                footprint->footprint(), bounds, SWEEP_TOLERANCE, swept ? nullptr : query_->stateEnvironment.get());
            environment = query_->footprintEnvironment.get();
        }
        query_->car.begin(*environment, car);
    }

    bool ImprovedAStar::readInputs(const ob::PlannerTerminationCondition &ptc, ob::PlannerStatus &failure)
    {
        const auto *region = dynamic_cast<const ob::GoalSampleableRegion *>(pdef_->getGoal().get());
        if (!region)
        {
            OMPL_ERROR("%s: Unknown type of goal: a GoalSampleableRegion is needed", getName().c_str());
            failure = ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
            return false;
        }
        prepareQuery();
        const bool car = parameters_.motionModel == MotionModel::Car;
        while (const ob::State *state = pis_.nextStart())
        {
            query_->starts.push_back(parking::poseOf(state));
            car ? query_->car.addStart(query_->starts.back()) : query_->grid.addStart(query_->starts.back());
        }
        if (query_->starts.empty())
        {
            OMPL_ERROR("%s: There are no valid initial states", getName().c_str());
            failure = ob::PlannerStatus::INVALID_START;
            return false;
        }
        const auto add = [&](const ob::State *state)
        {
            const Pose pose = parking::poseOf(state);
            for (const Pose &known : query_->goals)
                if (known.x == pose.x && known.y == pose.y && known.yaw == pose.yaw)
                    return;
            query_->goals.push_back(pose);
            car ? query_->car.addGoal(pose) : query_->grid.addGoal(pose);
        };
        const bool finite = region->maxSampleCount() < std::numeric_limits<unsigned int>::max();
        for (unsigned int attempt = 0; attempt < GOAL_ATTEMPTS && pis_.haveMoreGoalStates() && !ptc; ++attempt)
        {
            if (!finite && query_->goals.size() >= MAX_GOALS)
                break;
            if (const ob::State *state = pis_.nextGoal())
                add(state);
            else if (!finite && !query_->goals.empty())
                break;
        }
        // Lazily sampled goals may be on their way. A list of goals that are all taken grows no longer: OMPL would wait
        // for it until the time is up.
        const auto *lazy = dynamic_cast<const ob::GoalLazySamples *>(region);
        if (query_->goals.empty() && region->couldSample() && (!finite || (lazy != nullptr && lazy->isSampling())))
            if (const ob::State *state = pis_.nextGoal(ptc))
                add(state);
        if (query_->goals.empty())
        {
            query_->fallbackTarget = anyGoal(*pdef_->getGoal(), si_);
            if (!query_->fallbackTarget || !parameters_.approximate)
            {
                OMPL_ERROR("%s: Unable to find a valid goal state", getName().c_str());
                failure = ob::PlannerStatus::INVALID_GOAL;
                return false;
            }
        }
        return true;
    }

    ob::PlannerStatus ImprovedAStar::solve(const ob::PlannerTerminationCondition &ptc)
    {
        checkValidity();
        ob::PlannerStatus failure;
        if (ptc)
            return ob::PlannerStatus::TIMEOUT;
        if (!readInputs(ptc, failure))
            return failure;
        query_->stateEnvironment->setStop([&ptc] { return ptc(); });
        const ob::PlannerStatus status = parameters_.motionModel == MotionModel::Car ? solveCar(ptc) : solveGrid(ptc);
        query_->stateEnvironment->setStop(nullptr);
        return status;
    }

    ob::Cost ImprovedAStar::costOf(const ob::PathPtr &path) const
    {
        // Not stored in the problem definition, where it would change what other planners do with it.
        if (const ob::OptimizationObjectivePtr &objective = pdef_->getOptimizationObjective())
            return path->cost(objective);
        return ob::Cost(path->length());
    }

    ob::PlannerStatus ImprovedAStar::solveCar(const ob::PlannerTerminationCondition &ptc)
    {
        const double spacing =
            query_->space->kind() == parking::SpaceKind::SE2 ? SPACING_ON_SE2 * parameters_.turningRadius : 0.0;
        const auto stop = [this, &ptc]
        {
            expanded_.store(query_->car.statistics().expanded, std::memory_order_relaxed);
            return ptc();
        };
        const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective();
        const auto improved = [&](const ArcPath &arcs, double)
        {
            auto path = std::make_shared<PathGeometric>(si_);
            std::vector<const ob::State *> states;
            for (const Pose &pose : parking::pathStates(arcs, spacing))
            {
                ob::ScopedState<> state(si_);
                parking::setPose(state.get(), pose);
                path->append(state.get());
            }
            const ob::Cost cost = costOf(path);
            if (query_->hasArcs && !(objective ? objective->isCostBetterThan(cost, query_->bestCost)
                                               : cost.value() < query_->bestCost.value()))
                return false;
            query_->hasArcs = true;
            query_->bestArcs = arcs;
            query_->bestCost = cost;
            bestCost_.store(cost.value(), std::memory_order_relaxed);
            if (const ob::ReportIntermediateSolutionFn &report = pdef_->getIntermediateSolutionCallback())
            {
                // Goal first, without the ends, as OMPL's planners do.
                for (std::size_t i = path->getStateCount(); i-- > 0;)
                    states.push_back(path->getState(i));
                report(this, states, cost);
            }
            return objective && objective->isSatisfied(cost);
        };
        if (!query_->goals.empty())
            query_->car.solve(stop, improved);
        expanded_ = query_->car.statistics().expanded;
        if (query_->hasArcs)
            return report(parking::pathStates(query_->bestArcs, spacing), false);
        ArcPath nearest;
        const Pose target = query_->goals.empty() ? *query_->fallbackTarget : query_->goals.front();
        if (parameters_.approximate && query_->car.approximate(target, stop, nearest))
        {
            query_->bestArcs = nearest;
            return report(parking::pathStates(nearest, spacing), true);
        }
        return ob::PlannerStatus::TIMEOUT;
    }

    ob::PlannerStatus ImprovedAStar::solveGrid(const ob::PlannerTerminationCondition &ptc)
    {
        GridSearch &grid = query_->grid;
        const Pose target = query_->goals.empty() ? *query_->fallbackTarget : query_->goals.front();
        grid.setTarget(target.x, target.y);
        if (!query_->gridDone)
        {
            const GridSearch::Outcome outcome = grid.run(
                [this, &ptc]
                {
                    expanded_.store(query_->grid.statistics().expanded, std::memory_order_relaxed);
                    return ptc();
                });
            query_->gridDone = outcome == GridSearch::Outcome::Found;
        }
        expanded_ = grid.statistics().expanded;
        if (query_->gridDone)
            return report(smoothed(grid.path()), false);
        if (parameters_.approximate)
            if (const std::vector<Pose> poses = grid.nearestPath(target.x, target.y); !poses.empty())
                return report(smoothed(poses), true);
        return ob::PlannerStatus::TIMEOUT;
    }

    std::vector<Pose> ImprovedAStar::smoothed(const std::vector<Pose> &poses) const
    {
        if (!parameters_.bsplineSmoothing)
            return poses;
        std::vector<Eigen::Vector2d> points;
        for (const Pose &pose : poses)
            if (points.empty() || (points.back() - Eigen::Vector2d(pose.x, pose.y)).norm() > 1e-9)
                points.emplace_back(pose.x, pose.y);
        if (points.size() < 3)
            return poses;
        parking::FootprintQueries world;
        world.isFree = [this](const Pose &pose)
        {
            return query_->stateEnvironment->isFree(pose);
        };
        parking::BsplineOptions options;
        options.maxCurvature = 1.0 / parameters_.turningRadius;
        const parking::BsplinePath smooth = parking::bsplineSmooth(points, options, parking::Vehicle(), world);
        std::vector<Pose> result{poses.front()};
        for (const parking::PathState &state : smooth.path)
            result.push_back(state.pose);
        result.push_back(poses.back());
        // The spline was checked at its states; the motion validator has the last word.
        for (std::size_t i = 1; i < result.size(); ++i)
            if (!query_->stateEnvironment->isMotionFree(result[i - 1], result[i]))
                return poses;
        return result;
    }

    ob::PlannerStatus ImprovedAStar::report(const std::vector<Pose> &poses, bool approximate)
    {
        auto path = std::make_shared<PathGeometric>(si_);
        ob::ScopedState<> state(si_);
        for (const Pose &pose : poses)
        {
            parking::setPose(state.get(), pose);
            path->append(state.get());
        }
        if (!approximate)
        {
            // The exact goal; the path ends there up to rounding.
            const Pose &end = poses.back();
            const auto off = [&end](const Pose &goal)
            {
                return std::hypot(goal.x - end.x, goal.y - end.y) + std::abs(parking::wrapAngle(goal.yaw - end.yaw));
            };
            const auto goal = std::min_element(query_->goals.begin(), query_->goals.end(),
                                               [&off](const Pose &a, const Pose &b) { return off(a) < off(b); });
            if (path->getStateCount() == 1)
                path->append(path->getState(0));
            parking::setPose(path->getState(path->getStateCount() - 1), *goal);
        }
        double difference = 0.0;
        if (approximate)
            pdef_->getGoal()->isSatisfied(path->getState(path->getStateCount() - 1), &difference);
        ob::PlannerSolution solution(path);
        solution.setPlannerName(getName());
        if (approximate)
            solution.setApproximate(difference);
        if (const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective())
        {
            const ob::Cost cost = path->cost(objective);
            solution.setOptimized(objective, cost, !approximate && objective->isSatisfied(cost));
        }
        pdef_->addSolutionPath(solution);
        OMPL_DEBUG("%s: %s path of length %.3f after %llu expansions", getName().c_str(),
                   approximate ? "approximate" : "exact", path->length(),
                   static_cast<unsigned long long>(expanded_.load()));
        return approximate ? ob::PlannerStatus::APPROXIMATE_SOLUTION : ob::PlannerStatus::EXACT_SOLUTION;
    }

    void ImprovedAStar::getPlannerData(ob::PlannerData &data) const
    {
        Planner::getPlannerData(data);
        query_->freeDataStates();
        if (!query_->begun)
            return;
        std::vector<unsigned int> indices[2];
        std::vector<ob::State *> states[2];
        const auto visit = [&](const Pose &pose, std::uint32_t parent, std::uint32_t index, bool fromStart)
        {
            std::vector<ob::State *> &tree = states[fromStart ? 0 : 1];
            if (tree.size() <= index)
                tree.resize(index + 1, nullptr);
            tree[index] = query_->dataState(pose);
            const ob::PlannerDataVertex vertex(tree[index], fromStart ? 1 : 2);
            if (parent == GridSearch::NO_NODE)
                fromStart ? data.addStartVertex(vertex) : data.addGoalVertex(vertex);
            else if (fromStart)
                data.addEdge(ob::PlannerDataVertex(tree[parent], 1), vertex);
            else
                data.addEdge(vertex, ob::PlannerDataVertex(tree[parent], 2));
        };
        parameters_.motionModel == MotionModel::Car ? query_->car.search().forEachNode(visit)
                                                    : query_->grid.forEachNode(visit);
    }

    double ImprovedAStar::mapLoadingTime() const
    {
        return parameters_.motionModel == MotionModel::Car ? query_->car.search().loadingTime()
                                                           : query_->grid.loadingTime();
    }

    parking::search::SearchStatistics ImprovedAStar::statistics() const
    {
        return parameters_.motionModel == MotionModel::Car ? query_->car.statistics() : query_->grid.statistics();
    }

    std::uint64_t ImprovedAStar::checkedStates() const
    {
        std::uint64_t count = query_->stateEnvironment ? query_->stateEnvironment->checkedStates() : 0;
        if (query_->footprintEnvironment)
            count += query_->footprintEnvironment->counts().states;
        return count;
    }

    std::uint64_t ImprovedAStar::exactChecks() const
    {
        return query_->footprintEnvironment ? query_->footprintEnvironment->counts().byFcl : 0;
    }

    const ArcPath *ImprovedAStar::solutionArcs() const
    {
        return query_->hasArcs ? &query_->bestArcs : nullptr;
    }

    double ImprovedAStar::suboptimalityBound()
    {
        return parameters_.motionModel == MotionModel::Car ? query_->car.suboptimalityBound() : INFINITE;
    }
}  // namespace ompl::geometric
