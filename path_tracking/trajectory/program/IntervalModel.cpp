#include "path_tracking/trajectory/program/IntervalModel.h"

#include <cmath>

namespace parking
{
    namespace
    {
        /** Entries of a pair of nodes. */
        constexpr int H = NODE_DURATION;
        constexpr int SECOND = NODE_SIZE;
        constexpr int V0 = NODE_SPEED, V1 = SECOND + NODE_SPEED;
        constexpr int YAW0 = NODE_YAW, YAW1 = SECOND + NODE_YAW;
        constexpr int PHI0 = NODE_STEERING, PHI1 = SECOND + NODE_STEERING;

        /** The angle entry of the way of x, y or yaw at the first node. */
        int angleOf(int e)
        {
            return e < 2 ? YAW0 : PHI0;
        }
    }  // namespace

    NodeAngles::NodeAngles(const NodeVector &node)
      : cosine(std::cos(node[NODE_YAW])),
        sine(std::sin(node[NODE_YAW])),
        tangent(std::tan(node[NODE_STEERING]))
    {
    }

    Eigen::Vector4d hermiteWeights(double t)
    {
        const double t2 = t * t, t3 = t2 * t;
        return {1.0 - 3.0 * t2 + 2.0 * t3, t - 2.0 * t2 + t3, 3.0 * t2 - 2.0 * t3, t3 - t2};
    }

    void SpanTerms::add(const Eigen::Vector4d &w, const Eigen::Matrix3d &poseHessian,
                        const Eigen::Vector3d &poseGradient, const Eigen::Vector3d &poseShift,
                        const Eigen::Vector3d &poseBarrierSlope, const Eigen::Vector3d &poseCost)
    {
        const Eigen::Matrix4d square = w * w.transpose();
        for (int e = 0; e < 3; ++e)
        {
            gradient.segment<4>(4 * e) += poseGradient[e] * w;
            shift.segment<4>(4 * e) += poseShift[e] * w;
            barrierSlope.segment<4>(4 * e) += poseBarrierSlope[e] * w;
            cost.segment<4>(4 * e) += poseCost[e] * w;
            for (int f = 0; f <= e; ++f)
                hessian.block<4, 4>(4 * e, 4 * f) += poseHessian(e, f) * square;
        }
    }

    void SpanTerms::complete()
    {
        hessian.block<4, 4>(0, 4) = hessian.block<4, 4>(4, 0).transpose();
        hessian.block<4, 4>(0, 8) = hessian.block<4, 4>(8, 0).transpose();
        hessian.block<4, 4>(4, 8) = hessian.block<4, 4>(8, 4).transpose();
    }

    IntervalModel::IntervalModel(int direction, double wheelbase, const NodeVector &begin, const NodeVector &end)
      : IntervalModel(direction, wheelbase, begin, end, NodeAngles(begin), NodeAngles(end))
    {
    }

    IntervalModel::IntervalModel(int direction, double wheelbase, const NodeVector &begin, const NodeVector &end,
                                 const NodeAngles &atBegin, const NodeAngles &atEnd)
      : direction_(direction),
        wheelbase_(wheelbase),
        duration_(begin[NODE_DURATION]),
        a_(begin),
        b_(end),
        atBegin_(atBegin),
        atEnd_(atEnd),
        begin_(wayOf(begin, atBegin)),
        end_(wayOf(end, atEnd)),
        speed_(0.5 * (begin[NODE_SPEED] + end[NODE_SPEED])),
        steering_(0.5 * (begin[NODE_STEERING] + end[NODE_STEERING])),
        yaw_(0.5 * (begin[NODE_YAW] + end[NODE_YAW]) + (begin_.way[2] - end_.way[2]) / 8.0),
        cosine_(std::cos(yaw_)),
        sine_(std::sin(yaw_)),
        tangent_(std::tan(steering_))
    {
    }

    IntervalModel::Way IntervalModel::wayOf(const NodeVector &node, const NodeAngles &angles) const
    {
        const double c = angles.cosine, s = angles.sine, t = angles.tangent;
        const Eigen::Vector3d towards(c, s, t / wheelbase_), turned(-s, c, (1.0 + t * t) / wheelbase_);
        const double v = node[NODE_SPEED], way = direction_ * duration_ * v;
        return {way * towards, direction_ * v * towards, direction_ * duration_ * towards, way * turned};
    }

