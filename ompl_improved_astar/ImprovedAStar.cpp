#include "ompl_improved_astar/ImprovedAStar.h"

#include "ompl_improved_astar/DrivingCostObjective.h"
#include "ompl_improved_astar/ExactType.h"
#include "ompl_improved_astar/StateSpaceEnvironment.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/GridSmoothing.h"
#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "ompl_improved_astar/search/planning/PathStates.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/ompl/CircleValidityChecker.h"
#include "state_validity/ompl/CurveSpace.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplCompatibility.h"
#include "state_validity/ompl/OmplPose.h"
#include "state_validity/ompl/SweptMotionValidator.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/PlannerData.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalLazySamples.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>
#include <ompl/util/Exception.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace ob = ompl::base;

namespace ompl::geometric
{
    namespace
    {
        using parking::Path;
        using parking::Pose;
        using parking::search::CarInSpace;
        using parking::search::MotionEnvironment;
        using parking::search::PathPlanner;
        using parking::search::PlanOutcome;
        using parking::search::SearchStatistics;

        constexpr double FARTHEST_DUBINS = 1e7;  // coordinates in turning radii
        constexpr double SAME_POSE = 1e-12;      // metres and radians
        constexpr double STAYS = 1e-3;           // metres that OMPL may drive to a goal within the tolerance

        constexpr unsigned int MAX_SAMPLED_GOALS = 16;   // read at first from a region or a longer list
        constexpr unsigned int MAX_LISTED_GOALS = 1000;  // all are read from a list of this length
        constexpr unsigned int GOAL_ATTEMPTS = 1000;     // samples of a region for a first valid or reachable goal

        /** Whether the goals are so few that all are read at first. */
        bool isShort(const ob::GoalSampleableRegion &region)
        {
            return region.maxSampleCount() <= MAX_LISTED_GOALS;
        }

        /** Whether the goals are a list, or few enough to be read as one. Large finite numbers of samples, such as
            INT_MAX, stand for a continuous region. */
        bool isList(const ob::GoalSampleableRegion &region)
        {
            return region.hasType(ob::GOAL_STATES) || isShort(region);
        }

        /** The states that OMPL has stored so far: starts, or the goals of a goal state or a list. */
        std::vector<Pose> storedStarts(const ob::ProblemDefinition &problem)
        {
            std::vector<Pose> poses;
            for (unsigned int i = 0; i < problem.getStartStateCount(); ++i)
                poses.push_back(parking::poseOf(problem.getStartState(i)));
            return poses;
        }

        std::vector<Pose> storedGoals(const ob::Goal &goal)
        {
            std::vector<Pose> poses;
            if (goal.hasType(ob::GOAL_STATE))
                poses.push_back(parking::poseOf(goal.as<ob::GoalState>()->getState()));
            else if (goal.hasType(ob::GOAL_STATES))
                for (std::size_t i = 0; i < goal.as<ob::GoalStates>()->getStateCount(); ++i)
                    poses.push_back(parking::poseOf(goal.as<ob::GoalStates>()->getState(i)));
            return poses;
        }

        /** Whether \e now consists of \e known and, if any, further poses. */
        bool extends(const std::vector<Pose> &now, const std::vector<Pose> &known)
        {
            const auto isEqual = [](const Pose &a, const Pose &b)
            {
                return a.x == b.x && a.y == b.y && a.yaw == b.yaw;
            };
            return now.size() >= known.size() && std::equal(known.begin(), known.end(), now.begin(), isEqual);
        }

        /** May goals that are sampled elsewhere, meanwhile, still come? */
        bool isSampling(const ob::Goal &goal)
        {
            const auto *lazy = dynamic_cast<const ob::GoalLazySamples *>(&goal);
            return lazy != nullptr && lazy->isSampling();
        }

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

        /** In the form that OMPL.app reads: "0,1" for a switch, "min:step:max", or names with commas. */
        std::string rangeSuggestion(const parking::Parameter &row)
        {
            if (std::holds_alternative<bool parking::PlannerParameters::*>(row.member))
                return "0,1";
            const parking::ParameterValues &values = row.values;
            if (values.names == nullptr)
                return parking::formatNumber(values.allowsZero ? 0.0 : values.min) + ":" +
                       parking::formatNumber(values.step) + ":" + parking::formatNumber(values.max);
            std::string names;
            for (const std::string &name : values.names())
                names += (names.empty() ? "" : ",") + name;
            return names;
        }
    }  // namespace

