#include "ompl_improved_astar/ImprovedAStar.h"

#include "ompl_improved_astar/ImprovedAStarQuery.h"
#include "parking_geometry/Error.h"
#include "state_validity/ompl/CircleValidityChecker.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/SweptMotionValidator.h"

#include <ompl/base/goals/GoalLazySamples.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/util/Console.h>
#include <ompl/util/Exception.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <typeinfo>

namespace ob = ompl::base;

namespace ompl::geometric
{
    namespace
    {
        using parking::Pose;

        constexpr double INFINITE = std::numeric_limits<double>::infinity();

        // Between states asked for along a motion with a checker that knows states only, in turning radii.
        constexpr double CHECK_STEP = 0.02;
        constexpr double SWEEP_TOLERANCE = 1e-3;  // metres kept from obstacles
        constexpr double FARTHEST_DUBINS = 1e7;   // coordinates in turning radii

        constexpr unsigned int MAX_GOALS = 16;        // of a region that offers ever more of them
        constexpr unsigned int GOAL_ATTEMPTS = 1000;  // to find a first valid one, or one that can be reached

        /** The object if it is of just this class: one that is derived from it may say something else. */
        template <class Class, class Base>
        const Class *exactly(const std::shared_ptr<Base> &object)
        {
            const Base *known = object.get();
            return known != nullptr && typeid(*known) == typeid(Class) ? static_cast<const Class *>(known) : nullptr;
        }

        /** Are there only so many goals, now at least? */
        bool isFinite(const ob::GoalSampleableRegion &region)
        {
            return region.maxSampleCount() < std::numeric_limits<unsigned int>::max();
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
    }  // namespace

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
        bestCost_ = INFINITE;
        expanded_ = 0;
    }

