#include "path_tracking/control/Mpc.h"

#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"
#include "path_tracking/control/MpcCost.h"
#include "path_tracking/control/MpcWorkingSet.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>

#include <ceres/cost_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

namespace parking
{
    namespace
    {
        constexpr std::size_t LONGEST_HORIZON = 200;
        constexpr double MAX_WEIGHT = 1e9;
        constexpr double FUNCTION_TOLERANCE = 1e-5;  // relative gain at which Ceres stops
        constexpr double SETTLED = 1e-4;             // relative gain of a step below which the solver ends
        constexpr int MAX_REJECTIONS = 8;            // rejections of steps by the trust region, per working set
        constexpr double FIRST_RADIUS = 1e4;
        constexpr double LARGEST_COST = 1e30;
        /** Bounds of the trust region between steps, and its growth per step. It shrinks when a step is clamped to a
            limit, which the next working set contains. Without growth it would remain small elsewhere. */
        constexpr double MIN_RADIUS = 1.0, LARGEST_RADIUS = 1e8, GROWTH = 30.0;

        /** A cost function with its last result cached. */
        struct Evaluation
        {
            Eigen::VectorXd unknowns;
            Eigen::VectorXd residuals;
            MpcCost::Jacobian jacobian;
        };

        /** Cost as a function of a step in the free directions of a working set, for Ceres. */
        class FreeCost final : public ceres::CostFunction
        {
        public:
            FreeCost(const MpcCost &cost, const HorizonLimits &limits, const WorkingSet &active,
                     const Eigen::VectorXd &base, Evaluation &last)
              : cost_(cost),
                limits_(limits),
                active_(active),
                base_(base),
                last_(last)
            {
                set_num_residuals(static_cast<int>(cost.residuals()));
                mutable_parameter_block_sizes()->push_back(static_cast<int>(active.freedom()));
            }

            /** The unknowns after \e step, clamped to their limits. */
            Eigen::VectorXd unknowns(const double *step) const
            {
                Eigen::VectorXd result = active_.expand(base_, step);
                cutToLimits(limits_, result);
                return result;
            }

            bool Evaluate(double const *const *parameters, double *residuals, double **jacobians) const override
            {
                const Eigen::VectorXd point = unknowns(parameters[0]);
                Eigen::Map<Eigen::VectorXd> target(residuals, cost_.residuals());
                if (jacobians == nullptr || jacobians[0] == nullptr)
                {
                    cost_.evaluate(point, values_, nullptr);
                    target = values_;
                    return true;
                }
                if (last_.unknowns != point)
                {
                    cost_.evaluate(point, last_.residuals, &last_.jacobian);
                    last_.unknowns = point;
                }
                target = last_.residuals;
                active_.reduce(last_.jacobian, jacobians[0]);
                return true;
            }

        private:
            const MpcCost &cost_;
            const HorizonLimits &limits_;
            const WorkingSet &active_;
            const Eigen::VectorXd base_;
            Evaluation &last_;
            mutable Eigen::VectorXd values_;
        };

        /** Ends the minimiser after its first improving step: the working set may change there. */
        class StopAfterStep final : public ceres::IterationCallback
        {
        public:
            ceres::CallbackReturnType operator()(const ceres::IterationSummary &summary) override
            {
                return summary.iteration > 0 && summary.step_is_successful ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                                                           : ceres::SOLVER_CONTINUE;
            }
        };

        bool allFinite(const MpcProblem &problem)
        {
            bool finite = isFinite(problem.pose) && std::isfinite(problem.speed) &&
                          std::isfinite(problem.last.acceleration) && std::isfinite(problem.last.steering) &&
                          std::isfinite(problem.wheels) && std::isfinite(problem.steeringNow) &&
                          std::isfinite(problem.speedNow) && std::isfinite(problem.accelerationNow) &&
                          std::isfinite(problem.steeringLag) && std::isfinite(problem.driveLag) &&
                          std::isfinite(problem.acceleration);
            for (const MpcReference &point : problem.reference)
                finite = finite && isFinite(point.pose) && std::isfinite(point.speed) && std::isfinite(point.steering);
            return finite;
        }
    }  // namespace

