#pragma once

#include "parking_geometry/Vehicle.h"
#include "path_tracking/control/ActuatorLag.h"
#include "path_tracking/control/Mpc.h"

#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief The cost of the controller as a sum of squares, with its derivatives.

        The unknowns of each step are the commanded speed along the direction of travel and the commanded steering angle
        at its end. Differences of speeds give the commanded accelerations. With speeds as unknowns, the limits of both
        controls have one form: a box, and a bound on the change per step. Speed and wheels follow their commands with a
        first-order lag each.

        All quantities are relative to the pose of the car at the start of the horizon, so that numbers stay small on
        any map. Automatic differentiation yields the derivatives of one step, which are chained over the horizon.

        W1 and W2 form a quadratic form with a constant tridiagonal matrix T per control u. With T = L L' it is |L' u -
        w|^2 up to a constant. This needs one residual per control instead of two, which saves time in a dense
        solver. */
    class MpcCost
    {
    public:
        /** \brief Derivatives of the residuals: one row per residual, one column per unknown. */
        using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

        /** \brief Vehicle and parameters must be valid (see Mpc). Call setProblem() before evaluate(). */
        MpcCost(const Vehicle &vehicle, const MpcParameters &parameters);

        /** \brief Number of unknowns: speed and steering angle of each step. */
        Eigen::Index unknowns() const
        {
            return 2 * steps_;
        }

        /** \brief Number of residuals: five per step. */
        Eigen::Index residuals() const
        {
            return ROWS * steps_;
        }

        /** \brief Sets a problem, which must be finite and of the right size. */
        void setProblem(const MpcProblem &problem);

        /** \brief Computes the residuals at \e unknowns, and their Jacobian unless \e jacobian is null. Both are
            resized. */
        void evaluate(const Eigen::VectorXd &unknowns, Eigen::VectorXd &residuals, Jacobian *jacobian) const;

    private:
        /** Residuals per step: along, across, psi, a, delta. */
        static constexpr Eigen::Index ROWS = 5;

        /** The quadratic form of one control. */
        struct ControlForm
        {
            double weight;             // W1
            double changeWeight;       // W2
            Eigen::VectorXd diagonal;  // of L
            Eigen::VectorXd below;     // of L, below the diagonal
            Eigen::VectorXd wanted;    // w
        };

        ControlForm makeForm(double weight, double changeWeight) const;
        void setWanted(ControlForm &form, double last, const std::vector<double> &reference) const;
        void evaluateControls(const Eigen::VectorXd &unknowns, Eigen::VectorXd &residuals, Jacobian *jacobian) const;

        Vehicle vehicle_;
        MpcParameters parameters_;
        Eigen::Index steps_;
        double alongRoot_;
        double acrossRoot_;
        double headingRoot_{0.0};
        double direction_{1.0};
        double speed_{0.0};           // along the direction
        double commandedSpeed_{0.0};  // along the direction
        double wheels_{0.0};
        double lastSteering_{0.0};
        LagStep drive_;
        LagStep steer_;
        std::vector<Pose> reference_;  // relative to the car
        ControlForm acceleration_;
        ControlForm steering_;
        mutable Jacobian sensitivity_;  // of x, y, psi, speed and wheels to all unknowns
        mutable Eigen::RowVectorXd speedSensitivity_;
        mutable Eigen::RowVectorXd wheelsSensitivity_;
    };
}  // namespace parking
