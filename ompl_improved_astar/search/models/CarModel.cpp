#include "ompl_improved_astar/search/models/CarModel.h"

#include "ompl_improved_astar/search/models/CurveCheck.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace parking::search
{
    namespace
    {
        /** Changes of direction of the whole path by way of a curve. */
        unsigned int cuspsThrough(const Node &fromStart, const ReedsSheppCurve &curve, const Node &fromGoal)
        {
            unsigned int cusps = fromStart.cusps + fromGoal.cusps;
            double last = fromStart.motion.length;
            const auto drive = [&](double length)
            {
                if (length == 0.0)
                    return;
                cusps += last * length < 0.0 ? 1 : 0;
                last = length;
            };
            for (std::size_t i = 0; i < curve.count; ++i)
                drive(curve.pieces[i].length);
            drive(-fromGoal.motion.length);  // the car will drive it the other way
            return cusps;
        }
    }  // namespace

    void CarModel::begin(MotionEnvironment &environment, const SearchParameters &parameters)
    {
        environment_ = &environment;
        parameters_ = &parameters;
        const SearchTuning &tuning = parameters.tuning;
        const double radius = parameters.turningRadius;
        curves_ = ReedsShepp(radius, parameters.forwardOnly ? CurveFamily::Dubins : CurveFamily::ReedsShepp);
        reach_ = tuning.reach * radius;
        shortest_ = tuning.shortestMotion * radius;
        // Cells are in proportion to the steps: so wide for a step of a third of the radius.
        const double cell = parameters.xyResolution > 0.0 ? parameters.xyResolution : tuning.cell * radius;
        for (std::size_t level = 0; level < LEVELS; ++level)
        {
            steps_[level] = tuning.coarsestStep * radius * std::pow(0.5, static_cast<double>(level));
            const double scale = 3.0 * steps_[level] / radius;
            inverseCell_[level] = 1.0 / (cell * scale);
            headingScale_[level] = std::max(8.0, parameters.headingBins / scale) / (2.0 * PI);
        }
        for (std::vector<Known> &each : known_)
            each.clear();
    }

    ModelTraits CarModel::traits() const
    {
        ModelTraits traits;
        traits.levels = LEVELS;
        traits.reach = reach_;
        traits.joinsAfar = true;
        traits.prefersClearance = true;
        traits.otherSidePeriod = parameters_ != nullptr ? parameters_->tuning.otherSidePeriod : 1;
        return traits;
    }

    std::uint64_t CarModel::cell(const Pose &pose, std::size_t level) const
    {
        const double bins = headingScale_[level] * 2.0 * PI;
        const auto column = static_cast<std::int64_t>(std::floor(pose.x * inverseCell_[level]));
        const auto row = static_cast<std::int64_t>(std::floor(pose.y * inverseCell_[level]));
        const double turn = (wrapAngle(pose.yaw) + PI) * headingScale_[level];
        const auto heading = static_cast<std::int64_t>(turn < bins ? turn : 0.0);
        // 22 bits of column and row (tens of kilometres of the finest cells), 17 of heading.
        return ((static_cast<std::uint64_t>(column) & 0x3fffff) << 39) |
               ((static_cast<std::uint64_t>(row) & 0x3fffff) << 17) | (static_cast<std::uint64_t>(heading) & 0x1ffff);
    }

    double CarModel::worthKeeping(std::size_t level) const
    {
        return parameters_->tuning.worthKeeping * steps_[level];
    }

    double CarModel::mobility(const Pose &root)
    {
        motions_.clear();
        for (const double steer : {-1.0, 0.0, 1.0})
            for (const double gear : {-1.0, 1.0})
                motions_.push_back({steer / parameters_->turningRadius, gear * steps_[0]});
        free_.resize(motions_.size());
        environment_->freeLengths(root, motions_.data(), motions_.size(), free_.data());
        return std::accumulate(free_.begin(), free_.end(), 0.0);
    }

    void CarModel::collectMotions(Side side, const Node &node)
    {
        motions_.clear();
        const int half = static_cast<int>(parameters_->steeringAngles / 2);
        for (int steer = -half; steer <= half; ++steer)
        {
            const double curvature = steer / (half * parameters_->turningRadius);
            for (const double gear : {1.0, -1.0})
            {
                // Roots of the goal's side are left in the direction opposite to that in which the car arrives.
                if (parameters_->forwardOnly && gear != (side == Side::Start ? 1.0 : -1.0))
                    continue;
                // Back along the same arc leads nowhere new; on along it does only from where reach ended.
                if (node.parent != NO_NODE && curvature == node.motion.curvature &&
                    (gear * node.motion.length < 0.0 || !node.farthest))
                    continue;
                motions_.push_back({curvature, gear * reach_});
            }
        }
    }

    void CarModel::measureMotions(const Pose &from)
    {
        const std::size_t count = motions_.size();
        free_.resize(count);
        clear_.assign(count, 0.0);
        if (!parameters_->cost.prefersClearance())
        {
            environment_->freeLengths(from, motions_.data(), count, free_.data());
            return;
        }
        environment_->clearLengths(from, motions_.data(), count, parameters_->cost.preferredClearance, clear_.data());
        environment_->freeLengthsBeyond(from, motions_.data(), count, clear_.data(), free_.data());
    }

    void CarModel::expand(Side side, NodeIndex index, const Node &node, std::size_t level, bool first,
                          Expansion &expansion)
    {
        collectMotions(side, node);
        const std::size_t count = motions_.size(), slots = 2 * parameters_->steeringAngles;
        std::vector<Known> &ofNodes = known_[static_cast<std::size_t>(side)];
        if (ofNodes.size() < (index + 1) * slots)
            ofNodes.resize((index + 1) * slots);
        // How far each motion is free is found out once and serves the finer levels, too.
        Known *const known = &ofNodes[index * slots];
        const double step = steps_[level];
        const bool priced = parameters_->cost.prefersClearance();
        const auto add = [&](std::size_t i, double length, bool farthest, double clear)
        {
            const Arc &motion = motions_[i];
            const double driven = std::copysign(length, motion.length);
            const Pose pose = advance(node.pose, motion.curvature, driven);
            expansion.successors.push_back({{0.0, motion.curvature, driven, 0.0},
                                            {pose.x, pose.y, wrapAngle(pose.yaw)},
                                            farthest,
                                            priced ? clear : -1.0});
        };
        if (!first)
        {
            for (std::size_t i = 0; i < count; ++i)
                if (static_cast<double>(known[i].free) >= step)
                    add(i, step, false, static_cast<double>(known[i].clear));
            return;
        }
        measureMotions(node.pose);
        for (std::size_t i = 0; i < count; ++i)
        {
            const double free = free_[i];
            known[i] = {std::nextafter(static_cast<float>(free), 0.0f),
                        std::nextafter(static_cast<float>(clear_[i]), 0.0f)};
            expansion.mobility = std::max(expansion.mobility, free);
            if (free < shortest_)
                continue;
            add(i, free, free >= reach_, clear_[i]);
            if (free > 1.1 * step)
                add(i, step, false, clear_[i]);
            // As far as it is preferred to go.
            if (priced && clear_[i] >= shortest_ && clear_[i] < free && std::abs(clear_[i] - step) > 0.1 * step)
                add(i, clear_[i], false, clear_[i]);
        }
    }

    double CarModel::clearLength(const Pose &from, const Arc &motion, double &clear)
    {
        clear = -1.0;
        if (!parameters_->cost.prefersClearance())
            return environment_->freeLength(from, motion.curvature, motion.length);
        environment_->clearLengths(from, &motion, 1, parameters_->cost.preferredClearance, &clear);
        if (clear > 0.0)
            return clear;
        // It is not clear from the beginning, or the environment cannot tell how far.
        if (!environment_->keeps(from, parameters_->cost.preferredClearance))
            return 0.0;
        const double free = environment_->freeLength(from, motion.curvature, motion.length);
        const PathPiece driven{motion.curvature, std::copysign(free, motion.length)};
        CostModel preference = parameters_->cost;
        preference.clearanceWeight = 0.0;
        return preference.closeness(from, driven, *environment_, clear, 0.0) > 0.0 ? 0.0 : free;
    }

    void CarModel::moveTowards(Side side, const Pose &from, const Pose &to, std::vector<Successor> &motions)
    {
        motions.clear();
        // On the goal's side the car will drive from there to here.
        const ReedsSheppCurve curve = side == Side::Start ? curves_.shortest(from, to) : curves_.shortest(to, from);
        Pose pose = from;
        for (std::size_t k = 0; k < curve.count; ++k)
        {
            const Arc piece = side == Side::Start ? curve.pieces[k]
                                                  : Arc{curve.pieces[curve.count - 1 - k].curvature,
                                                        -curve.pieces[curve.count - 1 - k].length};
            double clear = 0.0;
            const double length = clearLength(pose, piece, clear);
            const bool isWhole = length >= std::abs(piece.length);
            if (length >= shortest_)
            {
                const double driven = std::copysign(length, piece.length);
                const Pose end = advance(pose, piece.curvature, driven);
                pose = {end.x, end.y, wrapAngle(end.yaw)};
                motions.push_back({{0.0, piece.curvature, driven, 0.0}, pose, true, clear});
            }
            if (!isWhole)
                return;
        }
    }

    bool CarModel::join(const Node &fromStart, const Node &fromGoal, Side sweptFrom, double bound, const Offer &offer)
    {
        const double before = fromStart.g + fromGoal.g;
        if (before >= bound)
            return false;
        curves_.candidates(fromStart.pose, fromGoal.pose, candidates_, bound - before);
        const CostModel &cost = parameters_->cost;
        order_.clear();
        for (const ReedsSheppCurve &curve : candidates_)
        {
            double sum = before + curveCost(cost, curve);
            if (curve.count > 0 && fromStart.parent != NO_NODE)
                sum += cost.join(fromStart.motion.drive(), curve.pieces[0]);
            if (curve.count > 0 && fromGoal.parent != NO_NODE)
                sum += cost.join(curve.pieces[curve.count - 1], fromGoal.motion.drive().reversed());
            if (sum < bound && (parameters_->mostCusps == ANY_CUSPS ||
                                cuspsThrough(fromStart, curve, fromGoal) <= parameters_->mostCusps))
                order_.emplace_back(sum, &curve);
        }
        const SearchTuning &tuning = parameters_->tuning;
        if (order_.size() > tuning.mostFarCurves &&
            positionDistance(fromStart.pose, fromGoal.pose) > tuning.farCurve * parameters_->turningRadius)
        {
            std::partial_sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(tuning.mostFarCurves),
                              order_.end());
            order_.resize(tuning.mostFarCurves);
        }
        return offerFreeCurves(*environment_, cost, fromStart.pose, fromGoal.pose, order_,
                               sweptFrom == Side::Start ? CurveEnd::Start : CurveEnd::Goal, bound,
                               [&](const ReedsSheppCurve &curve, double whole)
                               {
                                   pieces_.assign(curve.pieces.begin(),
                                                  curve.pieces.begin() + static_cast<std::ptrdiff_t>(curve.count));
                                   return offer(pieces_.data(), pieces_.size(), whole);
                               });
    }
}  // namespace parking::search