    void MpcParameters::validate() const
    {
        const Require require("mpc");
        require.that(horizon >= 1 && horizon <= LONGEST_HORIZON, "horizon", static_cast<double>(horizon),
                     "a number of steps from 1 to 200");
        require.that(std::isfinite(step) && step > 0.0 && step <= 1.0, "step", step, "above 0 and up to 1 second");
        // Far above sensible values, and far below those at which squares and sums overflow.
        const auto weight = [&require](const char *field, double value)
        {
            require.that(value >= 0.0 && value <= MAX_WEIGHT, field, value, "a number from 0 to 1e9");
        };
        weight("accelerationWeight", accelerationWeight);
        weight("steeringWeight", steeringWeight);
        weight("accelerationChangeWeight", accelerationChangeWeight);
        weight("steeringChangeWeight", steeringChangeWeight);
        weight("alongWeight", alongWeight);
        weight("acrossWeight", acrossWeight);
        weight("headingWeight", headingWeight);
        weight("farHeadingWeight", farHeadingWeight);
        require.notNegative("alignDistance", alignDistance);
        require.that(maxIterations >= 1, "maxIterations", maxIterations, "at least 1");
    }

    class Mpc::Solver
    {
    public:
        Solver(const Vehicle &vehicle, const MpcParameters &parameters)
          : vehicle_(vehicle),
            parameters_(parameters),
            cost_(vehicle, parameters),
            unknowns_(Eigen::VectorXd::Zero(cost_.unknowns()))
        {
            limits_[SPEED].high = vehicle.maxSpeed;
            limits_[SPEED].change = vehicle.maxAcceleration * parameters.step;
            limits_[STEERING].low = -vehicle.maxSteeringAngle;
            limits_[STEERING].high = vehicle.maxSteeringAngle;
            limits_[STEERING].change = vehicle.maxSteeringRate * parameters.step;
            options_.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
            options_.max_num_iterations = MAX_REJECTIONS;
            options_.function_tolerance = FUNCTION_TOLERANCE;
            options_.parameter_tolerance = 1e-6;
            options_.gradient_tolerance = 1e-6;
            options_.max_num_consecutive_invalid_steps = 2 * MAX_REJECTIONS;  // more would be printed
            options_.num_threads = 1;
            options_.logging_type = ceres::SILENT;
            options_.minimizer_progress_to_stdout = false;
            options_.callbacks.push_back(&stopAfterStep_);
        }

        void reset()
        {
            warm_ = false;
        }

        MpcSolution solve(const MpcProblem &problem)
        {
            const auto begin = std::chrono::steady_clock::now();
            MpcSolution solution;
            if (problem.reference.size() != parameters_.horizon)
                solution.message = "the reference has " + std::to_string(problem.reference.size()) +
                                   " points; the horizon has " + std::to_string(parameters_.horizon) + " steps";
            else if (!allFinite(problem))
                solution.message = "the problem holds a number that is not finite";
            else
                run(problem, solution);
            if (!solution.usable)
                reset();
            solution.solveTime = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
            return solution;
        }

    private:
        enum Channel
        {
            SPEED,
            STEERING
        };