    Eigen::Vector3d IntervalModel::gaps() const
    {
        const double way = direction_ * duration_ * speed_;
        const Eigen::Vector3d middle(way * cosine_, way * sine_, way * tangent_ / wheelbase_);
        return b_.head<3>() - a_.head<3>() - (begin_.way + 4.0 * middle + end_.way) / 6.0;
    }

    PairVector IntervalModel::yawRow() const
    {
        PairVector row = PairVector::Zero();
        row[YAW0] = row[YAW1] = 0.5;
        row[H] = (begin_.byDuration[2] - end_.byDuration[2]) / 8.0;
        row[V0] = begin_.bySpeed[2] / 8.0;
        row[V1] = -end_.bySpeed[2] / 8.0;
        row[PHI0] = begin_.byAngle[2] / 8.0;
        row[PHI1] = -end_.byAngle[2] / 8.0;
        return row;
    }

    GapRows IntervalModel::gapRows() const
    {
        GapRows rows = GapRows::Zero();
        const Eigen::Vector3d towards(cosine_, sine_, tangent_ / wheelbase_);
        const double d = direction_, h = duration_, v = speed_;
        for (int e = 0; e < 3; ++e)
        {
            rows(e, e) = -1.0;
            rows(e, SECOND + e) = 1.0;
            rows(e, H) = -(begin_.byDuration[e] + end_.byDuration[e] + 4.0 * d * v * towards[e]) / 6.0;
            rows(e, V0) = -(begin_.bySpeed[e] + 2.0 * d * h * towards[e]) / 6.0;
            rows(e, V1) = -(end_.bySpeed[e] + 2.0 * d * h * towards[e]) / 6.0;
            rows(e, angleOf(e)) -= begin_.byAngle[e] / 6.0;
            rows(e, SECOND + angleOf(e)) -= end_.byAngle[e] / 6.0;
        }
        const PairVector yaw = yawRow();
        rows.row(0) += 4.0 / 6.0 * d * h * v * sine_ * yaw.transpose();
        rows.row(1) -= 4.0 / 6.0 * d * h * v * cosine_ * yaw.transpose();
        const double slope = (1.0 + tangent_ * tangent_) / wheelbase_;
        rows(2, PHI0) -= 2.0 / 6.0 * d * h * v * slope;
        rows(2, PHI1) -= 2.0 / 6.0 * d * h * v * slope;
        return rows;
    }

    void IntervalModel::addGapCurvature(const Eigen::Vector3d &prices, IntervalTerms &terms) const
    {
        if (direction_ == 0.0)
            return;
        const double h = duration_, v = speed_;
        const Eigen::Vector3d m = -4.0 / 6.0 * direction_ * prices;
        const double along = m[0] * cosine_ + m[1] * sine_, across = m[1] * cosine_ - m[0] * sine_;
        const double turning = m[2] * tangent_ / wheelbase_;
        const double turning1 = m[2] * (1.0 + tangent_ * tangent_) / wheelbase_;
        const double turning2 = 2.0 * turning1 * tangent_;
        // The derivatives couple seven entries: the yaw in the middle depends on all of them, speed and steering there
        // on two each.
        enum
        {
            D,
            SPEED0,
            SPEED1,
            YAW_0,
            YAW_1,
            STEER0,
            STEER1
        };
        constexpr std::array<int, 7> ENTRIES{H, V0, V1, YAW0, YAW1, PHI0, PHI1};
        const PairVector row = yawRow();
        std::array<double, 7> yaw{}, byYaw{}, bySteering{};
        for (std::size_t i = 0; i < ENTRIES.size(); ++i)
        {
            yaw[i] = row[ENTRIES[i]];
            byYaw[i] = -0.5 * h * v * along * yaw[i];
        }
        byYaw[D] += v * across;
        byYaw[SPEED0] += 0.5 * h * across;
        byYaw[SPEED1] += 0.5 * h * across;
        bySteering[D] = v * turning1;
        bySteering[SPEED0] = bySteering[SPEED1] = 0.5 * h * turning1;
        bySteering[STEER0] = bySteering[STEER1] = 0.25 * h * v * turning2;
        const double bySpeed = along + turning;
        std::array<std::array<double, 7>, 7> half;
        for (std::size_t i = 0; i < ENTRIES.size(); ++i)
        {
            for (std::size_t k = 0; k < ENTRIES.size(); ++k)
                half[i][k] = byYaw[i] * yaw[k];
            half[i][STEER0] += 0.5 * bySteering[i];
            half[i][STEER1] += 0.5 * bySteering[i];
        }
        half[D][SPEED0] += 0.5 * bySpeed;
        half[D][SPEED1] += 0.5 * bySpeed;
        for (std::size_t i = 0; i < ENTRIES.size(); ++i)
            for (std::size_t k = 0; k < ENTRIES.size(); ++k)
                terms.hessian(ENTRIES[i], ENTRIES[k]) += half[i][k] + half[k][i];
        terms.wayAtBegin -= prices / 6.0;
        terms.wayAtEnd -= prices / 6.0;
        // The yaw in the middle depends on the ways, too.
        terms.wayAtBegin[2] += h * v * across / 8.0;
        terms.wayAtEnd[2] -= h * v * across / 8.0;
    }

