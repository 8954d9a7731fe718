#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief The quadratic program of PathSmoother. Its solution is the curvature profile that follows a path of arcs
        most closely and ends at the end of the path.

        The curvature, its rate and the deviation are limited.

        The reference consists of nodes joined by intervals of constant curvature kRef. Along it the car has a lateral
        deviation y, a deviation of heading psi and a curvature k:

        y' = psi,  psi' = (k - kRef) - kRef^2 y,  k' = u   (first order in the deviations)

        The program minimises the integral of (y^2 + lever^2 psi^2) / tolerance^2 + (u / uSoft)^2. In each interval |k|
        <= kMax and |u| <= uMax. At a node with a corridor, y + front psi and y - rear psi must lie in it. At both ends
        y and psi are 0, and k is free or given.

        The solver is a primal-dual interior point method whose linear systems are Riccati recursions. Its effort is
        linear in the number of nodes, and the bounds hold strictly. An object reuses its memory. */
    class CurvatureProgram
    {
    public:
        /** \brief Parameters common to all nodes. */
        struct Settings
        {
            double maxCurvature{0.3};  ///< kMax, 1/m
            double lever{2.5};         ///< weight of a deviation of heading relative to a lateral one, metres
            double softRate{0.2};      ///< uSoft, 1/m^2
            double tolerance{0.05};    ///< deviation that costs as much as steering at the soft rate, metres
            double front{3.8};         ///< metres from the axle to the leading end of the body
            double rear{0.9};          ///< metres from the axle to the trailing end of the body
            std::optional<double> startCurvature;  ///< k at the first node, if fixed
            std::optional<double> endCurvature;    ///< k at the last node, if fixed
        };

        /** \brief The reference between two nodes and the limit of the curvature rate. */
        struct Interval
        {
            double length{0.0};     ///< metres along the reference, positive
            double curvature{0.0};  ///< kRef, curvature of the reference, 1/m
            double maxRate{1.0};    ///< uMax, 1/m^2
        };

        /** \brief Limits of the lateral deviation of the body's ends at a node, metres; infinite for no limit. */
        struct Corridor
        {
            double low{-std::numeric_limits<double>::infinity()};  ///< limit to the right, usually negative
            double high{std::numeric_limits<double>::infinity()};  ///< limit to the left
        };

        /** \brief Deviations at a node: y, psi and the curvature k itself. */
        using State = Eigen::Vector3d;

        /** \brief Starts a new problem. \param corridors one per node, that is one more than intervals; empty for no
            limits */
        void reset(const Settings &settings, const std::vector<Interval> &intervals,
                   const std::vector<Corridor> &corridors);

        /** \brief Replaces the linear model by the linearisation at \e states, which the caller has simulated with
            their curvatures.

            A second solve() then removes the remaining error at the end.
            \param lengths driven length of each interval, to which maxRate refers */
        void relinearise(const std::vector<State> &states, const std::vector<double> &lengths);

        /** \brief Solves the program and stores the solution in states(), with y and psi of the linear model. \return
            false if no profile satisfies the limits */
        bool solve();

        /** \brief Solution of the last solve(), one state per node. */
        const std::vector<State> &states() const
        {
            return x_;
        }

        /** \brief Derivative of (y, psi) at the end by the curvature of each node, in the linear model. */
        void endSensitivity(std::vector<Eigen::Vector2d> &sensitivity) const;

    private:
        struct Stage
        {
            double h, reference, maxRate, rate;
            Eigen::Matrix3d A;
            Eigen::Vector3d B, c;
            // Of the Riccati recursion.
            Eigen::RowVector3d gain;
            double feedforward;
        };

        /** A two-sided bound |row . x - middle| <= 1 (rows are scaled) with its slacks and multipliers. */
        struct Bound
        {
            double upperSlack{1.0}, lowerSlack{1.0}, upperMultiplier{1.0}, lowerMultiplier{1.0};
            double middle{0.0};

            double weight() const;
            double gradient(double target) const;
            double longestStep(double value, double target) const;
            void step(double value, double target, double length);
            double gap() const;
        };

        /** A corridor in the form of Bound: scale turns metres into multiples of its half width. */
        struct Scaled
        {
            double scale{0.0}, middle{0.0};
        };

        void newtonStep(double target);
        template <class Visit>
        void forEachBound(const Visit &visit);

        Settings settings_;
        std::vector<Stage> stages_;
        std::vector<Scaled> corridors_;  // scale 0: no limit
        std::vector<State> x_, next_;
        std::vector<double> u_, nextU_;
        std::vector<Bound> curvatureBounds_, rateBounds_, frontBounds_, rearBounds_;
    };
}  // namespace parking
