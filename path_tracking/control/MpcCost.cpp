#include "path_tracking/control/MpcCost.h"

#include "path_tracking/simulation/BicycleModel.h"

#include <algorithm>
#include <cmath>

#include <ceres/jet.h>

namespace parking
{
    namespace
    {
        /** Rows of the sensitivity matrix. */
        enum StateRow
        {
            X,
            Y,
            YAW,
            SPEED,
            WHEELS,
            STATES
        };

        /** Sensitivity of a lagging value after a step to the unknowns, from the previous one. \param column of the
            command of this step; the previous command is two columns to the left */
        template <typename Row>
        void follow(const LagStep &lag, const Row &before, Eigen::Index column, Eigen::RowVectorXd &after)
        {
            after.head(before.size()) = lag.ofValue * before;
            after[column] += lag.ofCommand;
            if (column >= 2)
                after[column - 2] += lag.ofBefore;
        }

        /** Keeps a quadratic form definite when its weights are zero; far below any sensible weight. */
        constexpr double MIN_WEIGHT = 1e-9;
    }  // namespace

    MpcCost::MpcCost(const Vehicle &vehicle, const MpcParameters &parameters)
      : vehicle_(vehicle),
        parameters_(parameters),
        steps_(static_cast<Eigen::Index>(parameters.horizon)),
        alongRoot_(std::sqrt(parameters.alongWeight)),
        acrossRoot_(std::sqrt(parameters.acrossWeight)),
        acceleration_(makeForm(parameters.accelerationWeight, parameters.accelerationChangeWeight)),
        steering_(makeForm(parameters.steeringWeight, parameters.steeringChangeWeight)),
        sensitivity_(STATES, 2 * steps_),
        speedSensitivity_(2 * steps_),
        wheelsSensitivity_(2 * steps_)
    {
    }

    MpcCost::ControlForm MpcCost::makeForm(double weight, double changeWeight) const
    {
        ControlForm form;
        form.weight = std::max(weight, MIN_WEIGHT);
        form.changeWeight = changeWeight;
        form.diagonal.resize(steps_);
        form.below.setZero(steps_);
        form.wanted.setZero(steps_);
        // T has W1 + 2 W2 on its diagonal (W1 + W2 in the last row) and -W2 beside it.
        for (Eigen::Index k = 0; k < steps_; ++k)
        {
            const double left = k > 0 ? form.below[k] : 0.0;
            const double own = form.weight + (k + 1 < steps_ ? 2.0 : 1.0) * changeWeight;
            form.diagonal[k] = std::sqrt(own - left * left);
            if (k + 1 < steps_)
                form.below[k + 1] = -changeWeight / form.diagonal[k];
        }
        return form;
    }

    void MpcCost::setWanted(ControlForm &form, double last, const std::vector<double> &reference) const
    {
        // Minimise W1 |u - r|^2 + W2 |du - dr|^2: the right hand side contains the references, and in the first row the
        // control before the horizon, which is not an unknown. Then w = L^-1 of it.
        double before = 0.0;
        for (Eigen::Index k = 0; k < steps_; ++k)
        {
            const auto i = static_cast<std::size_t>(k);
            double right = form.weight * reference[i + 1] + form.changeWeight * (reference[i + 1] - reference[i]);
            if (k == 0)
                right += form.changeWeight * last;
            if (k + 1 < steps_)
                right -= form.changeWeight * (reference[i + 2] - reference[i + 1]);
            before = (right - (k > 0 ? form.below[k] * before : 0.0)) / form.diagonal[k];
            form.wanted[k] = before;
        }
    }

    void MpcCost::setProblem(const MpcProblem &problem)
    {
        direction_ = problem.direction;
        speed_ = direction_ * problem.speed;
        drive_ = LagStep(problem.driveLag, parameters_.step);
        commandedSpeed_ = speed_ + problem.driveLag * direction_ * problem.acceleration;
        wheels_ = problem.wheels;
        steer_ = LagStep(problem.steeringLag, parameters_.step);
        lastSteering_ = problem.last.steering;
        headingRoot_ = std::sqrt(problem.align ? parameters_.headingWeight : parameters_.farHeadingWeight);
        reference_.clear();
        std::vector<double> steering(1, parameters_.relativeSteering ? problem.steeringNow : 0.0);
        double before = 0.0;
        for (const MpcReference &point : problem.reference)
        {
            Pose pose = relativeTo(problem.pose, point.pose);
            // Headings are not wrapped, so that a reference past half a turn does not jump.
            pose.yaw = before + wrapAngle(pose.yaw - before);
            before = pose.yaw;
            reference_.push_back(pose);
            steering.push_back(parameters_.relativeSteering ? point.steering : 0.0);
        }
        setWanted(steering_, problem.last.steering, steering);
        std::vector<double> acceleration(steering.size(), 0.0);
        if (parameters_.relativeAcceleration)
        {
            acceleration[0] = direction_ * problem.accelerationNow;
            double speed = problem.speedNow;
            for (std::size_t k = 0; k < problem.reference.size(); ++k)
            {
                acceleration[k + 1] = direction_ * (problem.reference[k].speed - speed) / parameters_.step;
                speed = problem.reference[k].speed;
            }
        }
        setWanted(acceleration_, direction_ * problem.last.acceleration, acceleration);
    }