    Eigen::Vector3d IntervalModel::poseAt(const Eigen::Vector4d &w) const
    {
        return w[0] * a_.head<3>() + w[1] * begin_.way + w[2] * b_.head<3>() + w[3] * end_.way;
    }

    Eigen::Vector3d IntervalModel::poseStep(const Eigen::Vector4d &w, const PairVector &step) const
    {
        const Eigen::Vector3d angles0(step[YAW0], step[YAW0], step[PHI0]), angles1(step[YAW1], step[YAW1], step[PHI1]);
        const Eigen::Vector3d begin =
            begin_.byDuration * step[H] + begin_.bySpeed * step[V0] + begin_.byAngle.cwiseProduct(angles0);
        const Eigen::Vector3d end =
            end_.byDuration * step[H] + end_.bySpeed * step[V1] + end_.byAngle.cwiseProduct(angles1);
        return w[0] * step.head<3>() + w[1] * begin + w[2] * step.segment<3>(SECOND) + w[3] * end;
    }

    void IntervalModel::addSpan(const SpanTerms &span, IntervalTerms &terms) const
    {
        /** A derivative of a quantity of the span by an entry of the nodes. Few of them are nonzero. */
        struct Derivative
        {
            int quantity, entry;
            double value;
        };
        std::array<Derivative, 24> chain;
        for (int e = 0; e < 3; ++e)
        {
            Derivative *next = &chain[static_cast<std::size_t>(8 * e)];
            *next++ = {4 * e, e, 1.0};
            *next++ = {4 * e + 1, H, begin_.byDuration[e]};
            *next++ = {4 * e + 1, V0, begin_.bySpeed[e]};
            *next++ = {4 * e + 1, angleOf(e), begin_.byAngle[e]};
            *next++ = {4 * e + 2, SECOND + e, 1.0};
            *next++ = {4 * e + 3, H, end_.byDuration[e]};
            *next++ = {4 * e + 3, V1, end_.bySpeed[e]};
            *next = {4 * e + 3, SECOND + angleOf(e), end_.byAngle[e]};
            terms.wayAtBegin[e] += span.gradient[4 * e + 1] + span.cost[4 * e + 1];
            terms.wayAtEnd[e] += span.gradient[4 * e + 3] + span.cost[4 * e + 3];
        }
        Eigen::Matrix<double, 12, PAIR_SIZE> half = Eigen::Matrix<double, 12, PAIR_SIZE>::Zero();
        for (const Derivative &by : chain)
        {
            half.col(by.entry) += by.value * span.hessian.col(by.quantity);
            terms.gradient[by.entry] += by.value * span.gradient[by.quantity];
            terms.shift[by.entry] += by.value * span.shift[by.quantity];
            terms.barrierSlope[by.entry] += by.value * span.barrierSlope[by.quantity];
            terms.cost[by.entry] += by.value * span.cost[by.quantity];
        }
        for (const Derivative &by : chain)
            terms.hessian.col(by.entry) += by.value * half.row(by.quantity).transpose();
    }

    void IntervalModel::addWayCurvature(IntervalTerms &terms) const
    {
        if (direction_ == 0.0)
            return;
        const double d = direction_, h = duration_;
        for (const bool begin : {true, false})
        {
            const Eigen::Vector3d &m = begin ? terms.wayAtBegin : terms.wayAtEnd;
            const NodeVector &node = begin ? a_ : b_;
            const int first = begin ? 0 : SECOND, yaw = first + NODE_YAW, v = first + NODE_SPEED;
            const int phi = first + NODE_STEERING;
            const NodeAngles &angles = begin ? atBegin_ : atEnd_;
            const double c = angles.cosine, s = angles.sine, t = angles.tangent;
            const double along = d * (m[0] * c + m[1] * s), across = d * (m[1] * c - m[0] * s);
            const double turning1 = d * m[2] * (1.0 + t * t) / wheelbase_, speed = node[NODE_SPEED];
            terms.couple(H, v, along + d * m[2] * t / wheelbase_);
            terms.couple(H, yaw, speed * across);
            terms.couple(v, yaw, h * across);
            terms.hessian(yaw, yaw) -= h * speed * along;
            terms.couple(H, phi, speed * turning1);
            terms.couple(v, phi, h * turning1);
            terms.hessian(phi, phi) += h * speed * 2.0 * turning1 * t;
        }
    }

