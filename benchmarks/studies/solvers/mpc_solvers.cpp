// One step of model predictive control by several solvers, side by side in one run: the project's own on Ceres, NLopt's
// SLSQP and IPOPT. All get the same problems, recorded on simulated drives, the same cost with the same derivatives,
// and the same start, which is their own last answer, one step on. Processor time of the thread.

#include "benchmarks/system/ProcessorTime.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/control/MpcCost.h"
#include "path_tracking/control/MpcWorkingSet.h"
#include "path_tracking/simulation/ClosedLoop.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#ifdef HAS_NLOPT
#include <nlopt.h>
#endif
#ifdef HAS_IPOPT
#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#endif

namespace
{
    using namespace parking;

    constexpr std::size_t DRIVES = 6;

    double cpuMilliseconds()
    {
        return 1e3 * threadProcessorTime();
    }

    /** Arcs at full lock, lines and cusps, some 25 m. */
    Path makePath(std::uint64_t seed)
    {
        std::mt19937_64 random(seed);
        Path path{{0.0, 0.0, 0.3}, {}};
        double direction = 1.0;
        while (path.length() < 25.0)
        {
            const double share = static_cast<double>(random() % 1000) / 1000.0;
            path.append({(static_cast<double>(random() % 3) - 1.0) / Vehicle().minTurningRadius(),
                         direction * (0.5 + 4.5 * share)});
            if (random() % 3 == 0)
                direction = -direction;
        }
        return path;
    }

    /** What every solver minimises, and within which limits. */
    class Step
    {
    public:
        Step() : cost_(Vehicle(), MpcParameters())
        {
        }

        void set(const MpcProblem &problem)
        {
            const Vehicle vehicle;
            const double period = MpcParameters().step;
            cost_.setProblem(problem);
            limits_[0] = {0.0, vehicle.maxSpeed, vehicle.maxAcceleration * period,
                          problem.direction * (problem.speed + problem.driveLag * problem.acceleration)};
            limits_[1] = {-vehicle.maxSteeringAngle, vehicle.maxSteeringAngle, vehicle.maxSteeringRate * period,
                          std::clamp(problem.last.steering, -vehicle.maxSteeringAngle, vehicle.maxSteeringAngle)};
        }

        Eigen::Index unknowns() const
        {
            return cost_.unknowns();
        }

        const HorizonLimits &limits() const
        {
            return limits_;
        }

        double value(const Eigen::VectorXd &unknowns)
        {
            cost_.evaluate(unknowns, residuals_, nullptr);
            return 0.5 * residuals_.squaredNorm();
        }

        double valueAndGradient(const Eigen::VectorXd &unknowns, Eigen::VectorXd &gradient)
        {
            cost_.evaluate(unknowns, residuals_, &jacobian_);
            gradient.noalias() = jacobian_.transpose() * residuals_;
            return 0.5 * residuals_.squaredNorm();
        }

        const MpcCost::Jacobian &jacobian() const
        {
            return jacobian_;
        }

        /** The cost of an answer after it has been cut to the limits, as a controller has to. */
        double costOf(Eigen::VectorXd unknowns)
        {
            cutToLimits(limits_, unknowns);
            return value(unknowns);
        }

    private:
        MpcCost cost_;
        HorizonLimits limits_;
        Eigen::VectorXd residuals_;
        MpcCost::Jacobian jacobian_;
    };

    using Guess = std::function<Eigen::VectorXd(Step &, Eigen::VectorXd)>;

#ifdef HAS_NLOPT
    struct NloptCall
    {
        Step *step;
        Eigen::VectorXd gradient;
    };

    double nloptCost(unsigned n, const double *x, double *gradient, void *data)
    {
        auto &call = *static_cast<NloptCall *>(data);
        const Eigen::VectorXd unknowns = Eigen::Map<const Eigen::VectorXd>(x, n);
        if (gradient == nullptr)
            return call.step->value(unknowns);
        const double value = call.step->valueAndGradient(unknowns, call.gradient);
        Eigen::Map<Eigen::VectorXd>(gradient, n) = call.gradient;
        return value;
    }