    /** What belongs to one query, and the memory that outlives it. */
    struct ImprovedAStar::Query
    {
        using Row = std::array<double, 3>;

        std::optional<parking::CurveSpace> space;  ///< set by setup()

        /** \brief With an FclFootprintChecker and a model that does not turn on the spot; otherwise null. */
        std::unique_ptr<parking::FootprintEnvironment> footprintEnvironment;

        /** \brief The world where there is no footprintEnvironment, and for its last word. */
        std::unique_ptr<parking::StateSpaceEnvironment> stateEnvironment;

        PathPlanner planner;                        ///< does the planning
        CarInSpace car;                             ///< what the planner has to know of car and space
        bool turnsOnTheSpot{false};                 ///< the motion model's paths do
        bool begun{false};                          ///< whether the planner was told of this query
        parking::PlannerParameters parameters;      ///< of the search, with the weights of the objective
        base::GoalPtr goal;                         ///< the one that the query was begun for
        base::StateValidityCheckerPtr checker;      ///< likewise; the environments ask it
        base::MotionValidatorPtr validator;         ///< likewise
        std::vector<Pose> starts,                   ///< valid ones, as far as they were read
            goals;                                  ///< likewise
        std::vector<Pose> storedStarts,             ///< the problem's, valid or not, at the last solve()
            storedGoals;                            ///< those of a goal state or a list, at the last solve()
        std::set<Row> knownGoals;                   ///< x, y, yaw of goals
        unsigned int otherGoals{0};                 ///< samples of a region after none of the first was reachable
        std::optional<Pose> fallbackTarget;         ///< a goal to come near to when none is valid
        PlanOutcome outcome{PlanOutcome::Timeout};  ///< of the last solve()
        std::string reason;                         ///< why there is no solution, where known
        bool hasSolution{false};                    ///< there is an exact one: path
        Path path;                                  ///< the best one by the problem's objective
        double plannedCost{HUGE_VAL};               ///< of path, by the planner's own model
        double proximity{0.0};                      ///< of that, for being near to obstacles
        std::vector<Pose> states;                   ///< of it, for OMPL
        base::Cost bestCost{HUGE_VAL};              ///< of path
        base::OptimizationObjectivePtr objective;   ///< that bestCost is of; none: length and proximity, in metres
        base::OptimizationObjectivePtr unmapped;    ///< the last one that was logged as not minimised by the search
        bool isCompared{false};                     ///< whether a path by the planner's own weights was offered, too
        SearchStatistics comparison;                ///< of the search for that path
        std::vector<Pose> solution;                 ///< what was reported last, when it was exact
        base::SpaceInformationPtr si;               ///< that of the planner
        std::array<std::vector<base::State *>, 3> dataStates;  ///< of both frontiers and of the solution

        /** \brief A query that has not begun. */
        explicit Query(base::SpaceInformationPtr information) : si(std::move(information))
        {
        }

        Query(const Query &) = delete;
        Query &operator=(const Query &) = delete;

        ~Query()
        {
            freeDataStates();
        }

        /** \brief Is the space a plain SE2 space? */
        bool isPlain() const
        {
            return space->kind() == parking::SpaceKind::SE2;
        }

        /** \brief Smallest turning radius in metres: the space's own or, on a plain SE2 space, the parameter. */
        double turningRadius() const
        {
            return isPlain() ? parameters.turningRadius : space->turningRadius();
        }

        /** \brief How far apart the states of a path may be in this space. */
        parking::StateSpacing stateSpacing() const
        {
            parking::StateSpacing spacing = parking::stateSpacing(isPlain(), turningRadius(), turnsOnTheSpot);
            if (space->kind() == parking::SpaceKind::ReedsShepp)
                spacing.curveLength = [curves = &*space](const Pose &from, const Pose &to)
                {
                    parking::ReedsSheppCurve curve;
                    curves->curve(from, to, curve);
                    return curve.length;
                };
            return spacing;
        }

        /** \brief Ends the query; what depends on the space only is kept, and memory too. */
        void forget()
        {
            freeDataStates();
            begun = false;
            goal.reset();
            starts.clear();
            goals.clear();
            knownGoals.clear();
            storedStarts.clear();
            storedGoals.clear();
            otherGoals = 0;
            fallbackTarget.reset();
            hasSolution = false;
            outcome = PlanOutcome::Timeout;
            reason.clear();
            solution.clear();
            bestCost = base::Cost(HUGE_VAL);
            objective.reset();
            isCompared = false;
            comparison = {};
        }

