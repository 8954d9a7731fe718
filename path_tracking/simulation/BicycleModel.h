#pragma once

#include <cmath>

namespace parking
{
    /** \brief Displacement of one step of the kinematic model, relative to the pose before it.

        Its frame is that of the given heading. */
    template <typename T>
    struct BicycleStep
    {
        T dx;    ///< metres
        T dy;    ///< metres
        T dyaw;  ///< radians
    };

    /** \brief One fourth-order Runge-Kutta step of the kinematic bicycle model (paper, "Kinematic Model"):
        x' = v cos(psi), y' = v sin(psi), v' = a, psi' = v tan(delta) / L.

        The acceleration is held over the step. The steering angle moves at constant rate from \e steeringBefore to
        \e steering, as a rate-limited servo moves it; the paper's steps of delta cannot be driven. Templated so that
        automatic differentiation goes through it.

        \param yaw heading at the beginning, radians
        \param speed at the beginning, m/s, negative in reverse
        \param acceleration m/s^2, held
        \param steeringBefore radians, at the beginning
        \param steering radians, at the end
        \param duration seconds
        \param wheelbase metres */
    template <typename T>
    BicycleStep<T> bicycleStep(const T &yaw, const T &speed, const T &acceleration, const T &steeringBefore,
                               const T &steering, double duration, double wheelbase)
    {
        using std::cos;
        using std::sin;
        using std::tan;
        const T middleSpeed = speed + acceleration * (0.5 * duration);
        const T endSpeed = speed + acceleration * duration;
        const T beginRate = speed * tan(steeringBefore) / wheelbase;
        const T middleRate = middleSpeed * tan((steeringBefore + steering) * 0.5) / wheelbase;
        const T endRate = endSpeed * tan(steering) / wheelbase;
        // Neither v' nor psi' depends on x, y or psi: the two middle stages share their rate and differ in psi only.
        const T yaw2 = yaw + beginRate * (0.5 * duration);
        const T yaw3 = yaw + middleRate * (0.5 * duration);
        const T yaw4 = yaw + middleRate * duration;
        const double sixth = duration / 6.0;
        BicycleStep<T> step;
        step.dx = (speed * cos(yaw) + (cos(yaw2) + cos(yaw3)) * middleSpeed * 2.0 + endSpeed * cos(yaw4)) * sixth;
        step.dy = (speed * sin(yaw) + (sin(yaw2) + sin(yaw3)) * middleSpeed * 2.0 + endSpeed * sin(yaw4)) * sixth;
        step.dyaw = (beginRate + middleRate * 4.0 + endRate) * sixth;
        return step;
    }
}  // namespace parking
