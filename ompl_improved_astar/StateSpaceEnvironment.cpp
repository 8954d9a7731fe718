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
        // A single arc is the shortest curve between its ends as long as it turns by much less than half a circle.
        constexpr double RADIANS_PER_STATE = 0.8;
        // Of the lines that straightened() mends.
        constexpr double SHORT = 0.25;     // turning radii that they are shorter than
        constexpr double STRAIGHT = 1e-9;  // metres and radians by which they may deviate
        constexpr double FRACTIONS[] = {0.5, 0.37, 0.63, 0.29, 0.71, 0.43, 0.57, 0.23, 0.77, 0.17, 0.83, 0.11, 0.89};

        bool isShortLine(const Pose &from, const Pose &to, double turningRadius)
        {
            if (positionDistance(from, to) >= SHORT * turningRadius)
                return false;
            const Pose seen = relativeTo(from, to);
            return std::abs(seen.y) <= STRAIGHT && std::abs(seen.yaw) <= STRAIGHT;
        }

        bool swerves(const Pose &from, const Pose &to, const CurveSpace &curves)
        {
            ReedsSheppCurve curve;
            curves.curve(from, to, curve);
            return curve.length > positionDistance(from, to) + STRAIGHT;
        }
    }  // namespace

    Box spaceBounds(const ob::StateSpace &space)
    {
        const ob::RealVectorBounds &bounds = space.as<ob::SE2StateSpace>()->getBounds();
        return {{bounds.low[0], bounds.low[1]}, {bounds.high[0], bounds.high[1]}};
    }

    std::vector<Pose> pathStates(const Path &path, const StateSpacing &spacing)
    {
        std::vector<Pose> poses{path.start};
        Pose pose = path.start;
        for (const PathPiece &piece : path.pieces)
        {
            const double sharpest = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
            double states = std::ceil(piece.driven() * sharpest / RADIANS_PER_STATE);
            const bool gentle =
                sharpest > 0.0 && (sharpest < (1.0 - 1e-9) * spacing.sharpestCurvature || piece.sharpness != 0.0);
            const double dense = gentle ? spacing.onGentleArcs : sharpest > 0.0 ? spacing.onArcs : 0.0;
            if (dense > 0.0)
                states = std::max(states, std::ceil(piece.driven() / dense));
            states = std::max(states, 1.0);
            states = std::max(states, std::ceil(std::abs(piece.turn) / PathPiece::MAX_TURN));
            for (double i = 1.0; i <= states; i += 1.0)
            {
                Pose next = piece.turn != 0.0 ? Pose{pose.x, pose.y, pose.yaw + piece.turn * i / states}
                                              : advance(pose, piece, piece.driven() * i / states);
                next.yaw = wrapAngle(next.yaw);
                poses.push_back(next);
            }
            pose = advance(pose, piece);
        }
        if (spacing.curves == nullptr)
            return poses;
        return straightened(std::move(poses), *spacing.curves);
    }

    std::vector<Pose> straightened(std::vector<Pose> poses, const CurveSpace &curves)
    {
        if (curves.kind() != SpaceKind::ReedsShepp)
            return poses;
        for (std::size_t i = 1; i < poses.size(); ++i)
        {
            const Pose from = poses[i - 1], to = poses[i];
            if (!isShortLine(from, to, curves.turningRadius()) || !swerves(from, to, curves))
                continue;
            for (const double fraction : FRACTIONS)
            {
                const Pose between{from.x + fraction * (to.x - from.x), from.y + fraction * (to.y - from.y), from.yaw};
                if (swerves(from, between, curves) || swerves(between, to, curves))
                    continue;
                poses.insert(poses.begin() + static_cast<std::ptrdiff_t>(i++), between);
                break;
            }
        }
        return poses;
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