    double IntervalModel::cost(const MotionWeights &w) const
    {
        const double phi0 = a_[NODE_STEERING], phi1 = b_[NODE_STEERING], v0 = a_[NODE_SPEED], v1 = b_[NODE_SPEED];
        const double cost = duration_ * (w.time + w.steering * (phi0 * phi0 + phi0 * phi1 + phi1 * phi1) / 3.0);
        if (direction_ == 0.0)
            return cost;
        const double dv = v1 - v0, dphi = phi1 - phi0;
        return cost + w.effort * (dv * dv + (v0 * v0 + v0 * v1 + v1 * v1) / 3.0 * dphi * dphi) / duration_;
    }

    void IntervalModel::addCost(const MotionWeights &w, IntervalTerms &terms) const
    {
        const double phi0 = a_[NODE_STEERING], phi1 = b_[NODE_STEERING];
        terms.cost[H] += w.time + w.steering * (phi0 * phi0 + phi0 * phi1 + phi1 * phi1) / 3.0;
        if (w.steering > 0.0)
        {
            const double by0 = w.steering * (2.0 * phi0 + phi1) / 3.0, by1 = w.steering * (phi0 + 2.0 * phi1) / 3.0;
            terms.cost[PHI0] += duration_ * by0;
            terms.cost[PHI1] += duration_ * by1;
            terms.couple(H, PHI0, by0);
            terms.couple(H, PHI1, by1);
            terms.hessian(PHI0, PHI0) += w.steering * duration_ * 2.0 / 3.0;
            terms.hessian(PHI1, PHI1) += w.steering * duration_ * 2.0 / 3.0;
            terms.couple(PHI0, PHI1, w.steering * duration_ / 3.0);
        }
        if (w.effort > 0.0 && direction_ != 0.0)
            addEffort(w.effort, terms);
    }

    void IntervalModel::addEffort(double weight, IntervalTerms &terms) const
    {
        // e (dv^2 + q dphi^2), where q is the mean square of the speed.
        const double v0 = a_[NODE_SPEED], v1 = b_[NODE_SPEED], dv = v1 - v0;
        const double dphi = b_[NODE_STEERING] - a_[NODE_STEERING], square = dphi * dphi, h = duration_;
        const double e = weight / h;
        const double q = (v0 * v0 + v0 * v1 + v1 * v1) / 3.0, q0 = (2.0 * v0 + v1) / 3.0, q1 = (v0 + 2.0 * v1) / 3.0;
        const double total = dv * dv + q * square;
        const std::array<int, 4> entry{V0, V1, PHI0, PHI1};
        const std::array<double, 4> slope{-2.0 * dv + q0 * square, 2.0 * dv + q1 * square, -2.0 * q * dphi,
                                          2.0 * q * dphi};
        for (std::size_t i = 0; i < 4; ++i)
        {
            terms.cost[entry[i]] += e * slope[i];
            terms.couple(H, entry[i], -e * slope[i] / h);
        }
        terms.cost[H] -= e * total / h;
        terms.hessian(H, H) += 2.0 * e * total / (h * h);
        terms.hessian(V0, V0) += e * (2.0 + 2.0 / 3.0 * square);
        terms.hessian(V1, V1) += e * (2.0 + 2.0 / 3.0 * square);
        terms.couple(V0, V1, e * (-2.0 + square / 3.0));
        terms.hessian(PHI0, PHI0) += 2.0 * e * q;
        terms.hessian(PHI1, PHI1) += 2.0 * e * q;
        terms.couple(PHI0, PHI1, -2.0 * e * q);
        terms.couple(V0, PHI0, -2.0 * e * q0 * dphi);
        terms.couple(V0, PHI1, 2.0 * e * q0 * dphi);
        terms.couple(V1, PHI0, -2.0 * e * q1 * dphi);
        terms.couple(V1, PHI1, 2.0 * e * q1 * dphi);
    }
}  // namespace parking
