#include "ompl_improved_astar/StateSpaceEnvironment.h"

#include "state_validity/ompl/OmplPose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        constexpr std::uint64_t QUESTIONS_BETWEEN_STOPS = 8;
    }  // namespace

    Box spaceBounds(const ob::StateSpace &space)
    {
        const ob::RealVectorBounds &bounds = space.as<ob::SE2StateSpace>()->getBounds();
        return {{bounds.low[0], bounds.low[1]}, {bounds.high[0], bounds.high[1]}};
    }

    StateSpaceEnvironment::StateSpaceEnvironment(const ob::SpaceInformationPtr &si, double step,
                                                 const StateSpacing &stateSpacing, bool headingMatters)
      : si_(si),
        step_(step),
        stateSpacing_(stateSpacing),
        headingMatters_(headingMatters),
        clearanceKnown_(si->getStateValidityChecker()->getSpecs().clearanceComputationType !=
                        ob::StateValidityCheckerSpecs::NONE),
        bounds_(spaceBounds(*si->getStateSpace())),
        state_(si->getStateSpace()),
        other_(si->getStateSpace())
    {
    }

    bool StateSpaceEnvironment::isTimeUp()
    {
        interrupted_ = interrupted_ || (stop_ && stop_());
        return interrupted_;
    }

    /** Is it time to stop before another question that takes no longer than the validity of a state? */
    bool StateSpaceEnvironment::isTimeUpNowAndThen()
    {
        return questions_++ % QUESTIONS_BETWEEN_STOPS == 0 ? isTimeUp() : interrupted_;
    }

    bool StateSpaceEnvironment::isFree(const Pose &pose)
    {
        if (isTimeUpNowAndThen())
            return false;
        ++checkedStates_;
        setPose(state_.get(), pose);
        return si_->satisfiesBounds(state_.get()) && si_->isValid(state_.get());
    }

    bool StateSpaceEnvironment::keeps(const Pose &pose, double clearance)
    {
        if (!clearanceKnown_ || isTimeUpNowAndThen())
            return false;
        setPose(state_.get(), pose);
        return si_->getStateValidityChecker()->clearance(state_.get()) >= clearance;
    }

    void StateSpaceEnvironment::freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                                            double *lengths)
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            const double whole = std::abs(arcs[i].length), parts = std::max(1.0, std::ceil(whole / step_));
            double free = 0.0;
            while (free < parts && clearance <= 0.0 &&
                   isFree(advance(from, arcs[i].curvature, arcs[i].length * (free + 1.0) / parts)))
                free += 1.0;
            lengths[i] = free < parts ? whole * free / parts : whole;
        }
    }

    double StateSpaceEnvironment::roomAt(double /*x*/, double /*y*/)
    {
        return std::numeric_limits<double>::infinity();
    }

    bool StateSpaceEnvironment::isMotionFree(const Pose &from, const Pose &to)
    {
        setPose(state_.get(), from);
        setPose(other_.get(), to);
        return si_->checkMotion(state_.get(), other_.get());
    }

    bool StateSpaceEnvironment::acceptPath(const Path &path)
    {
        std::vector<Pose> poses = pathStates(path, stateSpacing_);
        if (ending_)
            ending_(poses);
        for (std::size_t i = 1; i < poses.size(); ++i)
            if (isTimeUp() || !isMotionFree(poses[i - 1], poses[i]))
                return false;
        return true;
    }
}  // namespace parking
