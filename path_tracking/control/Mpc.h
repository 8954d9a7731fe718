#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Parameters of the model predictive controller. */
    struct MpcParameters
    {
        std::size_t horizon{20};  ///< steps
        double step{0.1};         ///< seconds, also the period of control

        double accelerationWeight{0.01};       ///< W1 of a, per (m/s^2)^2
        double steeringWeight{0.01};           ///< W1 of delta, per rad^2
        double accelerationChangeWeight{0.1};  ///< W2 of a, per (m/s^2)^2
        double steeringChangeWeight{5.0};      ///< W2 of delta, per rad^2
        double alongWeight{100.0};             ///< W3 along the reference's heading, per m^2
        double acrossWeight{100.0};            ///< W3 across it, per m^2
        double headingWeight{300.0};           ///< W4, per rad^2
        double alignDistance{5.0};             ///< metres, d: the goal distance within which W4 applies (m = 1)
        /** Weight of the heading beyond alignDistance, per rad^2 (0 in the paper). */
        double farHeadingWeight{300.0};
        /** Whether W1 and W2 weigh the steering angle relative to that of the path. The paper's cost (false) steers
            towards straight wheels, which pulls the car off the path on an arc. */
        bool relativeSteering{true};
        /** Whether W1 and W2 weigh the acceleration relative to that of the timed path, which is not smooth. */
        bool relativeAcceleration{true};

        int maxIterations{6};  ///< of the solver, per step

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };

    /** \brief Control of one step: acceleration (of the signed speed) and steering angle (at the end of the step). */
    struct MpcControl
    {
        double acceleration{0.0};  ///< m/s^2, of the signed speed
        double steering{0.0};      ///< radians, to the left positive
    };

    /** \brief Reference state at the end of a step. */
    struct MpcReference
    {
        Pose pose;             ///< at the end of the step
        double speed{0.0};     ///< m/s, negative in reverse
        double steering{0.0};  ///< radians, to be commanded
    };

    /** \brief Input of one control step. */
    struct MpcProblem
    {
        Pose pose;                            ///< of the car now
        double speed{0.0};                    ///< m/s, negative in reverse
        double acceleration{0.0};             ///< m/s^2, of the moment (matters with a driveLag only)
        double driveLag{0.0};                 ///< seconds, time constant of the drive behind its command
        MpcControl last;                      ///< control of the last step
        double wheels{0.0};                   ///< radians, current angle of the wheels
        double steeringLag{0.0};              ///< seconds, time constant of the wheels behind their command
        double steeringNow{0.0};              ///< radians, of the path at the current time
        double speedNow{0.0};                 ///< m/s, of the path at the current time, negative in reverse
        double accelerationNow{0.0};          ///< m/s^2, of the path just before the current time
        int direction{1};                     ///< of the leg; the car must not move in the opposite direction
        bool eitherWay{false};                ///< whether both directions are allowed, as in the paper's cost
        bool align{false};                    ///< m of the paper: whether the goal is nearer than alignDistance
        std::vector<MpcReference> reference;  ///< one per step of the horizon
    };

    /** \brief Result of one control step. */
    struct MpcSolution
    {
        bool usable{false};                ///< if false, controls is empty and message gives the reason
        std::vector<MpcControl> controls;  ///< one per step of the horizon, within all limits
        int iterations{0};                 ///< steps of the solver, at most MpcParameters::maxIterations
        double cost{0.0};                  ///< before the last solver step, up to a constant; without unit
        double solveTime{0.0};             ///< seconds of wall clock
        std::string message;               ///< why the solution is not usable; otherwise empty
    };

    /** \brief Model predictive control of the kinematic bicycle model (paper, "MPC Control Algorithm").

        The states are z = [x, y, v, psi], the controls u = [a, delta]. Single shooting predicts the horizon with
        bicycleStep(). The cost is the paper's,

            sum over k of  W1 |u_k|^2 + W2 |u_k - u_(k-1)|^2 + W3 |D_k - Z_k|^2 + m W4 (psi_k - psi_d,k)^2,

        with two choices that the paper leaves open. psi_d,k is the heading of the reference at that step: the heading
        in the slot at the end of the path, and correct on a final arc. The first difference is to the control applied
        last.

        Bounds on a and delta are box constraints of the solver. The speed limit, the direction of travel and the
        steering rate couple steps and enter as penalties. The solution is then clamped to satisfy them exactly.

        Ceres solves the problem (Levenberg-Marquardt, dense normal equations, one thread), starting from the last
        solution shifted by one step. An instance must not be used by several threads at once. */
    class Mpc
    {
    public:
        /** \brief Throws parking::Error when \e vehicle or \e parameters are not valid. */
        Mpc(const Vehicle &vehicle, const MpcParameters &parameters);
        ~Mpc();

        /** \brief Moves the solver. A moved-from instance may only be assigned to or destroyed. */
        Mpc(Mpc &&) noexcept;

        /** \brief Moves the solver, see the move constructor. */
        Mpc &operator=(Mpc &&) noexcept;

        /** \brief Discards the last solution. The next problem starts from the controls of the reference. */
        void reset();

        /** \brief Solves one step. It never throws for numbers: if a value is not finite, or the number of reference
            points differs from the horizon, the solution is not usable. */
        MpcSolution solve(const MpcProblem &problem);

    private:
        class Solver;
        std::unique_ptr<Solver> solver_;
    };
}  // namespace parking
