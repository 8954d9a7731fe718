#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief The quadratic program at the heart of PathSmoother: the curvature profile that follows a path of arcs
        most closely under limits on curvature, on its rate and on the deviation, and that ends where the path ends.

        Along the reference (nodes, joined by intervals of constant reference curvature) the car has a lateral deviation
        y, a deviation of heading psi and a curvature k:

        y' = psi,  psi' = (k - kRef) - kRef^2 y,  k' = u   (first order in the deviations)

        Minimised: the integral of (y^2 + lever^2 psi^2) / tolerance^2 + (u / uSoft)^2, under |k| <= kMax, |u| <= uMax
        per interval and, where a node has a corridor, with y + front psi and y - rear psi inside of it. y and psi are 0
        at both ends; k is free there or given.

        Solved by a primal-dual interior point method whose linear systems are Riccati recursions, so the effort grows
        with the number of nodes; bounds hold strictly. An object keeps its memory from one use to the next. */
    class CurvatureProgram
    {
    public:
        /** \brief What the program uses at all nodes. */
        struct Settings
        {
            double maxCurvature{0.3};  ///< kMax, 1/m
            double lever{2.5};         ///< metres; how much a deviation of heading weighs against a lateral one
            double softRate{0.2};      ///< uSoft, 1/m^2
            double tolerance{0.05};    ///< metres; deviations of this size cost as much as steering at the soft rate
            double front{3.8};         ///< metres from the axle to the leading end of the body
            double rear{0.9};          ///< metres from the axle to the trailing end of the body
            std::optional<double> startCurvature;  ///< k at the first node, where it is given
            std::optional<double> endCurvature;    ///< k at the last node, where it is given
        };

        /** \brief The reference between two nodes, and how fast the curvature may change there. */
        struct Interval
        {
            double length{0.0};     ///< metres along the reference, positive
            double curvature{0.0};  ///< of the reference
            double maxRate{1.0};    ///< uMax, 1/m^2
        };

        /** \brief Lateral deviations that the ends of the body may have at a node, metres; infinite for no limit. */
        struct Corridor
        {
            double low{-std::numeric_limits<double>::infinity()};  ///< to the right, usually negative
            double high{std::numeric_limits<double>::infinity()};  ///< to the left
        };

        /** \brief Deviations at a node: y, psi and the curvature k itself. */
        using State = Eigen::Vector3d;

        /** \brief Starts a new problem. \param corridors per node (one more than intervals); empty for none at all. */
        void reset(const Settings &settings, const std::vector<Interval> &intervals,
                   const std::vector<Corridor> &corridors);

        /** \brief Replaces the linear model by the one that is exact at \e states, which the caller simulated with
            their curvatures, so that a second solve() removes what the first one left at the end.

            \param lengths what the car drives along each interval; maxRate is per metre of these */
        void relinearise(const std::vector<State> &states, const std::vector<double> &lengths);

        /** \brief Solves. False when there is no profile within the limits.
            states() is the solution; its y and psi are those of the linear model. */
        bool solve();

        /** \brief What solve() found, one per node. */
        const std::vector<State> &states() const
        {
            return x_;
        }

        /** \brief Change of (y, psi) at the end per change of the curvature at each node, in the linear model. */
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