    /** Changes per step: two rows for each unknown. */
    void nloptChanges(unsigned m, double *result, unsigned n, const double *x, double *gradient, void *data)
    {
        const HorizonLimits &limits = static_cast<NloptCall *>(data)->step->limits();
        if (gradient != nullptr)
            std::fill(gradient, gradient + static_cast<std::size_t>(m) * n, 0.0);
        for (unsigned i = 0; i < n; ++i)
        {
            const ChannelLimits &channel = limits[i % 2];
            const double change = x[i] - (i < 2 ? channel.last : x[i - 2]);
            result[2 * i] = change - channel.change;
            result[2 * i + 1] = -change - channel.change;
            if (gradient == nullptr)
                continue;
            for (unsigned side = 0; side < 2; ++side)
            {
                double *row = gradient + static_cast<std::size_t>(2 * i + side) * n;
                row[i] = side == 0 ? 1.0 : -1.0;
                if (i >= 2)
                    row[i - 2] = -row[i];
            }
        }
    }

    Eigen::VectorXd solveByNlopt(Step &step, Eigen::VectorXd guess)
    {
        const auto n = static_cast<unsigned>(step.unknowns());
        nlopt_opt optimiser = nlopt_create(NLOPT_LD_SLSQP, n);
        NloptCall call{&step, {}};
        std::vector<double> low(n), high(n);
        for (unsigned i = 0; i < n; ++i)
        {
            low[i] = step.limits()[i % 2].low;
            high[i] = step.limits()[i % 2].high;
        }
        nlopt_set_lower_bounds(optimiser, low.data());
        nlopt_set_upper_bounds(optimiser, high.data());
        nlopt_set_min_objective(optimiser, nloptCost, &call);
        const std::vector<double> tolerances(2 * n, 1e-8);
        nlopt_add_inequality_mconstraint(optimiser, 2 * n, nloptChanges, &call, tolerances.data());
        nlopt_set_ftol_rel(optimiser, 1e-4);
        nlopt_set_maxeval(optimiser, 100);
        double value = 0.0;
        for (unsigned i = 0; i < n; ++i)
            guess[i] = std::clamp(guess[i], low[i], high[i]);
        nlopt_optimize(optimiser, guess.data(), &value);
        nlopt_destroy(optimiser);
        return guess;
    }
#endif

#ifdef HAS_IPOPT
    /** The step for IPOPT; the Hessian is that of Gauss and Newton. */
    class IpoptStep final : public Ipopt::TNLP
    {
    public:
        using Index = Ipopt::Index;
        using Number = Ipopt::Number;

        Step *step{nullptr};
        Eigen::VectorXd point;

        bool get_nlp_info(Index &n, Index &m, Index &constraintEntries, Index &hessianEntries,
                          IndexStyleEnum &style) override
        {
            n = m = static_cast<Index>(step->unknowns());
            constraintEntries = 2 * n - 2;
            hessianEntries = n * (n + 1) / 2;
            style = C_STYLE;
            return true;
        }

        bool get_bounds_info(Index n, Number *low, Number *high, Index, Number *least, Number *most) override
        {
            for (Index i = 0; i < n; ++i)
            {
                const ChannelLimits &channel = step->limits()[static_cast<std::size_t>(i % 2)];
                const double last = i < 2 ? channel.last : 0.0;
                low[i] = channel.low;
                high[i] = channel.high;
                least[i] = last - channel.change;
                most[i] = last + channel.change;
            }
            return true;
        }

        bool get_starting_point(Index n, bool, Number *x, bool, Number *, Number *, Index, bool, Number *) override
        {
            std::copy(point.data(), point.data() + n, x);
            return true;
        }