        /** \brief Frees the states that planner data was given. */
        void freeDataStates()
        {
            for (std::vector<base::State *> &group : dataStates)
            {
                for (base::State *state : group)
                    if (state != nullptr)
                        si->freeState(state);
                group.clear();
            }
        }

        /** The state that stands for a node in planner data: the same one each time, so that data handed out before
            stays valid until the query ends. */
        base::State *dataState(std::size_t group, std::size_t index, const Pose &pose)
        {
            std::vector<base::State *> &known = dataStates[group];
            if (known.size() <= index)
                known.resize(index + 1, nullptr);
            if (known[index] == nullptr)
                known[index] = si->allocState();
            parking::setPose(known[index], pose);
            return known[index];
        }
    };

    void ImprovedAStar::setParameters(const parking::PlannerParameters &parameters)
    {
        try
        {
            parking::checkParameters(parameters);
        }
        catch (const parking::Error &error)
        {
            throw Exception(getName(), error.what());
        }
        parameters_ = parameters;
    }

    void ImprovedAStar::declareParameters()
    {
        const auto declare = [this](const parking::Parameter &row, const auto member)
        {
            using Value = std::decay_t<decltype(parameters_.*member)>;
            const auto set = [this, member, isSet = row.name == "parameter_set"](Value value)
            {
                parking::PlannerParameters changed = parameters_;
                changed.*member = std::move(value);
                setParameters(changed);
                if (isSet)
                    parameters_ = parking::parameterSet(parameters_.parameterSet, parameters_);
            };
            params_.declareParam<Value>(row.name, set, [this, member] { return parameters_.*member; });
            params_[row.name].setRangeSuggestion(rangeSuggestion(row));
        };
        for (const parking::Parameter &row : parking::parameterTable())
            std::visit([&](const auto member) { declare(row, member); }, row.member);
    }

