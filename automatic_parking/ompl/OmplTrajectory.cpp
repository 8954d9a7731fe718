#include "automatic_parking/ompl/OmplTrajectory.h"

#include "parking_geometry/Error.h"
#include "state_validity/ompl/CurveSpace.h"
#include "state_validity/ompl/OmplPose.h"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/control/StatePropagator.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>

#include <cmath>
#include <string>
#include <vector>

namespace ob = ompl::base;
namespace oc = ompl::control;

namespace parking
{
    namespace
    {
        constexpr double SHORTEST_PIECE = 1e-7;    // metres; anything shorter is rounding of a curve's formula
        constexpr double PROPAGATION_STEP = 0.05;  // seconds, of planners that use the space

        constexpr unsigned int MAX_STEPS = 20;  // for which a control is held

        using Pair = ob::RealVectorStateSpace::StateType;
        using Controls = oc::RealVectorControlSpace::ControlType;

        void write(ob::State *state, const Pose &pose, double speed, double steering)
        {
            setPose(state->as<ob::CompoundState>()->as<ob::State>(0), pose);
            auto *pair = state->as<ob::CompoundState>()->as<Pair>(1);
            pair->values[0] = speed;
            pair->values[1] = steering;
        }

        class BicyclePropagator final : public oc::StatePropagator
        {
        public:
            BicyclePropagator(const oc::SpaceInformationPtr &si, const Vehicle &vehicle)
              : oc::StatePropagator(si),
                vehicle_(vehicle)
            {
            }

            void propagate(const ob::State *state, const oc::Control *control, double duration,
                           ob::State *result) const override
            {
                const auto *from = state->as<ob::CompoundState>();
                const auto *pose = from->as<ob::SE2StateSpace::StateType>(0);
                const auto *pair = from->as<Pair>(1);
                const auto *rates = control->as<Controls>();
                const double v = pair->values[0], steering = pair->values[1];
                TimedMotion motion{{pose->getX(), pose->getY(), pose->getYaw()}, {}};
                motion.append(0.0, v, steering);
                motion.append(duration, v + duration * rates->values[0], steering + duration * rates->values[1]);
                write(result, endOf(motion, vehicle_), motion.knots.back().v, motion.knots.back().steering);
            }

        private:
            Vehicle vehicle_;
        };

        ob::RealVectorBounds symmetric(double first, double second)
        {
            ob::RealVectorBounds bounds(2);
            bounds.setLow(0, -first);
            bounds.setHigh(0, first);
            bounds.setLow(1, -second);
            bounds.setHigh(1, second);
            return bounds;
        }
    }  // namespace

    Path pathOf(const ompl::geometric::PathGeometric &path)
    {
        if (path.getStateCount() < 2)
            throw Error("an OMPL path of " + std::to_string(path.getStateCount()) +
                        " states has no length; at least 2 are required");
        const CurveSpace space(*path.getSpaceInformation()->getStateSpace());
        if (space.kind() == SpaceKind::SE2)
            throw Error(
                "an OMPL path in a plain SE2 space has straight lines between its poses, which no car can drive");
        Path arcs;
        arcs.start = poseOf(path.getState(0));
        ReedsSheppCurve curve;
        for (unsigned int i = 1; i < path.getStateCount(); ++i)
        {
            space.curve(path.getState(i - 1), path.getState(i), curve);
            if (!std::isfinite(curve.length))
                throw Error("state " + std::to_string(i + 1) + " of the OMPL path is not finite");
            for (std::size_t k = 0; k < curve.count; ++k)
                if (std::abs(curve.pieces[k].length) >= SHORTEST_PIECE)
                    arcs.append(curve.pieces[k]);
        }
        return arcs;
    }

    oc::SpaceInformationPtr carInformation(const Vehicle &vehicle, const Box &bounds)
    {
        vehicle.validate();
        auto poses = std::make_shared<ob::SE2StateSpace>();
        poses->setBounds(positionBounds(bounds));
        auto pair = std::make_shared<ob::RealVectorStateSpace>(2);
        pair->setBounds(symmetric(vehicle.maxSpeed, vehicle.maxSteeringAngle));
        auto states = std::make_shared<ob::CompoundStateSpace>();
        states->addSubspace(poses, 1.0);
        states->addSubspace(pair, 0.5);
        auto controls = std::make_shared<oc::RealVectorControlSpace>(states, 2);
        controls->setBounds(symmetric(vehicle.maxAcceleration, vehicle.maxSteeringRate));
        auto si = std::make_shared<oc::SpaceInformation>(states, controls);
        si->setStatePropagator(std::make_shared<BicyclePropagator>(si, vehicle));
        si->setStateValidityChecker([](const ob::State *) { return true; });
        si->setPropagationStepSize(PROPAGATION_STEP);
        si->setMinMaxControlDuration(1, MAX_STEPS);
        si->setup();
        return si;
    }

    std::shared_ptr<oc::PathControl> controlPath(const TimedMotion &motion, const Vehicle &vehicle,
                                                 const oc::SpaceInformationPtr &si)
    {
        if (motion.knots.size() < 2)
            throw Error("a motion of " + std::to_string(motion.knots.size()) +
                        " knots has no duration; at least 2 are required");
        auto path = std::make_shared<oc::PathControl>(si);
        ob::State *state = si->allocState();
        oc::Control *control = si->allocControl();
        Pose pose = motion.start;
        write(state, pose, motion.knots.front().v, motion.knots.front().steering);
        path->append(state);
        for (std::size_t i = 1; i < motion.knots.size(); ++i)
        {
            const MotionKnot &a = motion.knots[i - 1], &b = motion.knots[i];
            const double h = b.t - a.t;
            pose = endOf({pose, {a, b}}, vehicle);
            control->as<Controls>()->values[0] = (b.v - a.v) / h;
            control->as<Controls>()->values[1] = (b.steering - a.steering) / h;
            write(state, pose, b.v, b.steering);
            path->append(state, control, h);
        }
        si->freeState(state);
        si->freeControl(control);
        return path;
    }
}  // namespace parking