        bool eval_f(Index n, const Number *x, bool, Number &value) override
        {
            value = step->value(Eigen::Map<const Eigen::VectorXd>(x, n));
            return true;
        }

        bool eval_grad_f(Index n, const Number *x, bool, Number *gradient) override
        {
            step->valueAndGradient(Eigen::Map<const Eigen::VectorXd>(x, n), gradient_);
            Eigen::Map<Eigen::VectorXd>(gradient, n) = gradient_;
            return true;
        }

        bool eval_g(Index n, const Number *x, bool, Index, Number *changes) override
        {
            for (Index i = 0; i < n; ++i)
                changes[i] = x[i] - (i < 2 ? 0.0 : x[i - 2]);
            return true;
        }

        bool eval_jac_g(Index n, const Number *, bool, Index, Index, Index *rows, Index *columns,
                        Number *values) override
        {
            Index entry = 0;
            for (Index i = 0; i < n; ++i)
                for (const Index column : {i, i - 2})
                {
                    if (column < 0)
                        continue;
                    if (values == nullptr)
                    {
                        rows[entry] = i;
                        columns[entry] = column;
                    }
                    else
                        values[entry] = column == i ? 1.0 : -1.0;
                    ++entry;
                }
            return true;
        }

        bool eval_h(Index n, const Number *x, bool, Number factor, Index, const Number *, bool, Index, Index *rows,
                    Index *columns, Number *values) override
        {
            if (values != nullptr)
            {
                step->valueAndGradient(Eigen::Map<const Eigen::VectorXd>(x, n), gradient_);
                hessian_.noalias() = step->jacobian().transpose() * step->jacobian();
            }
            Index entry = 0;
            for (Index i = 0; i < n; ++i)
                for (Index j = 0; j <= i; ++j, ++entry)
                {
                    if (values == nullptr)
                    {
                        rows[entry] = i;
                        columns[entry] = j;
                    }
                    else
                        values[entry] = factor * hessian_(i, j);
                }
            return true;
        }

        void finalize_solution(Ipopt::SolverReturn, Index n, const Number *x, const Number *, const Number *, Index,
                               const Number *, const Number *, Number, const Ipopt::IpoptData *,
                               Ipopt::IpoptCalculatedQuantities *) override
        {
            point = Eigen::Map<const Eigen::VectorXd>(x, n);
        }

    private:
        Eigen::VectorXd gradient_;
        Eigen::MatrixXd hessian_;
    };

    Guess ipoptSolver()
    {
        Ipopt::SmartPtr<Ipopt::IpoptApplication> application = IpoptApplicationFactory();
        application->Options()->SetIntegerValue("print_level", 0);
        application->Options()->SetStringValue("sb", "yes");
        application->Options()->SetNumericValue("tol", 1e-3);
        application->Options()->SetStringValue("mu_strategy", "adaptive");
        application->Options()->SetStringValue("warm_start_init_point", "no");
        application->Initialize();
        Ipopt::SmartPtr<IpoptStep> task = new IpoptStep;
        return [application, task](Step &step, Eigen::VectorXd guess)
        {
            task->step = &step;
            task->point = std::move(guess);
            application->OptimizeTNLP(GetRawPtr(task));
            return task->point;
        };
    }
#endif

    /** Commanded speeds and steering angles of the reference: the first guess. */
    Eigen::VectorXd referenceControls(const MpcProblem &problem)
    {
        Eigen::VectorXd unknowns(2 * static_cast<Eigen::Index>(problem.reference.size()));
        for (Eigen::Index k = 0; 2 * k < unknowns.size(); ++k)
        {
            unknowns[2 * k] = problem.direction * problem.reference[static_cast<std::size_t>(k)].speed;
            unknowns[2 * k + 1] = problem.reference[static_cast<std::size_t>(k)].steering;
        }
        return unknowns;
    }