        void run(const MpcProblem &problem, MpcSolution &solution)
        {
            limits_[SPEED].low = problem.eitherWay ? -vehicle_.maxSpeed : 0.0;
            limits_[SPEED].last = problem.direction * (problem.speed + problem.driveLag * problem.acceleration);
            limits_[STEERING].last =
                std::clamp(problem.last.steering, -vehicle_.maxSteeringAngle, vehicle_.maxSteeringAngle);
            prepare(problem);
            cost_.setProblem(problem);
            options_.initial_trust_region_radius = FIRST_RADIUS;
            last_.unknowns.resize(0);
            std::optional<WorkingSet> before;
            bool settled = false;
            while (solution.iterations < parameters_.maxIterations)
            {
                if (last_.unknowns.size() == 0 || last_.unknowns != unknowns_)
                {
                    cost_.evaluate(unknowns_, last_.residuals, &last_.jacobian);
                    last_.unknowns = unknowns_;
                }
                solution.cost = 0.5 * last_.residuals.squaredNorm();
                if (!(solution.cost < LARGEST_COST) || !last_.jacobian.allFinite())
                {
                    // Ceres would print a complaint.
                    solution.message = "the cost of the first guess is " + formatNumber(solution.cost);
                    return;
                }
                const WorkingSet active(limits_, unknowns_, last_.jacobian.transpose() * last_.residuals);
                if (active.freedom() == 0 || (settled && before && active == *before))
                    break;
                ceres::Solver::Summary summary;
                improve(active, summary);
                ++solution.iterations;
                if (!summary.IsSolutionUsable() || !std::isfinite(summary.final_cost) || !unknowns_.allFinite())
                {
                    solution.message = "the solver failed: " + summary.message;
                    return;
                }
                settled = summary.initial_cost - summary.final_cost <= SETTLED * summary.initial_cost;
                before = active;
            }
            warm_ = true;
            extract(problem, solution);
        }

        /** One improving step in the free directions of the working set, if there is one. */
        void improve(const WorkingSet &active, ceres::Solver::Summary &summary)
        {
            FreeCost cost(cost_, limits_, active, unknowns_, last_);
            std::vector<double> step(static_cast<std::size_t>(active.freedom()), 0.0);
            ceres::Problem::Options problemOptions;
            problemOptions.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
            problemOptions.disable_all_safety_checks = true;
            ceres::Problem problem(problemOptions);
            problem.AddResidualBlock(&cost, nullptr, step.data());
            ceres::Solve(options_, &problem, &summary);
            unknowns_ = cost.unknowns(step.data());
            if (!summary.iterations.empty())
                options_.initial_trust_region_radius =
                    std::clamp(GROWTH * summary.iterations.back().trust_region_radius, MIN_RADIUS, LARGEST_RADIUS);
        }

        /** Initial guess: the last solution shifted by one step, or the controls of the reference. */
        void prepare(const MpcProblem &problem)
        {
            const Eigen::Index n = unknowns_.size();
            if (warm_)
            {
                for (Eigen::Index i = 0; i + 2 < n; ++i)
                    unknowns_[i] = unknowns_[i + 2];
            }
            else
            {
                for (Eigen::Index k = 0; 2 * k < n; ++k)
                {
                    const MpcReference &point = problem.reference[static_cast<std::size_t>(k)];
                    unknowns_[2 * k] = problem.direction * point.speed;
                    unknowns_[2 * k + 1] = point.steering;
                }
            }
            cutToLimits(limits_, unknowns_);
        }

        void extract(const MpcProblem &problem, MpcSolution &solution) const
        {
            double before = problem.direction * limits_[SPEED].last;
            for (Eigen::Index k = 0; 2 * k < unknowns_.size(); ++k)
            {
                const double speed = problem.direction * unknowns_[2 * k];
                solution.controls.push_back({(speed - before) / parameters_.step, unknowns_[2 * k + 1]});
                before = speed;
            }
            solution.usable = true;
        }

        Vehicle vehicle_;
        MpcParameters parameters_;
        HorizonLimits limits_;
        MpcCost cost_;
        ceres::Solver::Options options_;
        StopAfterStep stopAfterStep_;
        Eigen::VectorXd unknowns_;
        Evaluation last_;
        bool warm_{false};
    };

    Mpc::Mpc(const Vehicle &vehicle, const MpcParameters &parameters)
    {
        vehicle.validate();
        parameters.validate();
        solver_ = std::make_unique<Solver>(vehicle, parameters);
    }

    Mpc::~Mpc() = default;
    Mpc::Mpc(Mpc &&) noexcept = default;
    Mpc &Mpc::operator=(Mpc &&) noexcept = default;

    void Mpc::reset()
    {
        solver_->reset();
    }

    MpcSolution Mpc::solve(const MpcProblem &problem)
    {
        return solver_->solve(problem);
    }
}  // namespace parking
