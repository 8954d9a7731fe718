// The nonlinear program of a trajectory solved twice, side by side in one run: by the project's interior point method
// and by IPOPT (with MUMPS). Both get the same program, the same exact derivatives and the same start; processor time
// of the thread. usage: trajectory_solvers SCENARIO...

#include "automatic_parking/scenario/ScenarioPlanner.h"
#include "benchmarks/system/ProcessorTime.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "path_tracking/trajectory/program/InteriorPoint.h"
#include "path_tracking/trajectory/program/MotionOutline.h"
#include "path_tracking/trajectory/program/Separation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>

namespace
{
    using namespace parking;

    constexpr double SPACING = 0.2, RANGE = 1.5;  // metres, as in the optimiser's first round
    constexpr double WIDE = 1e12;                 // slack and softness with which the system is the Hessian alone
    constexpr int COLOURS = 3;                    // nodes as far apart as this share no constraint

    double cpuMilliseconds()
    {
        return 1e3 * threadProcessorTime();
    }

    /** The program that the optimiser solves first near a path. */
    MotionProblem problemOf(const FootprintChecker &checker, const Path &path)
    {
        const TrajectoryOptions options;
        Path local = path;
        local.start = checker.obstacles().toLocal(path.start);
        const Vehicle &car = checker.vehicle();
        const MotionOutline outline(local, car, options.step, options.initialSteering, options.finalSteering);
        MotionProblem problem;
        problem.vehicle = car;
        problem.weights = options.weights;
        problem.clearance = options.preferredClearance - options.margin;
        outline.write(problem);
        SeparationOptions separation;
        separation.margin = options.margin;
        separation.range = RANGE;
        const auto poseAt = [&outline](std::size_t interval, double fraction)
        {
            return outline.poseAt(interval, fraction);
        };
        const std::vector<ConvexPiece> pieces = convexPieces(checker.obstacles());
        SeparationPlan(pieces, car, separation, checkpointsAlong(problem.directions, car.wheelbase, SPACING, poseAt),
                       poseAt)
            .write(problem);
        return problem;
    }

    /** How well nodes solve a program. */
    struct Quality
    {
        double cost, duration, violation;
    };

    Quality qualityOf(MotionProgram &program, const std::vector<NodeVector> &nodes)
    {
        std::vector<Eigen::Vector4d> joints;
        std::vector<double> values;
        Quality quality{program.evaluate(nodes, joints, values), 0.0, 0.0};
        for (const Eigen::Vector4d &joint : joints)
            quality.violation = std::max(quality.violation, joint.lpNorm<Eigen::Infinity>());
        for (const double value : values)
            quality.violation = std::max(quality.violation, -value);
        for (std::size_t k = 0; k < program.intervals(); ++k)
            quality.duration += nodes[k][NODE_DURATION];
        return quality;
    }

    /** A MotionProgram as IPOPT wants it: the joints, then the inequalities, by the entries that are not fixed. */
    class IpoptProgram : public Ipopt::TNLP
    {
    public:
        using Index = Ipopt::Index;
        using Number = Ipopt::Number;

        explicit IpoptProgram(const MotionProblem &problem) : program_(problem), nodes_(problem.nodes)
        {
            for (std::size_t k = 0; k < nodes_.size(); ++k)
                for (int e = 0; e < NODE_SIZE; ++e)
                    index_.push_back(problem.isFixed(k, e) ? -1 : variables_++);
            for (std::size_t i = 0; i < program_.inequalities(); ++i)
                intervals_.push_back(program_.intervalOf(i));
            for (std::size_t k = 0; k < program_.intervals(); ++k)
                for (int j = 0; j < 4; ++j)
                    addRow(k);
            for (const std::size_t interval : intervals_)
                addRow(interval);
            for (std::size_t k = 0; k < nodes_.size(); ++k)
                for (int e = 0; e < NODE_SIZE; ++e)
                    for (std::size_t m = k > 0 ? k - 1 : 0; m <= k; ++m)
                        for (int f = 0; f < (m < k ? NODE_SIZE : e + 1); ++f)
                            if (at(k, e) >= 0 && at(m, f) >= 0)
                                hessian_.push_back({k, e, m, f});
        }

        const std::vector<NodeVector> &result() const
        {
            return nodes_;
        }