    void MpcCost::evaluate(const Eigen::VectorXd &unknowns, Eigen::VectorXd &residuals, Jacobian *jacobian) const
    {
        using Jet = ceres::Jet<double, 5>;
        const double duration = parameters_.step;
        residuals.resize(ROWS * steps_);
        if (jacobian != nullptr)
        {
            jacobian->setZero(ROWS * steps_, 2 * steps_);
            sensitivity_.setZero();
        }
        double x = 0.0, y = 0.0, yaw = 0.0;
        double speedBefore = speed_, commandBefore = commandedSpeed_;
        double wheelsBefore = wheels_, steeringBefore = lastSteering_;
        for (Eigen::Index k = 0; k < steps_; ++k)
        {
            const Eigen::Index v = 2 * k, d = 2 * k + 1;  // columns of this step's unknowns
            const double command = unknowns[v], steering = unknowns[d];
            const double speed = drive_.after(command, commandBefore, speedBefore);
            const double wheels = steer_.after(steering, steeringBefore, wheelsBefore);
            const Pose &wanted = reference_[static_cast<std::size_t>(k)];
            const double c = std::cos(wanted.yaw), s = std::sin(wanted.yaw);
            if (jacobian != nullptr)
            {
                const Jet from(direction_ * speedBefore, 1), to(direction_ * speed, 2);
                const BicycleStep<Jet> step =
                    bicycleStep(Jet(yaw, 0), from, Jet((to - from) / duration), Jet(wheelsBefore, 3), Jet(wheels, 4),
                                duration, vehicle_.wheelbase);
                const Eigen::Index n = 2 * k + 2;
                auto state = sensitivity_.leftCols(n);
                follow(drive_, state.row(SPEED), v, speedSensitivity_);
                follow(steer_, state.row(WHEELS), d, wheelsSensitivity_);
                const auto move = [&](StateRow row, const Jet &value)
                {
                    if (row != YAW)
                        state.row(row) += value.v[0] * state.row(YAW);
                    state.row(row) += direction_ * value.v[1] * state.row(SPEED) +
                                      direction_ * value.v[2] * speedSensitivity_.head(n) +
                                      value.v[3] * state.row(WHEELS) + value.v[4] * wheelsSensitivity_.head(n);
                };
                move(X, step.dx);
                move(Y, step.dy);
                move(YAW, step.dyaw);  // last: X and Y use the heading before the step
                state.row(SPEED) = speedSensitivity_.head(n);
                state.row(WHEELS) = wheelsSensitivity_.head(n);
                jacobian->row(ROWS * k).head(n) = alongRoot_ * (c * state.row(X) + s * state.row(Y));
                jacobian->row(ROWS * k + 1).head(n) = acrossRoot_ * (c * state.row(Y) - s * state.row(X));
                jacobian->row(ROWS * k + 2).head(n) = headingRoot_ * state.row(YAW);
                x += step.dx.a;
                y += step.dy.a;
                yaw += step.dyaw.a;
            }
            else
            {
                const BicycleStep<double> step =
                    bicycleStep(yaw, direction_ * speedBefore, direction_ * (speed - speedBefore) / duration,
                                wheelsBefore, wheels, duration, vehicle_.wheelbase);
                x += step.dx;
                y += step.dy;
                yaw += step.dyaw;
            }
            residuals[ROWS * k] = alongRoot_ * (c * (x - wanted.x) + s * (y - wanted.y));
            residuals[ROWS * k + 1] = acrossRoot_ * (c * (y - wanted.y) - s * (x - wanted.x));
            residuals[ROWS * k + 2] = headingRoot_ * (yaw - wanted.yaw);
            speedBefore = speed;
            commandBefore = command;
            steeringBefore = steering;
            wheelsBefore = wheels;
        }
        evaluateControls(unknowns, residuals, jacobian);
    }

    void MpcCost::evaluateControls(const Eigen::VectorXd &unknowns, Eigen::VectorXd &residuals,
                                   Jacobian *jacobian) const
    {
        const double perStep = 1.0 / parameters_.step;
        const auto acceleration = [&](Eigen::Index k)
        {
            return perStep * (unknowns[2 * k] - (k > 0 ? unknowns[2 * k - 2] : commandedSpeed_));
        };
        for (Eigen::Index k = 0; k < steps_; ++k)
        {
            const bool hasNext = k + 1 < steps_;
            const Eigen::Index v = 2 * k, d = 2 * k + 1, a = ROWS * k + 3, s = ROWS * k + 4;
            residuals[a] = acceleration_.diagonal[k] * acceleration(k) - acceleration_.wanted[k];
            residuals[s] = steering_.diagonal[k] * unknowns[d] - steering_.wanted[k];
            if (hasNext)
            {
                residuals[a] += acceleration_.below[k + 1] * acceleration(k + 1);
                residuals[s] += steering_.below[k + 1] * unknowns[d + 2];
            }
            if (jacobian == nullptr)
                continue;
            Jacobian &rows = *jacobian;
            rows(a, v) = acceleration_.diagonal[k] * perStep;
            if (k > 0)
                rows(a, v - 2) = -acceleration_.diagonal[k] * perStep;
            rows(s, d) = steering_.diagonal[k];
            if (hasNext)
            {
                rows(a, v + 2) = acceleration_.below[k + 1] * perStep;
                rows(a, v) -= acceleration_.below[k + 1] * perStep;
                rows(s, d + 2) = steering_.below[k + 1];
            }
        }
    }
}  // namespace parking
