#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace parking
{
    /** \brief What the controller may be tuned with. */
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
        double alignDistance{5.0};             ///< metres, d: nearer to the goal than this W4 holds (m = 1)
        /** Weight of the heading farther away, per rad^2 (the paper has none, 0). */
        double farHeadingWeight{300.0};
        /** Does W1 weigh the steering angle against the one that the path has there, and W2 its changes likewise? The
            paper's cost (false) pulls the wheels straight, which on an arc pulls the car off the path. */
        bool relativeSteering{true};
        /** The same for the acceleration: W1 and W2 weigh it against that of the timed path, which is not smooth. */
        bool relativeAcceleration{true};

        int maxIterations{6};  ///< of the solver per step

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };

    /** \brief Acceleration in m/s^2 (of the signed speed), steering angle in radians (at the end of the step). */
    struct MpcControl
    {
        double acceleration{0.0};  ///< m/s^2, of the signed speed
        double steering{0.0};      ///< radians, to the left positive
    };

    /** \brief Where the car should be at the end of a step, and what the timed path has there. */
    struct MpcReference
    {
        Pose pose;             ///< at the end of the step
        double speed{0.0};     ///< m/s, negative in reverse
        double steering{0.0};  ///< radians, to be commanded
    };

    /** \brief One step's question. */
    struct MpcProblem
    {
        Pose pose;                            ///< of the car now
        double speed{0.0};                    ///< m/s, negative in reverse
        double acceleration{0.0};             ///< m/s^2, of the moment (matters with a driveLag only)
        double driveLag{0.0};                 ///< seconds, time constant of the drive behind its command
        MpcControl last;                      ///< applied in the last step
        double wheels{0.0};                   ///< radians, angle of the wheels now
        double steeringLag{0.0};              ///< seconds, time constant of the wheels behind their command
        double steeringNow{0.0};              ///< radians, of the path at this moment
        double speedNow{0.0};                 ///< m/s, of the path at this moment, negative in reverse
        double accelerationNow{0.0};          ///< m/s^2, of the path, what leads to this moment
        int direction{1};                     ///< of the leg: the car may not move the other way
        bool eitherWay{false};                ///< it may: the paper's cost says nothing of directions
        bool align{false};                    ///< m of the paper: is the goal nearer than alignDistance?
        std::vector<MpcReference> reference;  ///< one per step of the horizon
    };

    /** \brief One step's answer. */
    struct MpcSolution
    {
        bool usable{false};                ///< false: controls is empty and message says why
        std::vector<MpcControl> controls;  ///< one per step of the horizon, within all limits
        int iterations{0};                 ///< steps of the solver, at most MpcParameters::maxIterations
        double cost{0.0};                  ///< at the begin of the last step, up to a constant; without unit
        double solveTime{0.0};             ///< seconds of wall clock
        std::string message;               ///< why it is not usable; otherwise empty
    };

    /** \brief Model predictive control of the kinematic bicycle model (paper, "MPC Control Algorithm").

        States z = [x, y, v, psi], controls u = [a, delta]; single shooting over the horizon with bicycleStep(). The
        cost is the paper's,

            sum over k of  W1 |u_k|^2 + W2 |u_k - u_(k-1)|^2 + W3 |D_k - Z_k|^2 + m W4 (psi_k - psi_d,k)^2,

        with these choices where the paper leaves them open: psi_d,k is the heading of the reference at that step, which
        is the heading in the slot at the end of the path and stays right on a final arc; the difference of the first
        step is to the control applied last. Bounds on a and delta are box constraints of the solver. The speed limit,
        the direction of travel and the steering rate couple steps and enter as penalties; the answer is then cut to
        obey them exactly.

        Ceres solves it (Levenberg-Marquardt, dense normal equations, one thread, silent), starting from the last answer
        shifted by one step. An instance is not for use by several threads at once. */
    class Mpc
    {
    public:
        /** \brief Throws parking::Error when \e vehicle or \e parameters are not valid. */
        Mpc(const Vehicle &vehicle, const MpcParameters &parameters);
        ~Mpc();

        /** \brief Takes over the solver; what is moved from may only be assigned to or destroyed. */
        Mpc(Mpc &&) noexcept;

        /** \brief As the constructor. */
        Mpc &operator=(Mpc &&) noexcept;

        /** \brief Forgets the last answer: the next problem starts from the reference's controls. */
        void reset();

        /** \brief Solves one step. Never throws for numbers: a problem that is not finite or has another number of
            reference points than the horizon gets an unusable answer. */
        MpcSolution solve(const MpcProblem &problem);

    private:
        class Solver;
        std::unique_ptr<Solver> solver_;
    };
}  // namespace parking