    ImprovedAStar::ImprovedAStar(const ob::SpaceInformationPtr &si)
      : ob::Planner(si, "ImprovedAStar"),
        query_(std::make_unique<Query>(si)),
        bestCost_(HUGE_VAL)
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
        try
        {
            query_->space.emplace(*si_->getStateSpace());
            requireFittingModel();
        }
        catch (...)
        {
            setup_ = false;  // asked again, it refuses again
            throw;
        }
        clearQuery();
    }

    void ImprovedAStar::requireFittingModel() const
    {
        if (query_->space->kind() != parking::SpaceKind::SE2 &&
            parking::search::turnsOnTheSpot(parameters_.motionModel))
            throw Exception(getName(), "motion_model " + parameters_.motionModel +
                                           " needs a plain SE2StateSpace: a Reeds-Shepp or Dubins space would turn its "
                                           "path into loops. Use motion_model car there");
    }

    void ImprovedAStar::setProblemDefinition(const ob::ProblemDefinitionPtr &pdef)
    {
        if (pdef != pdef_)
            clearQuery();
        Planner::setProblemDefinition(pdef);
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
        query_->forget();
        bestCost_ = HUGE_VAL;
        expanded_ = 0;
    }

    parking::PlannerParameters ImprovedAStar::searchParameters() const
    {
        const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective();
        if (!objective)
            return parameters_;
        const std::optional<parking::PlannerParameters> mapped = parking::parametersFor(objective, parameters_);
        if (!mapped && query_->unmapped != objective)
        {
            OMPL_DEBUG("%s: the search does not minimise the objective '%s', which is evaluated for each path found",
                       getName().c_str(), objective->getDescription().c_str());
            query_->unmapped = objective;
        }
        return mapped.value_or(parameters_);
    }

    void ImprovedAStar::prepareQuery()
    {
        if (query_->begun)
            return;
        requireFittingModel();
        query_->begun = true;
        query_->parameters = searchParameters();
        query_->goal = pdef_->getGoal();
        const parking::Box bounds = parking::spaceBounds(*si_->getStateSpace());
        const double radius = query_->turningRadius();
        query_->checker = si_->getStateValidityChecker();
        query_->validator = si_->getMotionValidator();
        const auto *circle = parking::exactly<parking::CircleValidityChecker>(query_->checker);
        const auto *footprint = parking::exactly<parking::FclFootprintChecker>(query_->checker);
        query_->stateEnvironment = std::make_unique<parking::StateSpaceEnvironment>(
            si_, std::min(parking::CHECK_STEP * radius, si_->getStateSpace()->getLongestValidSegmentLength()),
            query_->stateSpacing(), circle == nullptr);
        query_->stateEnvironment->setEnding(
            [this](std::vector<Pose> &poses)
            {
                // Parts of paths end elsewhere.
                if (parking::isAtGoal(poses.back(), query_->goals, query_->turningRadius()))
                    endAtGoal(poses);
            });
        query_->footprintEnvironment.reset();

        CarInSpace &car = query_->car;
        car = {};
        car.bounds = bounds;
        query_->turnsOnTheSpot = parking::search::turnsOnTheSpot(parameters_.motionModel);
        MotionEnvironment *environment = query_->stateEnvironment.get();
        if (footprint && !query_->turnsOnTheSpot)
        {
            const parking::FootprintChecker &checker = footprint->footprint();
            car = parking::search::carInSpace(checker.vehicle(), checker.margin(), bounds);
            // The motion validator has the last word unless it asks the same questions of the same checker.
            const auto *validator = parking::exactly<parking::SweptMotionValidator>(query_->validator);
            // So far from the origin OMPL's Dubins curve between two states of a path may be another one.
            const double farthest = std::max(bounds.min.cwiseAbs().maxCoeff(), bounds.max.cwiseAbs().maxCoeff());
            const bool mayDeviate =
                query_->space->kind() == parking::SpaceKind::Dubins && farthest > FARTHEST_DUBINS * radius;
            const bool swept = !query_->isPlain() && !mayDeviate && parameters_.steeringAngles == 3 &&
                               validator != nullptr && &validator->footprint() == &footprint->footprint() &&
                               validator->tolerance() <= parking::FootprintEnvironment::TOLERANCE;
            query_->footprintEnvironment = std::make_unique<parking::FootprintEnvironment>(
                footprint->footprint(), bounds, parking::FootprintEnvironment::TOLERANCE,
                swept ? nullptr : query_->stateEnvironment.get());
            environment = query_->footprintEnvironment.get();
        }
        // Those of the space, which may be wider than the vehicle's.
        car.turningRadius = radius;
        car.forwardOnly = query_->space->kind() == parking::SpaceKind::Dubins;
        try
        {
            query_->planner.begin(*environment, query_->parameters, car);
        }
        catch (const parking::Error &error)
        {
            query_->begun = false;
            throw Exception(getName(), error.what());
        }
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
        query_->storedStarts = storedStarts(*pdef_);
        query_->storedGoals = storedGoals(*region);
        query_->stateEnvironment->setStop([&ptc] { return ptc(); });
        if (!readStarts())
        {
            OMPL_ERROR("%s: There are no valid initial states", getName().c_str());
            failure = ob::PlannerStatus::INVALID_START;
            query_->outcome = PlanOutcome::InvalidStart;
            if (parameters_.escape)
                query_->reason = parking::search::invalidStart(parameters_);
            return false;
        }
        const GoalReading reading = readGoals(*region, ptc);
        if (reading == GoalReading::TimeUp)
        {
            failure = ob::PlannerStatus::TIMEOUT;
            return false;
        }
        if (reading == GoalReading::NoneValid)
        {
            query_->fallbackTarget = anyGoal(*pdef_->getGoal(), si_);
            query_->outcome = PlanOutcome::InvalidGoal;
            query_->reason = "no goal is valid";
            const bool hasTarget = query_->fallbackTarget && isFinite(*query_->fallbackTarget);
            if (!hasTarget || !parameters_.approximate)
            {
                OMPL_ERROR("%s: Unable to find a valid goal state", getName().c_str());
                failure = ob::PlannerStatus::INVALID_GOAL;
                return false;
            }
        }
        return true;
    }

    bool ImprovedAStar::readStarts()
    {
        while (const ob::State *state = pis_.nextStart())
        {
            query_->starts.push_back(parking::poseOf(state));
            query_->planner.addStart(query_->starts.back());
        }
        if (query_->starts.empty())
            for (const Pose &start : query_->storedStarts)
                if (query_->planner.addEscapes(start))
                    query_->starts.push_back(start);
        return !query_->starts.empty();
    }

    bool ImprovedAStar::addGoal(const Pose &pose)
    {
        if (!query_->knownGoals.insert({pose.x, pose.y, pose.yaw}).second)
            return false;
        query_->goals.push_back(pose);
        query_->planner.addGoal(pose);
        return true;
    }

    bool ImprovedAStar::mayHaveOtherGoals() const
    {
        return pis_.haveMoreGoalStates() || isSampling(*pdef_->getGoal());
    }

    /** Reads up to as many goals again as there are: to search on takes longer the more there are. */
    bool ImprovedAStar::readMoreGoals(const ob::PlannerTerminationCondition &ptc)
    {
        // Goals that are being sampled are worth waiting for. A region has endless others: their number is limited.
        const auto &goal = *pdef_->getGoal()->as<ob::GoalSampleableRegion>();
        const std::size_t known = query_->goals.size();
        while (!ptc && mayHaveOtherGoals() && query_->goals.size() < 2 * known &&
               (isList(goal) || query_->otherGoals++ < GOAL_ATTEMPTS))
        {
            const bool waits = isSampling(goal);
            const ob::State *state = waits ? pis_.nextGoal(ptc) : pis_.nextGoal();
            if (state != nullptr && addGoal(parking::poseOf(state)) && waits)
                break;
        }
        return query_->goals.size() > known;
    }

    ImprovedAStar::GoalReading ImprovedAStar::readGoals(const ob::GoalSampleableRegion &region,
                                                        const ob::PlannerTerminationCondition &ptc)
    {
        const bool listed = isList(region);
        const std::size_t maxGoals = isShort(region) ? MAX_LISTED_GOALS : MAX_SAMPLED_GOALS;
        unsigned int attempt = 0;
        // The first is looked at in any case.
        for (; (listed || attempt < GOAL_ATTEMPTS) && pis_.haveMoreGoalStates() && (attempt == 0 || !ptc); ++attempt)
        {
            if (query_->goals.size() >= maxGoals)
                break;
            if (const ob::State *state = pis_.nextGoal())
                addGoal(parking::poseOf(state));
            else if (!listed && !query_->goals.empty())
                break;
        }
        // Lazily sampled goals may be on their way. A list of goals that are all taken grows no longer: OMPL would wait
        // for it until the time is up. So would it for a region whose samples are all invalid: after so many attempts
        // the time is better spent on coming near to it.
        const bool mayHaveMore = isSampling(region) || (!listed && !region.canSample());
        if (query_->goals.empty() && region.couldSample() && mayHaveMore)
            if (const ob::State *state = pis_.nextGoal(ptc))
                addGoal(parking::poseOf(state));
        if (!query_->goals.empty())
            return GoalReading::Some;
        // That the time is up does not make those invalid that nobody has looked at.
        const bool hasSeenAll = (!listed && attempt == GOAL_ATTEMPTS) || !(pis_.haveMoreGoalStates() || mayHaveMore);
        return hasSeenAll || !ptc ? GoalReading::NoneValid : GoalReading::TimeUp;
    }

    bool ImprovedAStar::isSameQuery() const
    {
        return query_->goal == pdef_->getGoal() && query_->parameters == searchParameters() &&
               query_->checker == si_->getStateValidityChecker() && query_->validator == si_->getMotionValidator() &&
               extends(storedStarts(*pdef_), query_->storedStarts) &&
               extends(storedGoals(*pdef_->getGoal()), query_->storedGoals);
    }

    ob::PlannerStatus ImprovedAStar::solve(const ob::PlannerTerminationCondition &ptc)
    {
        checkValidity();
        if (query_->begun && !isSameQuery())
            clearQuery();
        query_->outcome = PlanOutcome::Timeout;
        query_->reason.clear();
        if (ptc && !query_->hasSolution)
            return ob::PlannerStatus::TIMEOUT;
        ob::PlannerStatus status;
        if (readInputs(ptc, status))
        {
            priceAnew();
            status = search(ptc);
        }
        if (query_->stateEnvironment)
            query_->stateEnvironment->setStop(nullptr);
        return status;
    }

    double ImprovedAStar::mapLoadingTime() const
    {
        return query_->planner.search().statistics().loadingTime;
    }

    SearchStatistics ImprovedAStar::statistics() const
    {
        SearchStatistics sum = query_->comparison;
        if (query_->begun)
            sum += query_->planner.statistics();
        return sum;
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
        return query_->footprintEnvironment ? query_->footprintEnvironment->counts().byContactTest : 0;
    }

    const Path *ImprovedAStar::solutionPath() const
    {
        return query_->hasSolution ? &query_->path : nullptr;
    }

    PlanOutcome ImprovedAStar::outcome() const
    {
        return query_->outcome;
    }

    std::optional<parking::Escape> ImprovedAStar::escape() const
    {
        return query_->begun ? query_->planner.escape() : std::nullopt;
    }

    std::string ImprovedAStar::notice() const
    {
        return query_->begun ? query_->planner.notice() : std::string();
    }

    const std::string &ImprovedAStar::reason() const
    {
        return query_->reason;
    }

    double ImprovedAStar::suboptimalityBound()
    {
        return query_->hasSolution ? query_->planner.suboptimalityBound(query_->plannedCost) : HUGE_VAL;
    }

    Path ImprovedAStar::smoothed(const Path &path, const ob::PlannerTerminationCondition &ptc) const
    {
        Path result = path;
        if (query_->turnsOnTheSpot && parameters_.smoothing == "bspline")
            parking::search::smoothGridPath(result, *query_->stateEnvironment, query_->car.turningRadius,
                                            [&ptc] { return ptc(); });
        return result;
    }

    std::shared_ptr<PathGeometric> ImprovedAStar::geometricPath(const std::vector<Pose> &poses) const
    {
        auto path = std::make_shared<PathGeometric>(si_);
        ob::ScopedState<> state(si_);
        for (const Pose &pose : poses)
        {
            parking::setPose(state.get(), pose);
            path->append(state.get());
        }
        return path;
    }

    ob::Cost ImprovedAStar::costOf(const Path &path, const PathGeometric &geometric, double proximity) const
    {
        if (const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective())
            return parking::pathCost(geometric, objective);
        // Without an objective of the problem's, room to the obstacles counts as the parameters say. No objective is
        // stored in the problem definition, where it would change what other planners do with it. On a curve space OMPL
        // would look for each piece's shortest curve to find out what is known here.
        const double length = query_->isPlain() ? geometric.length() : path.length();
        return ob::Cost(length + proximity);
    }

    void ImprovedAStar::priceAnew()
    {
        if (!query_->hasSolution || query_->objective == pdef_->getOptimizationObjective())
            return;
        query_->objective = pdef_->getOptimizationObjective();
        query_->bestCost = costOf(query_->path, *geometricPath(query_->states), query_->proximity);
        bestCost_.store(query_->bestCost.value(), std::memory_order_relaxed);
    }

    bool ImprovedAStar::takeImprovement(const Path &found, double plannedCost,
                                        const ob::PlannerTerminationCondition &ptc)
    {
        const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective();
        const Path path = smoothed(found, ptc);
        const std::vector<Pose> states = parking::pathStates(path, query_->stateSpacing());
        const std::shared_ptr<PathGeometric> geometric = geometricPath(states);
        const double proximity = query_->planner.proximityOfBest();
        const ob::Cost cost = costOf(path, *geometric, proximity);
        if (query_->hasSolution && !(objective ? objective->isCostBetterThan(cost, query_->bestCost)
                                               : cost.value() < query_->bestCost.value()))
            return false;
        query_->hasSolution = true;
        query_->path = path;
        query_->plannedCost = plannedCost;
        query_->proximity = proximity;
        query_->states = states;
        query_->bestCost = cost;
        query_->objective = objective;
        bestCost_.store(cost.value(), std::memory_order_relaxed);
        if (const ob::ReportIntermediateSolutionFn &report = pdef_->getIntermediateSolutionCallback())
        {
            // Goal first, without the ends, as OMPL's planners do.
            std::vector<const ob::State *> reported;
            for (std::size_t i = geometric->getStateCount(); i-- > 0;)
                reported.push_back(geometric->getState(i));
            report(this, reported, cost);
        }
        return objective && objective->isSatisfied(cost);
    }

    /** The path by the weights of an objective must not cost more than that by the planner's own, and may do so in
        another local optimum. */
    void ImprovedAStar::offerPathOfOwnWeights(const parking::search::StopFunction &stop,
                                              const parking::search::ImprovementFunction &improved)
    {
        const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective();
        if (query_->parameters == parameters_ || query_->isCompared || objective->isSatisfied(query_->bestCost))
            return;
        query_->isCompared = true;
        PathPlanner own;
        MotionEnvironment *environment = query_->footprintEnvironment.get();
        own.begin(environment != nullptr ? *environment : *query_->stateEnvironment, parameters_, query_->car);
        for (const Pose &start : query_->starts)
            own.addStart(start);
        for (const Pose &goal : query_->goals)
            own.addGoal(goal);
        own.solve(stop, {});
        query_->comparison = own.statistics();
        if (own.hasSolution())
            query_->planner.offer(own.bestPath(), stop, improved);
    }

    ob::PlannerStatus ImprovedAStar::search(const ob::PlannerTerminationCondition &ptc)
    {
        const auto stop = [this, &ptc]
        {
            expanded_.store(query_->planner.expanded(), std::memory_order_relaxed);
            return ptc();
        };
        const auto improved = [this, &ptc](const Path &path, double cost)
        {
            return takeImprovement(path, cost, ptc);
        };
        using Outcome = PathPlanner::Outcome;
        Outcome outcome = query_->goals.empty() ? Outcome::Stopped : query_->planner.solve(stop, improved);
        // That one goal cannot be reached says nothing of those that nobody has asked for yet.
        while (outcome == Outcome::Exhausted && readMoreGoals(ptc))
            outcome = query_->planner.solve(stop, improved);
        if (outcome == Outcome::Solved && !parameters_.anytime)
            offerPathOfOwnWeights(stop, improved);
        if (outcome == Outcome::Exhausted && mayHaveOtherGoals())
            query_->reason = "none of the " + std::to_string(query_->goals.size()) +
                             " goals that were sampled can be reached; others may be";
        else if (outcome == Outcome::Exhausted)
        {
            query_->outcome = PlanOutcome::Infeasible;
            query_->reason = parking::search::reasonOf(query_->planner.search().exhaustion(), query_->car);
        }
        else if (query_->planner.search().isFull())
            query_->reason = parking::search::outOfMemory(parameters_);
        expanded_ = query_->planner.expanded();
        if (query_->hasSolution)
        {
            const bool escapes = query_->planner.escape().has_value();
            query_->outcome = escapes ? PlanOutcome::Escaped : PlanOutcome::Solved;
            query_->reason.clear();
            std::vector<Pose> states = query_->states;
            if (escapes)
                endAtGoal(states);
            return report(std::move(states), escapes);
        }
        if (parameters_.approximate)
            if (const ob::PlannerStatus status = approach(ptc, stop))
                return status;
        return query_->outcome == PlanOutcome::Infeasible
                   ? parking::ompl_compatibility::infeasible<ob::PlannerStatus>(0)
                   : ob::PlannerStatus(ob::PlannerStatus::TIMEOUT);
    }

    ob::PlannerStatus ImprovedAStar::approach(const ob::PlannerTerminationCondition &ptc,
                                              const parking::search::StopFunction &stop)
    {
        Path nearest;
        const Pose target = query_->goals.empty() ? *query_->fallbackTarget : query_->goals.front();
        const bool hasPath = query_->planner.approximate(target, stop, nearest);
        expanded_ = query_->planner.expanded();
        if (!hasPath)
            return ob::PlannerStatus::TIMEOUT;
        std::vector<Pose> states = parking::pathStates(smoothed(nearest, ptc), query_->stateSpacing());
        // Up to where the motion validator agrees, from the end of an escape. With a checker that takes long there is
        // no time for that once the planner has been told to stop.
        std::size_t first = 0;
        while (query_->planner.escape() && first + 1 < states.size() &&
               !query_->stateEnvironment->isFree(states[first]))
            ++first;
        if (!query_->turnsOnTheSpot && (query_->footprintEnvironment || !ptc))
            for (std::size_t i = first + 1; i < states.size(); ++i)
                if (!query_->stateEnvironment->isMotionFree(states[i - 1], states[i]))
                    states.resize(i);
        if (query_->outcome == PlanOutcome::Timeout)
            query_->outcome = PlanOutcome::Approximate;
        return report(states, true);
    }

    double ImprovedAStar::differenceFromGoal(const ob::State *state) const
    {
        double difference = HUGE_VAL;
        const ob::Goal &goal = *pdef_->getGoal();
        if (!goal.hasType(ob::GOAL_STATE) && !goal.hasType(ob::GOAL_STATES))
        {
            goal.isSatisfied(state, &difference);
            return difference;
        }
        // Asked itself, the goal would measure the distance to all of its states, at which OMPL ends the program where
        // one is out of bounds. A yaw of just pi is. Thousands of curves would take longer than is left.
        std::vector<Pose> targets = query_->goals.empty() ? std::vector<Pose>{*query_->fallbackTarget} : query_->goals;
        targets.resize(std::min<std::size_t>(targets.size(), MAX_LISTED_GOALS));
        ob::ScopedState<> target(si_);
        for (const Pose &pose : targets)
        {
            parking::setPose(target.get(), pose);
            si_->enforceBounds(target.get());
            difference = std::min(difference, si_->distance(state, target.get()));
        }
        return difference;
    }

    void ImprovedAStar::endAtGoal(std::vector<Pose> &poses) const
    {
        parking::endAtGoal(poses, query_->goals, query_->stateSpacing(), query_->turnsOnTheSpot);
    }

    /** Whether OMPL would drive a loop, or through obstacles, from a start to a goal within the tolerance. */
    bool ImprovedAStar::swerves(const Pose &start, const Pose &goal) const
    {
        ob::ScopedState<> from(si_), to(si_);
        parking::setPose(from.get(), start);
        parking::setPose(to.get(), goal);
        return si_->distance(from.get(), to.get()) > std::max(STAYS, 2.0 * query_->parameters.goalTolerance) ||
               !query_->stateEnvironment->isMotionFree(start, goal);
    }

    ob::PlannerStatus ImprovedAStar::report(std::vector<Pose> poses, bool approximate)
    {
        if (!approximate)
            endAtGoal(poses);
        if (!approximate && query_->path.pieces.empty() && swerves(poses[0], poses[1]))
            poses.resize(1);
        const std::shared_ptr<PathGeometric> path = geometricPath(poses);
        query_->solution.clear();
        if (!approximate)
            query_->solution = std::move(poses);
        double difference = 0.0;
        if (approximate)
            difference = differenceFromGoal(path->getState(path->getStateCount() - 1));
        // OMPL would look for each piece's shortest curve to find out the length, which is known here.
        ob::PlannerSolution solution(nullptr);
        solution.path_ = path;
        solution.length_ = approximate || query_->isPlain() ? path->length() : query_->path.length();
        solution.setPlannerName(getName());
        if (approximate)
            solution.setApproximate(difference);
        if (const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective())
        {
            // Of a solution it is known already, and takes its time on a curve space.
            const bool known = !approximate && query_->objective == objective;
            const ob::Cost cost = known ? query_->bestCost : parking::pathCost(*path, objective);
            solution.setOptimized(objective, cost, !approximate && objective->isSatisfied(cost));
        }
        pdef_->addSolutionPath(solution);
        OMPL_DEBUG("%s: %s path of %zu states after %llu expansions", getName().c_str(),
                   approximate ? "approximate" : "exact", path->getStateCount(),
                   static_cast<unsigned long long>(expanded_.load()));
        return approximate ? ob::PlannerStatus::APPROXIMATE_SOLUTION : ob::PlannerStatus::EXACT_SOLUTION;
    }

    void ImprovedAStar::getPlannerData(ob::PlannerData &data) const
    {
        Planner::getPlannerData(data);
        if (!query_->begun)
            return;
        // Nodes may be cheaper ones in the place of others, so that a parent may come after its child.
        struct Node
        {
            ob::State *state;
            std::uint32_t parent;
        };
        std::vector<Node> frontiers[2];
        for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
        {
            const parking::search::Search &search = std::as_const(query_->planner).search();
            const auto &nodes =
                search.frontier(side == 0 ? parking::search::Side::Start : parking::search::Side::Goal).nodes();
            for (std::size_t i = 0; i < nodes.size(); ++i)
                frontiers[side].push_back({query_->dataState(side, i, nodes[i].pose), nodes[i].parent});
        }

        ob::State *ends[2] = {nullptr, nullptr};
        for (int side = 0; side < 2; ++side)
            for (const Node &node : frontiers[side])
            {
                if (node.state == nullptr)
                    continue;
                const ob::PlannerDataVertex vertex(node.state, side + 1);
                if (node.parent == parking::search::NO_NODE)
                {
                    side == 0 ? data.addStartVertex(vertex) : data.addGoalVertex(vertex);
                    const std::vector<Pose> &solution = query_->solution;
                    if (!solution.empty() && parking::isSamePose(side == 0 ? solution.front() : solution.back(),
                                                                 parking::poseOf(node.state), SAME_POSE))
                        ends[side] = node.state;
                    continue;
                }
                const ob::PlannerDataVertex parent(frontiers[side][node.parent].state, side + 1);
                side == 0 ? data.addEdge(parent, vertex) : data.addEdge(vertex, parent);
            }
        // The solution itself, whose curves are in neither frontier.
        if (ends[0] == nullptr || ends[1] == nullptr)
            return;
        for (std::size_t i = 1; i < query_->solution.size(); ++i)
        {
            const bool last = i + 1 == query_->solution.size();
            ob::State *next = last ? ends[1] : query_->dataState(2, i, query_->solution[i]);
            data.addEdge(ob::PlannerDataVertex(ends[0]), ob::PlannerDataVertex(next));
            ends[0] = next;
        }
    }
}  // namespace ompl::geometric
