#include "path_tracking/trajectory/program/MotionProgram.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr int SECOND = NODE_SIZE;

        PairVector pairOf(const std::vector<NodeVector> &nodes, std::size_t interval)
        {
            PairVector pair;
            pair << nodes[interval], nodes[interval + 1];
            return pair;
        }

        /** The gradient of a row by x, y and yaw; adds its second derivatives, \e price times, to \e curvature. */
        Eigen::Vector3d derive(const BodyRow &row, const Eigen::Vector3d &pose, double c, double s, double price,
                               Eigen::Matrix3d &curvature)
        {
            const double nx = row.normal.x(), ny = row.normal.y();
            if (!row.ofBody)
            {
                const double px = c * row.point.x() - s * row.point.y(), py = s * row.point.x() + c * row.point.y();
                curvature(2, 2) -= price * (nx * px + ny * py);
                return {nx, ny, ny * px - nx * py};
            }
            const double dx = row.point.x() - pose[0], dy = row.point.y() - pose[1];
            const double wx = c * nx - s * ny, wy = s * nx + c * ny;
            curvature(2, 2) -= price * (wx * dx + wy * dy);
            curvature(0, 2) += price * wy;
            curvature(2, 0) += price * wy;
            curvature(1, 2) -= price * wx;
            curvature(2, 1) -= price * wx;
            return {-wx, -wy, wx * dy - wy * dx};
        }
    }  // namespace

    MotionProgram::MotionProgram(MotionProblem problem) : problem_(std::move(problem))
    {
        for (std::size_t k = 0; k < intervals(); ++k)
        {
            firstLimit_.push_back(limits_.size());
            addLimits(k);
        }
        firstLimit_.push_back(limits_.size());
        for (std::size_t k = 0, p = 0; k <= intervals(); ++k)
        {
            while (p < problem_.checkpoints.size() && problem_.checkpoints[p].interval < k)
                ++p;
            firstCheckpoint_.push_back(p);
        }
        for (const MotionCheckpoint &point : problem_.checkpoints)
            weights_.push_back(hermiteWeights(point.fraction));
        poses_.resize(problem_.checkpoints.size());
        jointRows_.resize(intervals());
        rowGradients_.resize(problem_.rows.size());
    }

    void MotionProgram::addNodeLimits(std::size_t node, int first)
    {
        const int v = first + NODE_SPEED, phi = first + NODE_STEERING;
        const std::array<double, 3> up{1.0, 0.0, 0.0}, down{-1.0, 0.0, 0.0};
        if (!problem_.isFixed(node, NODE_SPEED))
        {
            limits_.push_back({{v, v, v}, up, 0.0});
            limits_.push_back({{v, v, v}, down, problem_.vehicle.maxSpeed});
        }
        if (!problem_.isFixed(node, NODE_STEERING))
        {
            limits_.push_back({{phi, phi, phi}, up, problem_.vehicle.maxSteeringAngle});
            limits_.push_back({{phi, phi, phi}, down, problem_.vehicle.maxSteeringAngle});
        }
    }

    void MotionProgram::addLimits(std::size_t k)
    {
        constexpr int H = NODE_DURATION;
        const Vehicle &car = problem_.vehicle;
        const bool drives = problem_.directions[k] != 0;
        addNodeLimits(k, 0);
        if (k + 1 == intervals())
            addNodeLimits(k + 1, SECOND);
        for (const double sign : {1.0, -1.0})
        {
            limits_.push_back({{H, NODE_STEERING, SECOND + NODE_STEERING}, {car.maxSteeringRate, sign, -sign}, 0.0});
            if (drives)
                limits_.push_back({{H, NODE_SPEED, SECOND + NODE_SPEED}, {car.maxAcceleration, sign, -sign}, 0.0});
        }
        if (drives && (k == 0 || !problem_.sharesDuration(k - 1)))
            limits_.push_back({{H, H, H}, {1.0, 0.0, 0.0}, -problem_.minDuration});
    }

    Eigen::Vector4d MotionProgram::jointsOf(const IntervalModel &model, const std::vector<NodeVector> &nodes,
                                            std::size_t k) const
    {
        Eigen::Vector4d joints;
        joints << model.gaps(),
            problem_.sharesDuration(k) ? nodes[k + 1][NODE_DURATION] - nodes[k][NODE_DURATION] : 0.0;
        if (!problem_.corrections.empty())
            joints.head<3>() -= problem_.corrections[k];
        return joints;
    }

    double MotionProgram::evaluate(const std::vector<NodeVector> &nodes, std::vector<Eigen::Vector4d> &joints,
                                   std::vector<double> &values)
    {
        double cost = 0.0;
        joints_.resize(intervals());
        values_.resize(inequalities());
        angles_.clear();
        for (const NodeVector &node : nodes)
            angles_.emplace_back(node);
        models_.clear();
        for (std::size_t k = 0; k < intervals(); ++k)
        {
            const IntervalModel &interval = models_.emplace_back(problem_.directions[k], problem_.vehicle.wheelbase,
                                                                 nodes[k], nodes[k + 1], angles_[k], angles_[k + 1]);
            cost += interval.cost(problem_.weights);
            joints_[k] = jointsOf(interval, nodes, k);
            const PairVector pair = pairOf(nodes, k);
            for (std::size_t i = firstLimit_[k]; i < firstLimit_[k + 1]; ++i)
                values_[i] = limits_[i].slope(pair) + limits_[i].constant;
            for (std::size_t p = firstCheckpoint_[k]; p < firstCheckpoint_[k + 1]; ++p)
            {
                const MotionCheckpoint &point = problem_.checkpoints[p];
                const Eigen::Vector3d pose = interval.poseAt(weights_[p]);
                const double c = std::cos(pose[2]), s = std::sin(pose[2]);
                poses_[p] = {pose, c, s};
                for (std::size_t r = point.firstRow; r < point.lastRow; ++r)
                {
                    const double value = problem_.rows[r].value(pose[0], pose[1], c, s);
                    values_[limits_.size() + r] = value;
                    cost += 0.5 * nearnessOf(point, value).price * (problem_.clearance - value);
                }
            }
        }
        joints = joints_;
        values = values_;
        return cost;
    }

    void MotionProgram::addJoints(std::size_t k, const MotionDuals &duals, double softness, IntervalTerms &terms)
    {
        const IntervalModel &model = models_[k];
        const Eigen::Vector4d &prices = duals.joints[k];
        JointRows &rows = jointRows_[k];
        rows.topRows<3>() = model.gapRows();
        rows.row(3).setZero();
        if (problem_.sharesDuration(k))
        {
            rows(3, NODE_DURATION) = -1.0;
            rows(3, SECOND + NODE_DURATION) = 1.0;
        }
        // Fixed entries are not variables.
        for (int e = 0; e < NODE_SIZE; ++e)
        {
            if (problem_.isFixed(k, e))
                rows.col(e).setZero();
            if (problem_.isFixed(k + 1, e))
                rows.col(SECOND + e).setZero();
        }
        model.addGapCurvature(prices.head<3>(), terms);
        terms.gradient += rows.transpose() * prices;
        terms.shift -= rows.transpose() * (joints_[k] / softness);
        terms.hessian += rows.transpose().lazyProduct(rows) / softness;
    }

    void MotionProgram::addLimitTerms(std::size_t k, const MotionDuals &duals, IntervalTerms &terms) const
    {
        for (std::size_t i = firstLimit_[k]; i < firstLimit_[k + 1]; ++i)
        {
            const Limit &limit = limits_[i];
            const double z = duals.prices[i], s = duals.slacks[i], sigma = z / s;
            const double shift = -sigma * (values_[i] - s) - z;
            for (std::size_t p = 0; p < 3; ++p)
            {
                if (limit.coefficient[p] == 0.0)
                    continue;
                terms.gradient[limit.entry[p]] -= z * limit.coefficient[p];
                terms.shift[limit.entry[p]] += shift * limit.coefficient[p];
                terms.barrierSlope[limit.entry[p]] += limit.coefficient[p] / s;
                for (std::size_t q = 0; q < 3; ++q)
                    terms.hessian(limit.entry[p], limit.entry[q]) +=
                        sigma * limit.coefficient[p] * limit.coefficient[q];
            }
        }
    }

    MotionProgram::Nearness MotionProgram::nearnessOf(const MotionCheckpoint &point, double value) const
    {
        if (problem_.weights.nearness == 0.0 || value >= problem_.clearance)
            return {};
        const double growth = 2.0 * problem_.weights.nearness * point.way / (problem_.clearance * problem_.clearance);
        return {growth * (problem_.clearance - value), growth};
    }

    void MotionProgram::addRowTerms(std::size_t k, const MotionDuals &duals, IntervalTerms &terms)
    {
        if (firstCheckpoint_[k] == firstCheckpoint_[k + 1])
            return;
        SpanTerms span;
        for (std::size_t p = firstCheckpoint_[k]; p < firstCheckpoint_[k + 1]; ++p)
        {
            const MotionCheckpoint &point = problem_.checkpoints[p];
            const auto &[pose, c, s] = poses_[p];
            Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
            Eigen::Vector3d gradient = Eigen::Vector3d::Zero(), shift = gradient, slope = gradient, cost = gradient;
            for (std::size_t r = point.firstRow; r < point.lastRow; ++r)
            {
                const std::size_t i = limits_.size() + r;
                const double z = duals.prices[i], slack = duals.slacks[i], sigma = z / slack;
                const double value = values_[i];
                const Nearness near = nearnessOf(point, value);
                const Eigen::Vector3d g = derive(problem_.rows[r], pose, c, s, -z - near.price, hessian);
                rowGradients_[r] = g;
                hessian.noalias() += (sigma + near.growth) * g * g.transpose();
                gradient -= z * g;
                cost -= near.price * g;
                shift -= (sigma * (value - slack) + z) * g;
                slope += g / slack;
            }
            span.add(weights_[p], hessian, gradient, shift, slope, cost);
        }
        span.complete();
        models_[k].addSpan(span, terms);
    }

    void MotionProgram::scatter(std::size_t k, const IntervalTerms &terms)
    {
        system_.diagonal[k] += terms.hessian.topLeftCorner<NODE_SIZE, NODE_SIZE>();
        system_.diagonal[k + 1] += terms.hessian.bottomRightCorner<NODE_SIZE, NODE_SIZE>();
        system_.below[k] += terms.hessian.bottomLeftCorner<NODE_SIZE, NODE_SIZE>();
        costGradient_[k] += terms.cost.head<NODE_SIZE>();
        costGradient_[k + 1] += terms.cost.tail<NODE_SIZE>();
        const PairVector lagrange = terms.gradient + terms.cost, right = terms.shift - lagrange;
        gradient_[k] += lagrange.head<NODE_SIZE>();
        gradient_[k + 1] += lagrange.tail<NODE_SIZE>();
        right_[k] += right.head<NODE_SIZE>();
        right_[k + 1] += right.tail<NODE_SIZE>();
        barrierSlope_[k] += terms.barrierSlope.head<NODE_SIZE>();
        barrierSlope_[k + 1] += terms.barrierSlope.tail<NODE_SIZE>();
    }

    void MotionProgram::applyFixed()
    {
        for (std::size_t k = 0; k < problem_.nodes.size(); ++k)
            for (int e = 0; e < NODE_SIZE; ++e)
            {
                if (!problem_.isFixed(k, e))
                    continue;
                system_.diagonal[k].row(e).setZero();
                system_.diagonal[k].col(e).setZero();
                system_.diagonal[k](e, e) = 1.0;
                if (k > 0)
                    system_.below[k - 1].row(e).setZero();
                if (k + 1 < problem_.nodes.size())
                    system_.below[k].col(e).setZero();
                right_[k][e] = barrierSlope_[k][e] = gradient_[k][e] = costGradient_[k][e] = 0.0;
            }
    }

    void MotionProgram::linearize(const MotionDuals &duals, double softness)
    {
        const std::size_t nodes = intervals() + 1;
        system_.reset(nodes);
        right_.assign(nodes, NodeVector::Zero());
        barrierSlope_ = gradient_ = costGradient_ = right_;
        for (std::size_t k = 0; k < intervals(); ++k)
        {
            IntervalTerms terms;
            models_[k].addCost(problem_.weights, terms);
            addJoints(k, duals, softness, terms);
            addLimitTerms(k, duals, terms);
            addRowTerms(k, duals, terms);
            models_[k].addWayCurvature(terms);
            scatter(k, terms);
        }
        applyFixed();
    }

    std::vector<NodeVector> MotionProgram::right(double barrier) const
    {
        std::vector<NodeVector> right = right_;
        for (std::size_t k = 0; k < right.size(); ++k)
            right[k] += barrier * barrierSlope_[k];
        return right;
    }

    void MotionProgram::apply(const std::vector<NodeVector> &step, std::vector<Eigen::Vector4d> &joints,
                              std::vector<double> &values) const
    {
        joints.resize(intervals());
        values.resize(inequalities());
        for (std::size_t k = 0; k < intervals(); ++k)
        {
            const PairVector pair = pairOf(step, k);
            joints[k] = jointRows_[k] * pair;
            for (std::size_t i = firstLimit_[k]; i < firstLimit_[k + 1]; ++i)
                values[i] = limits_[i].slope(pair);
            for (std::size_t p = firstCheckpoint_[k]; p < firstCheckpoint_[k + 1]; ++p)
            {
                const MotionCheckpoint &point = problem_.checkpoints[p];
                const Eigen::Vector3d moved = models_[k].poseStep(weights_[p], pair);
                for (std::size_t r = point.firstRow; r < point.lastRow; ++r)
                    values[limits_.size() + r] = rowGradients_[r].dot(moved);
            }
        }
    }
}  // namespace parking