        bool get_nlp_info(Index &n, Index &m, Index &jacobian, Index &hessian, IndexStyleEnum &style) override
        {
            n = variables_;
            m = static_cast<Index>(4 * program_.intervals() + program_.inequalities());
            jacobian = static_cast<Index>(columns_.size());
            hessian = static_cast<Index>(hessian_.size());
            style = C_STYLE;
            return true;
        }
        bool get_bounds_info(Index n, Number *low, Number *high, Index m, Number *least, Number *most) override
        {
            std::fill(low, low + n, -1e20);
            std::fill(high, high + n, 1e20);
            std::fill(least, least + m, 0.0);
            const auto joints = static_cast<Index>(4 * program_.intervals());
            std::fill(most, most + joints, 0.0);
            std::fill(most + joints, most + m, 1e20);
            return true;
        }
        bool get_starting_point(Index, bool, Number *x, bool, Number *, Number *, Index, bool, Number *) override
        {
            for (std::size_t i = 0; i < index_.size(); ++i)
                if (index_[i] >= 0)
                    x[index_[i]] = nodes_[i / NODE_SIZE][static_cast<int>(i % NODE_SIZE)];
            return true;
        }
        bool eval_f(Index, const Number *x, bool isNew, Number &value) override
        {
            evaluate(x, isNew);
            value = cost_;
            return true;
        }
        bool eval_grad_f(Index n, const Number *x, bool isNew, Number *gradient) override
        {
            evaluate(x, isNew);
            linearize(nullptr);
            std::fill(gradient, gradient + n, 0.0);
            for (std::size_t i = 0; i < index_.size(); ++i)
                if (index_[i] >= 0)
                    gradient[index_[i]] = program_.costGradient()[i / NODE_SIZE][static_cast<int>(i % NODE_SIZE)];
            return true;
        }
        bool eval_g(Index, const Number *x, bool isNew, Index, Number *values) override
        {
            evaluate(x, isNew);
            for (const Eigen::Vector4d &joint : joints_)
                for (int j = 0; j < 4; ++j)
                    *values++ = joint[j];
            std::copy(values_.begin(), values_.end(), values);
            return true;
        }
        bool eval_jac_g(Index, const Number *x, bool isNew, Index, Index, Index *rows, Index *columns,
                        Number *values) override
        {
            if (values == nullptr)
            {
                std::copy(rows_.begin(), rows_.end(), rows);
                std::copy(columns_.begin(), columns_.end(), columns);
                return true;
            }
            evaluate(x, isNew);
            linearize(nullptr);
            // One probe for an entry of every third node: no constraint knows two of them.
            std::array<std::vector<Eigen::Vector4d>, COLOURS * NODE_SIZE> joints;
            std::array<std::vector<double>, COLOURS * NODE_SIZE> slopes;
            for (std::size_t c = 0; c < COLOURS * NODE_SIZE; ++c)
            {
                std::vector<NodeVector> step(nodes_.size(), NodeVector::Zero());
                for (std::size_t k = c / NODE_SIZE; k < step.size(); k += COLOURS)
                    if (at(k, static_cast<int>(c % NODE_SIZE)) >= 0)
                        step[k][static_cast<int>(c % NODE_SIZE)] = 1.0;
                program_.apply(step, joints[c], slopes[c]);
            }
            for (std::size_t i = 0; i < columns_.size(); ++i)
            {
                const std::size_t c = (entries_[i] / NODE_SIZE % COLOURS) * NODE_SIZE + entries_[i] % NODE_SIZE;
                const auto row = static_cast<std::size_t>(rows_[i]), all = 4 * program_.intervals();
                values[i] = row < all ? joints[c][row / 4][static_cast<int>(row % 4)] : slopes[c][row - all];
            }
            return true;
        }
        bool eval_h(Index, const Number *x, bool isNew, Number factor, Index, const Number *lambda, bool, Index,
                    Index *rows, Index *columns, Number *values) override
        {
            if (values == nullptr)
            {
                for (const Entry &entry : hessian_)
                {
                    *rows++ = at(entry.k, entry.e);
                    *columns++ = at(entry.m, entry.f);
                }
                return true;
            }
            evaluate(x, isNew);
            linearize(lambda);
            readHessian(values, 1.0);
            if (factor != 1.0)
            {
                std::vector<double> ofCost(hessian_.size(), 0.0);
                linearize(nullptr);
                readHessian(ofCost.data(), factor - 1.0);
                for (std::size_t i = 0; i < ofCost.size(); ++i)
                    values[i] += ofCost[i];
            }
            return true;
        }
        void finalize_solution(Ipopt::SolverReturn, Index, const Number *x, const Number *, const Number *, Index,
                               const Number *, const Number *, Number, const Ipopt::IpoptData *,
                               Ipopt::IpoptCalculatedQuantities *) override
        {
            evaluate(x, true);
        }

    private:
        /** Of the lower triangle: entry e of node k and entry f of node m. */
        struct Entry
        {
            std::size_t k;
            int e;
            std::size_t m;
            int f;
        };

