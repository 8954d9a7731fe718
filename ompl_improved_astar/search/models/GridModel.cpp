#include "ompl_improved_astar/search/models/GridModel.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double RESOLUTION = 0.5;  // metres, where the user leaves the choice (the paper's)
        // Often, since a checker may take a tenth of a millisecond for each of the states that these ask for.
        constexpr std::int64_t STATES_BETWEEN_STOPS = 8;
        constexpr double SAME_HEADING = 1e-9;  // radians
    }                                          // namespace

    GridModel::GridModel(std::vector<GridStep> steps) : steps_(std::move(steps))
    {
        if (steps_.size() > MAX_STEPS)
            throw Error("a grid model has at most 32 steps, not " + std::to_string(steps_.size()));
        for (const GridStep &step : steps_)
        {
            const auto opposite = std::find_if(steps_.begin(), steps_.end(),
                                               [&step](const GridStep &other)
                                               { return other.columns == -step.columns && other.rows == -step.rows; });
            if (opposite == steps_.end())
                throw Error("a grid model needs the opposite of each step");
            opposite_.push_back(static_cast<std::size_t>(opposite - steps_.begin()));
        }
    }

    void GridModel::begin(const SearchContext &context)
    {
        environment_ = &context.environment;
        bounds_ = context.car.bounds;
        isBidirectional_ = context.parameters.bidirectional;
        resolution_ = context.parameters.xyResolution > 0.0 ? context.parameters.xyResolution : RESOLUTION;
        const Eigen::Vector2d size = bounds_.size() / resolution_;
        constexpr double MAX = 2.0 * TiledGrid<Cell>::REACH;
        // Written so that NaN does not pass.
        if (!(size.maxCoeff() <= MAX))
            throw Error("a grid has at most " + formatNumber(MAX) + " cells along x and y: for bounds of " +
                        formatNumber(bounds_.size().maxCoeff()) + " m xy_resolution must be at least " +
                        formatNumber(bounds_.size().maxCoeff() / MAX) + " m, not " + formatNumber(resolution_));
        const auto cellsAlong = [](double length)
        {
            return static_cast<std::int32_t>(std::max(1.0, std::ceil(length)));
        };
        columns_ = cellsAlong(size.x());
        rows_ = cellsAlong(size.y());
        cells_.clear();
        for (auto &roots : roots_)
            roots.clear();
        loaded_ = 0;
    }

    ModelTraits GridModel::traits() const
    {
        ModelTraits traits;
        traits.isComplete = true;
        traits.aims = isBidirectional_;
        traits.turnsOnTheSpot = true;
        return traits;
    }

    GridModel::Place GridModel::placeOf(const Pose &pose) const
    {
        const double column = std::floor((pose.x - bounds_.min.x()) / resolution_);
        const double row = std::floor((pose.y - bounds_.min.y()) / resolution_);
        return {static_cast<std::int32_t>(std::clamp(column, 0.0, columns_ - 1.0)),
                static_cast<std::int32_t>(std::clamp(row, 0.0, rows_ - 1.0))};
    }

    Pose GridModel::centre(const Place &place) const
    {
        return {bounds_.min.x() + (place.column + 0.5) * resolution_, bounds_.min.y() + (place.row + 0.5) * resolution_,
                0.0};
    }

    GridModel::Cell &GridModel::cellAt(const Place &place)
    {
        return cells_.at(place.column - TiledGrid<Cell>::REACH, place.row - TiledGrid<Cell>::REACH);
    }

    std::uint64_t GridModel::cell(const Pose &pose, std::size_t /*level*/) const
    {
        const Place place = placeOf(pose);
        return (static_cast<std::uint64_t>(place.column) << 30) | static_cast<std::uint64_t>(place.row);
    }

    void GridModel::addRoot(Side side, const Pose &pose)
    {
        roots_[static_cast<std::size_t>(side)].emplace_back(cell(pose, 0), pose);
    }

    const Pose *GridModel::rootIn(Side side, std::uint64_t cell) const
    {
        for (const auto &[rootCell, pose] : roots_[static_cast<std::size_t>(side)])
            if (rootCell == cell)
                return &pose;
        return nullptr;
    }

    bool GridModel::isCellFree(Cell &cell, const Pose &pose, std::size_t step)
    {
        Occupancy &known = environment_->headingMatters() ? cell.byHeading[step] : cell.occupancy;
        if (known != Occupancy::Unknown)
            return known == Occupancy::Free;
        const bool isFree = environment_->isFree(pose);
        if (!environment_->wasInterrupted())
            known = isFree ? Occupancy::Free : Occupancy::Blocked;
        return isFree;
    }

    bool GridModel::load(const StopFunction &stop)
    {
        const std::size_t headings = environment_->headingMatters() ? steps_.size() : 1;
        const std::int64_t count = static_cast<std::int64_t>(columns_) * rows_;
        const auto cellsBetweenStops =
            std::max<std::int64_t>(1, STATES_BETWEEN_STOPS / static_cast<std::int64_t>(headings));
        for (; loaded_ < count; ++loaded_)
        {
            if (loaded_ % cellsBetweenStops == 0 && stop && stop())
                return false;
            const Place place{static_cast<std::int32_t>(loaded_ % columns_),
                              static_cast<std::int32_t>(loaded_ / columns_)};
            Pose pose = centre(place);
            for (std::size_t step = 0; step < headings; ++step)
            {
                pose.yaw = std::atan2(steps_[step].rows, steps_[step].columns);
                isCellFree(cellAt(place), pose, step);
            }
        }
        return true;
    }

    void GridModel::expand(Side side, NodeIndex /*index*/, const Node &node, std::size_t /*level*/, bool /*isFirst*/,
                           std::vector<Successor> &successors)
    {
        const Place from = placeOf(node.pose);
        for (const GridStep &step : steps_)
        {
            const Place place{from.column + step.columns, from.row + step.rows};
            if (!isInside(place))
                continue;
            // The cells of roots stand for the roots' own positions.
            Pose to = centre(place);
            const std::uint64_t key = cell(to, 0);
            if (const Pose *root = rootIn(opposite(side), key))
                to = *root;
            else if (const Pose *ownRoot = rootIn(side, key))
                to = *ownRoot;
            const double dx = to.x - node.pose.x, dy = to.y - node.pose.y, length = std::hypot(dx, dy);
            // On the goal's side the car comes the other way, and its heading is that with which it leaves.
            to.yaw = side == Side::Start ? std::atan2(dy, dx) : std::atan2(-dy, -dx);
            const double turn = wrapAngle(to.yaw - node.pose.yaw);
            successors.push_back(
                {{std::abs(turn) > SAME_HEADING ? turn : 0.0, 0.0, side == Side::Start ? length : -length}, to});
        }
    }

    bool GridModel::isFree(Side side, const Node &from, const Successor &successor)
    {
        const Pose &to = successor.pose;
        const Place place = placeOf(to), origin = placeOf(from.pose);
        const Pose middle = centre(place), begin = centre(origin);
        // The matrix holds centres of cells and, where it matters, the headings of steps between them.
        const bool atCentres = to.x == middle.x && to.y == middle.y &&
                               (!environment_->headingMatters() || (from.pose.x == begin.x && from.pose.y == begin.y));
        bool free = false;
        if (atCentres)
        {
            std::size_t step = 0;
            if (environment_->headingMatters())
                while (origin.column + steps_[step].columns != place.column ||
                       origin.row + steps_[step].rows != place.row)
                    ++step;
            free = isCellFree(cellAt(place), to, side == Side::Start ? step : opposite_[step]);
        }
        else
            free = environment_->isFree(to);
        if (!free)
            return false;
        // The car turns on the spot before it goes; seen from the goal's side, after it has come.
        const Pose turned{from.pose.x, from.pose.y, to.yaw};
        if (side == Side::Start)
            return isTurnFree(from.pose, successor.motion.turn) && environment_->isMotionFree(turned, to);
        return environment_->isMotionFree(to, turned) && isTurnFree(turned, -successor.motion.turn);
    }

    bool GridModel::isTurnFree(const Pose &from, double turn)
    {
        // In parts, since half a circle could be meant either way.
        const double parts = std::ceil(std::abs(turn) / PathPiece::MAX_TURN);
        Pose pose = from;
        for (double part = 1.0; part <= parts; part += 1.0)
        {
            const Pose next{from.x, from.y, wrapAngle(from.yaw + turn * part / parts)};
            if (!environment_->isMotionFree(pose, next))
                return false;
            pose = next;
        }
        return true;
    }

    bool GridModel::join(const Node &fromStart, const Node &fromGoal, Side /*sweptFrom*/, double bound,
                         const Offer &offer)
    {
        // Nodes that share a cell share a place, but for a start and a goal in one cell.
        const Pose &a = fromStart.pose, &b = fromGoal.pose;
        const double length = positionDistance(a, b), cost = fromStart.g + fromGoal.g + length;
        if (cost >= bound)
            return false;
        std::vector<PathPiece> pieces;
        Pose pose = a;
        const auto turnTo = [&](double yaw)
        {
            const double turn = wrapAngle(yaw - pose.yaw);
            if (std::abs(turn) <= SAME_HEADING)
                return true;
            const bool free = isTurnFree(pose, turn);
            pieces.push_back(PathPiece::turnOnTheSpot(turn));
            pose.yaw = yaw;
            return free;
        };
        if (length > 0.0)
        {
            if (!turnTo(std::atan2(b.y - a.y, b.x - a.x)) || !environment_->isMotionFree(pose, {b.x, b.y, pose.yaw}))
                return false;
            pieces.emplace_back(0.0, length);
            pose = {b.x, b.y, pose.yaw};
        }
        return turnTo(b.yaw) && offer(pieces.data(), pieces.size(), cost);
    }
}  // namespace parking::search