    void ImprovedAStar::prepareQuery()
    {
        if (query_->begun)
            return;
        requireFittingModel();
        query_->begun = true;
        query_->parameters = parameters_;
        query_->goal = pdef_->getGoal();
        const parking::Box bounds = parking::spaceBounds(*si_->getStateSpace());
        const double radius = query_->turningRadius();
        query_->checker = si_->getStateValidityChecker();
        query_->validator = si_->getMotionValidator();
        const auto *circle = exactly<parking::CircleValidityChecker>(query_->checker);
        const auto *footprint = exactly<parking::FclFootprintChecker>(query_->checker);
        query_->stateEnvironment = std::make_unique<parking::StateSpaceEnvironment>(
            si_, std::min(CHECK_STEP * radius, si_->getStateSpace()->getLongestValidSegmentLength()),
            query_->stateSpacing(), circle == nullptr);
        query_->stateEnvironment->setEnding(
            [this](std::vector<Pose> &poses)
            {
                // Parts of paths are asked for, too, which end elsewhere.
                if (isAtGoal(poses.back()))
                    endAtGoal(poses);
            });
        query_->footprintEnvironment.reset();

        parking::search::CarInSpace &car = query_->car;
        car = {};
        car.bounds = bounds;
        query_->turnsOnTheSpot = parking::search::turnsOnTheSpot(parameters_.motionModel);
        parking::search::MotionEnvironment *environment = query_->stateEnvironment.get();
        if (footprint && !query_->turnsOnTheSpot)
        {
            const parking::FootprintChecker &checker = footprint->footprint();
            car = parking::search::carInSpace(checker.vehicle(), checker.margin(), bounds);
            // The motion validator has the last word unless it asks the same questions of the same checker.
            const auto *validator = exactly<parking::SweptMotionValidator>(query_->validator);
            // So far from the origin OMPL's Dubins curve between two states of a path may be another one.
            const double farthest = std::max(bounds.min.cwiseAbs().maxCoeff(), bounds.max.cwiseAbs().maxCoeff());
            const bool mayDeviate =
                query_->space->kind() == parking::SpaceKind::Dubins && farthest > FARTHEST_DUBINS * radius;
            const bool swept = !query_->isPlain() && !mayDeviate && parameters_.steeringAngles == 3 &&
                               validator != nullptr && &validator->footprint() == &footprint->footprint() &&
                               validator->tolerance() <= SWEEP_TOLERANCE;
            query_->footprintEnvironment = std::make_unique<parking::FootprintEnvironment>(
                footprint->footprint(), bounds, SWEEP_TOLERANCE, swept ? nullptr : query_->stateEnvironment.get());
            environment = query_->footprintEnvironment.get();
        }
        // Those of the space, which may be wider than the vehicle's.
        car.turningRadius = radius;
        car.forwardOnly = query_->space->kind() == parking::SpaceKind::Dubins;
        try
        {
            query_->planner.begin(*environment, parameters_, car);
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
        query_->stateEnvironment->setStop([&ptc] { return ptc(); });
        if (!readStarts())
        {
            OMPL_ERROR("%s: There are no valid initial states", getName().c_str());
            failure = ob::PlannerStatus::INVALID_START;
            query_->outcome = parking::search::PlanOutcome::InvalidStart;
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
            query_->outcome = parking::search::PlanOutcome::InvalidGoal;
            query_->reason = "no goal is valid";
            if (!query_->fallbackTarget || !parameters_.approximate)
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
        return !query_->starts.empty();
    }

    bool ImprovedAStar::addGoal(const Pose &pose)
    {
        for (const Pose &known : query_->goals)
            if (known.x == pose.x && known.y == pose.y && known.yaw == pose.yaw)
                return false;
        query_->goals.push_back(pose);
        query_->planner.addGoal(pose);
        return true;
    }

    bool ImprovedAStar::mayHaveOtherGoals() const
    {
        return pis_.haveMoreGoalStates() || isSampling(*pdef_->getGoal());
    }

    bool ImprovedAStar::readAnotherGoal(const ob::PlannerTerminationCondition &ptc)
    {
        // Those that are on their way are worth waiting for. A region always has others: so many must do.
        const auto &goal = *pdef_->getGoal()->as<ob::GoalSampleableRegion>();
        while (!ptc && mayHaveOtherGoals() && (isFinite(goal) || query_->otherGoals++ < GOAL_ATTEMPTS))
        {
            const ob::State *state = isSampling(goal) ? pis_.nextGoal(ptc) : pis_.nextGoal();
            if (state != nullptr && addGoal(parking::poseOf(state)))
                return true;
        }
        return false;
    }

    ImprovedAStar::GoalReading ImprovedAStar::readGoals(const ob::GoalSampleableRegion &region,
                                                        const ob::PlannerTerminationCondition &ptc)
    {
        const bool finite = isFinite(region);
        unsigned int attempt = 0;
        // The first is looked at in any case.
        for (; (finite || attempt < GOAL_ATTEMPTS) && pis_.haveMoreGoalStates() && (attempt == 0 || !ptc); ++attempt)
        {
            if (!finite && query_->goals.size() >= MAX_GOALS)
                break;
            if (const ob::State *state = pis_.nextGoal())
                addGoal(parking::poseOf(state));
            else if (!finite && !query_->goals.empty())
                break;
        }
        // Lazily sampled goals may be on their way. A list of goals that are all taken grows no longer: OMPL would wait
        // for it until the time is up. So would it for a region whose samples are all invalid: after so many attempts
        // the time is better spent on coming near to it.
        const bool mayHaveMore = isSampling(region) || (!finite && !region.canSample());
        if (query_->goals.empty() && region.couldSample() && mayHaveMore)
            if (const ob::State *state = pis_.nextGoal(ptc))
                addGoal(parking::poseOf(state));
        if (!query_->goals.empty())
            return GoalReading::Some;
        // That the time is up does not make those invalid that nobody has looked at.
        const bool hasSeenAll = (!finite && attempt == GOAL_ATTEMPTS) || !(pis_.haveMoreGoalStates() || mayHaveMore);
        return hasSeenAll || !ptc ? GoalReading::NoneValid : GoalReading::TimeUp;
    }

    bool ImprovedAStar::isSameQuery() const
    {
        return query_->goal == pdef_->getGoal() && query_->parameters == parameters_ &&
               query_->checker == si_->getStateValidityChecker() && query_->validator == si_->getMotionValidator();
    }

    ob::PlannerStatus ImprovedAStar::solve(const ob::PlannerTerminationCondition &ptc)
    {
        checkValidity();
        if (query_->begun && !isSameQuery())
            clearQuery();
        query_->outcome = parking::search::PlanOutcome::Timeout;
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
        return query_->planner.search().loadingTime();
    }

    parking::search::SearchStatistics ImprovedAStar::statistics() const
    {
        return query_->begun ? query_->planner.statistics() : parking::search::SearchStatistics();
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

    const parking::Path *ImprovedAStar::solutionPath() const
    {
        return query_->hasSolution ? &query_->path : nullptr;
    }

    parking::search::PlanOutcome ImprovedAStar::outcome() const
    {
        return query_->outcome;
    }

    const std::string &ImprovedAStar::reason() const
    {
        return query_->reason;
    }

    double ImprovedAStar::suboptimalityBound()
    {
        return query_->hasSolution ? query_->planner.suboptimalityBound(query_->plannedCost)
                                   : std::numeric_limits<double>::infinity();
    }
}  // namespace ompl::geometric