        Index at(std::size_t node, int entry) const
        {
            return index_[node * NODE_SIZE + static_cast<std::size_t>(entry)];
        }
        void addRow(std::size_t interval)
        {
            for (std::size_t i = interval * NODE_SIZE; i < (interval + 2) * NODE_SIZE; ++i)
            {
                if (index_[i] < 0)
                    continue;
                rows_.push_back(constraints_);
                columns_.push_back(index_[i]);
                entries_.push_back(i);
            }
            ++constraints_;
        }
        void evaluate(const Number *x, bool isNew)
        {
            if (!isNew && isEvaluated_)
                return;
            for (std::size_t i = 0; i < index_.size(); ++i)
                if (index_[i] >= 0)
                    nodes_[i / NODE_SIZE][static_cast<int>(i % NODE_SIZE)] = x[index_[i]];
            cost_ = program_.evaluate(nodes_, joints_, values_);
            isEvaluated_ = true;
        }
        /** With the multipliers of IPOPT, or without any. */
        void linearize(const Number *lambda)
        {
            MotionDuals duals;
            duals.joints.assign(program_.intervals(), Eigen::Vector4d::Zero());
            duals.prices.assign(program_.inequalities(), 0.0);
            duals.slacks.assign(program_.inequalities(), WIDE);
            if (lambda != nullptr)
            {
                for (Eigen::Vector4d &joint : duals.joints)
                    for (int j = 0; j < 4; ++j)
                        joint[j] = *lambda++;
                for (double &price : duals.prices)
                    price = -*lambda++;
            }
            program_.linearize(duals, 0.0, WIDE);
        }
        void readHessian(double *values, double factor)
        {
            for (const Entry &entry : hessian_)
                *values++ = factor * (entry.m == entry.k ? program_.system().diagonal[entry.k](entry.e, entry.f)
                                                         : program_.system().below[entry.m](entry.e, entry.f));
        }

        MotionProgram program_;
        std::vector<NodeVector> nodes_;
        Index variables_{0}, constraints_{0};
        std::vector<Index> index_;            // per entry of the nodes: its variable, -1 when it is fixed
        std::vector<std::size_t> intervals_;  // per inequality
        std::vector<Index> rows_, columns_;   // of the Jacobian
        std::vector<std::size_t> entries_;    // likewise
        std::vector<Entry> hessian_;
        bool isEvaluated_{false};
        double cost_{0.0};
        std::vector<Eigen::Vector4d> joints_;
        std::vector<double> values_;
    };

    void compare(const std::string &file)
    {
        const Scenario scenario = readScenario(file, {});
        const ScenarioPlanner planner(scenario);
        const ScenarioPlan plan = planner.plan({});
        if (!plan.hasPath())
            throw Error("no path");
        const MotionProblem problem = problemOf(planner.footprint(), plan.path);
        MotionProgram program(problem);
        const double begin = cpuMilliseconds();
        const InteriorPointResult own = solveMotion(program, {}, {});
        const double middle = cpuMilliseconds();
        const Ipopt::SmartPtr<IpoptProgram> other = new IpoptProgram(problem);
        const Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = new Ipopt::IpoptApplication();
        ipopt->Options()->SetIntegerValue("print_level", 0);
        ipopt->Options()->SetStringValue("sb", "yes");
        ipopt->Options()->SetNumericValue("mu_init", InteriorPointOptions().firstBarrier);
        ipopt->Options()->SetNumericValue("tol", 1e-5);
        ipopt->Options()->SetNumericValue("constr_viol_tol", InteriorPointOptions().jointTolerance);
        ipopt->Options()->SetNumericValue("bound_relax_factor", 0.0);
        ipopt->Options()->SetIntegerValue("max_iter", 1000);
        ipopt->Initialize();
        const double before = cpuMilliseconds();
        const Ipopt::ApplicationReturnStatus status = ipopt->OptimizeTNLP(other);
        const double end = cpuMilliseconds();
        const Quality a = qualityOf(program, own.nodes), b = qualityOf(program, other->result());
        const bool solved = status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level;
        std::printf("| %s | %zu | %zu | %.2f%s | %zu | %.1f | %.0e | %.2f%s | %d | %.1f | %.0e |\n",
                    scenario.name.c_str(), problem.nodes.size(), program.inequalities(), a.duration,
                    own.status == InteriorPointStatus::Converged ? "" : " (not converged)", own.iterations,
                    middle - begin, a.violation, b.duration, solved ? "" : " (not converged)",
                    Ipopt::IsValid(ipopt->Statistics()) ? ipopt->Statistics()->IterationCount() : -1, end - before,
                    b.violation);
        std::fflush(stdout);
    }
}  // namespace

int main(int argc, char **argv)
{
    const std::vector<std::string> files(argv + 1, argv + argc);
    if (files.empty() || files.front() == "--help")
    {
        std::cerr
            << "usage: trajectory_solvers SCENARIO...\nOne nonlinear program per scenario, solved by the project's "
               "interior point method and by IPOPT.\n";
        return files.empty() ? 2 : 0;
    }
    std::printf(
        "| problem | nodes | inequalities | own, s | iterations | ms | violation | IPOPT, s | iterations | ms | "
        "violation |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    int failed = 0;
    for (const std::string &file : files)
        try
        {
            compare(file);
        }
        catch (const std::exception &error)
        {
            std::cerr << "trajectory_solvers: " << file << ": " << error.what() << '\n';
            failed = 2;
        }
    return failed;
}
