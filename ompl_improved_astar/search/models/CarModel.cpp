#include "ompl_improved_astar/search/models/CarModel.h"

#include "ompl_improved_astar/search/Tuning.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace parking::search
{
    void CarModel::begin(const SearchContext &context)
    {
        context_ = &context;
        const double radius = context.car.turningRadius;
        curves_ = ReedsShepp(radius, context.car.forwardOnly ? CurveFamily::Dubins : CurveFamily::ReedsShepp);
        freeCurves_ = std::make_unique<FreeCurves>(context.environment, curves_, context.cost);
        maxMotion_ = tuning::MAX_MOTION * radius;
        minMotion_ = tuning::MIN_MOTION * radius;
        // Cells are in proportion to the steps: that wide for a step of a third of the radius.
        const PlannerParameters &parameters = context.parameters;
        const double cell = parameters.xyResolution > 0.0 ? parameters.xyResolution : tuning::CELL_SIDE * radius;
        for (std::size_t level = 0; level < LEVELS; ++level)
        {
            steps_[level] = tuning::COARSEST_STEP * radius * std::pow(0.5, static_cast<double>(level));
            const double scale = 3.0 * steps_[level] / radius;
            inverseCell_[level] = 1.0 / (cell * scale);
            headingScale_[level] = std::max(8.0, parameters.headingBins / scale) / (2.0 * PI);
        }
        for (std::vector<Reach> &each : reaches_)
            each.clear();
    }

    ModelTraits CarModel::traits() const
    {
        ModelTraits traits;
        traits.levels = LEVELS;
        traits.drivesCurves = true;
        traits.otherSidePeriod = tuning::OTHER_SIDE_PERIOD;
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

    double CarModel::mobility(const Pose &root)
    {
        motions_.clear();
        for (const double steer : {-1.0, 0.0, 1.0})
            for (const double gear : {-1.0, 1.0})
                motions_.push_back({steer / context_->car.turningRadius, gear * steps_[0]});
        free_.resize(motions_.size());
        context_->environment.freeLengths(root, motions_.data(), motions_.size(), 0.0, free_.data());
        return std::accumulate(free_.begin(), free_.end(), 0.0);
    }

    void CarModel::collectMotions(Side side, const Node &node)
    {
        motions_.clear();
        const int half = static_cast<int>(context_->parameters.steeringAngles / 2);
        for (int steer = -half; steer <= half; ++steer)
        {
            const double curvature = steer / (half * context_->car.turningRadius);
            for (const double gear : {1.0, -1.0})
            {
                // Roots of the goal's side are left in the direction opposite to that in which the car arrives.
                if (context_->car.forwardOnly && gear != (side == Side::Start ? 1.0 : -1.0))
                    continue;
                // Back along the same arc leads nowhere new; on along it does only from where reach ended.
                if (node.parent != NO_NODE && curvature == node.motion.curvature &&
                    (gear * node.motion.length < 0.0 || !node.farthest))
                    continue;
                motions_.push_back({curvature, gear * maxMotion_});
            }
        }
    }

    void CarModel::measureMotions(const Pose &from)
    {
        MotionEnvironment &environment = context_->environment;
        const std::size_t count = motions_.size();
        free_.assign(count, 0.0);
        clear_.assign(count, 0.0);
        if (context_->cost.prefersClearance())
            environment.freeLengths(from, motions_.data(), count, context_->cost.preferredClearance, clear_.data());
        if (std::all_of(clear_.begin(), clear_.end(), [](double clear) { return clear <= 0.0; }))
        {
            environment.freeLengths(from, motions_.data(), count, 0.0, free_.data());
            return;
        }
        // What is clear is free, too: only the rest of it is swept.
        for (std::size_t i = 0; i < count; ++i)
        {
            const auto &[curvature, length] = motions_[i];
            const double rest = std::abs(length) - clear_[i];
            const Pose at = advance(from, curvature, std::copysign(clear_[i], length));
            free_[i] = clear_[i];
            if (rest > 0.0)
                free_[i] += environment.freeLength(at, {curvature, std::copysign(rest, length)});
        }
    }

    void CarModel::expand(Side side, NodeIndex index, const Node &node, std::size_t level, bool isFirst,
                          std::vector<Successor> &successors)
    {
        collectMotions(side, node);
        const std::size_t count = motions_.size(), slots = std::size_t{2} * context_->parameters.steeringAngles;
        std::vector<Reach> &ofNodes = reaches_[static_cast<std::size_t>(side)];
        if (ofNodes.size() < (index + 1) * slots)
            ofNodes.resize((index + 1) * slots);
        // How far each motion is free is found out once and serves the finer levels, too.
        Reach *const reaches = &ofNodes[index * slots];
        const double step = steps_[level];
        const bool isPriced = context_->cost.prefersClearance();
        const auto add = [&](std::size_t i, double length, bool farthest, double clear)
        {
            const Arc &motion = motions_[i];
            const double driven = std::copysign(length, motion.length);
            const Pose pose = advance(node.pose, motion.curvature, driven);
            successors.push_back({{0.0, motion.curvature, driven},
                                  {pose.x, pose.y, wrapAngle(pose.yaw)},
                                  farthest,
                                  isPriced ? clear : -1.0});
        };
        if (!isFirst)
        {
            for (std::size_t i = 0; i < count; ++i)
                if (static_cast<double>(reaches[i].free) >= step)
                    add(i, step, false, static_cast<double>(reaches[i].clear));
            return;
        }
        measureMotions(node.pose);
        for (std::size_t i = 0; i < count; ++i)
        {
            const double free = free_[i];
            reaches[i] = {std::nextafter(static_cast<float>(free), 0.0f),
                          std::nextafter(static_cast<float>(clear_[i]), 0.0f)};
            if (free < minMotion_)
                continue;
            add(i, free, free >= maxMotion_, clear_[i]);
            if (free > 1.1 * step)
                add(i, step, false, clear_[i]);
            // As far as it is preferred to go.
            if (isPriced && clear_[i] >= minMotion_ && clear_[i] < free && std::abs(clear_[i] - step) > 0.1 * step)
                add(i, clear_[i], false, clear_[i]);
        }
    }

    /** How far a motion surely keeps the preferred clearance (is free, if none is preferred), and the part of it known
        to be clear, as in Successor. */
    double CarModel::clearLength(const Pose &from, const Arc &motion, double &clear)
    {
        MotionEnvironment &environment = context_->environment;
        const CostModel &cost = context_->cost;
        clear = cost.prefersClearance() ? environment.freeLength(from, motion, cost.preferredClearance) : -1.0;
        if (clear > 0.0)
            return clear;
        // It is not clear from the beginning, or the environment cannot tell how far.
        if (cost.prefersClearance() && !environment.keeps(from, cost.preferredClearance))
            return 0.0;
        const double free = environment.freeLength(from, motion);
        const PathPiece driven{motion.curvature, std::copysign(free, motion.length)};
        return cost.proximity(from, driven, environment, clear, 0.0) > 0.0 ? 0.0 : free;
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
            if (length >= minMotion_)
            {
                const double driven = std::copysign(length, piece.length);
                const Pose end = advance(pose, piece.curvature, driven);
                pose = {end.x, end.y, wrapAngle(end.yaw)};
                motions.push_back({{0.0, piece.curvature, driven}, pose, true, clear});
            }
            if (length < std::abs(piece.length))
                return;
        }
    }

    bool CarModel::join(const Node &fromStart, const Node &fromGoal, Side sweptFrom, double bound, const Offer &offer)
    {
        const double outside = fromStart.g + fromGoal.g;
        const PathPiece before = fromStart.motion.drive(), after = fromGoal.motion.drive().reversed();
        const FreeCurves::Gap gap{fromStart.pose,
                                  fromGoal.pose,
                                  fromStart.parent != NO_NODE ? &before : nullptr,
                                  fromGoal.parent != NO_NODE ? &after : nullptr,
                                  bound - outside,
                                  sweptFrom == Side::Start ? FreeCurves::SweepEnd::Start : FreeCurves::SweepEnd::Goal};
        return freeCurves_->connect(gap,
                                    [&](const ReedsSheppCurve &curve, double cost)
                                    {
                                        pieces_.assign(curve.pieces.begin(),
                                                       curve.pieces.begin() + static_cast<std::ptrdiff_t>(curve.count));
                                        return offer(pieces_.data(), pieces_.size(), outside + cost);
                                    });
    }
}  // namespace parking::search