    Eigen::VectorXd unknownsOf(const MpcProblem &problem, const MpcSolution &solution)
    {
        Eigen::VectorXd unknowns(2 * static_cast<Eigen::Index>(solution.controls.size()));
        double speed = problem.direction * (problem.speed + problem.driveLag * problem.acceleration);
        for (Eigen::Index k = 0; 2 * k < unknowns.size(); ++k)
        {
            const MpcControl &control = solution.controls[static_cast<std::size_t>(k)];
            speed += problem.direction * control.acceleration * MpcParameters().step;
            unknowns[2 * k] = speed;
            unknowns[2 * k + 1] = control.steering;
        }
        return unknowns;
    }

    /** The problems of some drives, nominal and disturbed in turn. */
    std::vector<std::vector<MpcProblem>> recordProblems()
    {
        std::vector<std::vector<MpcProblem>> drives;
        for (std::uint64_t seed = 0; seed < DRIVES; ++seed)
        {
            ClosedLoopParameters parameters;
            if (seed % 2 == 1)
                parameters.disturbances = Disturbances::everyday(seed);
            ClosedLoop loop(Vehicle(), parameters);
            Mpc mpc(Vehicle(), parameters.tracking.mpc);
            drives.emplace_back();
            loop.setSolve(
                [&](const MpcProblem &problem)
                {
                    drives.back().push_back(problem);
                    return mpc.solve(problem);
                });
            loop.drive(makePath(seed));
        }
        return drives;
    }

    void report(const char *name, std::vector<double> times, double excess, double reference)
    {
        const TimeStatistics statistics = timeStatistics(times);
        std::printf("| %-12s | %7.3f | %7.3f | %7.3f | %6.1f | %8.4f |\n", name, statistics.median, statistics.p99,
                    statistics.max, statistics.median / reference, excess);
    }
}  // namespace

int main()
{
    const auto drives = recordProblems();
    std::vector<std::pair<const char *, Guess>> others;
#ifdef HAS_NLOPT
    others.emplace_back("NLopt SLSQP", solveByNlopt);
#endif
#ifdef HAS_IPOPT
    others.emplace_back("IPOPT", ipoptSolver());
#endif
    Step step;
    std::vector<double> own;
    std::vector<std::vector<double>> times(others.size());
    std::vector<double> more(others.size(), 0.0);
    double ownCost = 0.0;
    std::size_t count = 0;
    for (const auto &drive : drives)
    {
        Mpc mpc(Vehicle{}, MpcParameters{});
        std::vector<Eigen::VectorXd> last(others.size());
        for (const MpcProblem &problem : drive)
        {
            step.set(problem);
            ++count;
            double begin = cpuMilliseconds();
            const MpcSolution solution = mpc.solve(problem);
            own.push_back(cpuMilliseconds() - begin);
            ownCost += step.costOf(unknownsOf(problem, solution));
            for (std::size_t i = 0; i < others.size(); ++i)
            {
                Eigen::VectorXd guess = referenceControls(problem);
                if (last[i].size() > 0)
                    guess.head(guess.size() - 2) = last[i].tail(guess.size() - 2);
                cutToLimits(step.limits(), guess);
                begin = cpuMilliseconds();
                last[i] = others[i].second(step, std::move(guess));
                times[i].push_back(cpuMilliseconds() - begin);
                more[i] += step.costOf(last[i]);
            }
        }
    }
    std::printf("%zu steps of %zu drives, horizon %zu steps of %.1f s; ms of processor time\n\n", count, drives.size(),
                MpcParameters().horizon, MpcParameters().step);
    std::printf("| solver       | median  | p99     | max     | ratio  | cost / own |\n|---|---|---|---|---|---|\n");
    const double reference = timeStatistics(own).median;
    report("this (Ceres)", own, 1.0, reference);
    for (std::size_t i = 0; i < others.size(); ++i)
        report(others[i].first, times[i], more[i] / ownCost, reference);
    return 0;
}
