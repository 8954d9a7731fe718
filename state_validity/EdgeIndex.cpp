#include "state_validity/EdgeIndex.h"

#include "state_validity/sweeps/PieceFront.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double BUCKET_SIZE = 1.0;      // metres
        constexpr double MAX_BUCKETS = 4.0e6;    // larger worlds get larger buckets
        constexpr double CELL_OF_BUCKETS = 4.0;  // side of a cell in buckets
        constexpr std::size_t BLOCK_SIZE = 8;
        // Rounding error of rotated coordinates within a few kilometres of the frame, with a reserve.
        constexpr double ROUNDING = 1e-10;
        // Cells are larger by this on each side, so that rounding loses no edge along the border; metres.
        constexpr double HAIR = 1e-9;
        // Avoids a division by zero for an edge that is cut off at its end and has no length.
        constexpr double MIN_SQUARE = 1e-300;

        using Eight = Eigen::Array<double, BLOCK_SIZE, 1>;

        double squaredDistanceToSegment(double px, double py, double ax, double ay, double bx, double by)
        {
            const double dx = bx - ax, dy = by - ay;
            const double square = dx * dx + dy * dy;
            const double t = square > 0.0 ? std::clamp(((px - ax) * dx + (py - ay) * dy) / square, 0.0, 1.0) : 0.0;
            const double ex = px - ax - t * dx, ey = py - ay - t * dy;
            return ex * ex + ey * ey;
        }

        double squaredDistanceToBox(double px, double py, double hx, double hy)
        {
            const double dx = std::max(0.0, std::abs(px) - hx), dy = std::max(0.0, std::abs(py) - hy);
            return dx * dx + dy * dy;
        }

        /** The distance between the oriented box and an edge with this unit normal; 0 when they cross. */
        double distanceTo(const OrientedBox &box, const Edge &edge, const Eigen::Vector2d &normal)
        {
            const double c = box.cosine, s = box.sine, hx = box.halfLength, hy = box.halfWidth;
            const double dax = edge.from.x() - box.x, day = edge.from.y() - box.y;
            const double dbx = edge.to.x() - box.x, dby = edge.to.y() - box.y;
            const double ax = c * dax + s * day, ay = c * day - s * dax;
            const double bx = c * dbx + s * dby, by = c * dby - s * dbx;
            const double nx = c * normal.x() + s * normal.y(), ny = c * normal.y() - s * normal.x();
            const double gapX = std::max(std::min(ax, bx), -std::max(ax, bx)) - hx;
            const double gapY = std::max(std::min(ay, by), -std::max(ay, by)) - hy;
            const double gapN = std::abs(nx * ax + ny * ay) - hx * std::abs(nx) - hy * std::abs(ny);
            if (std::max(std::max(gapX, gapY), gapN) <= 0.0)
                return 0.0;
            // They do not intersect, so a corner of one has the smallest distance from the other.
            double square = std::min(squaredDistanceToBox(ax, ay, hx, hy), squaredDistanceToBox(bx, by, hx, hy));
            for (const double cx : {-hx, hx})
                for (const double cy : {-hy, hy})
                    square = std::min(square, squaredDistanceToSegment(cx, cy, ax, ay, bx, by));
            return std::sqrt(square);
        }

        /** The distance between a piece of a body and an edge with this unit normal, both in the frame of the body; 0
            when they cross. */
        double distanceTo(const BodyPiece &piece, const Edge &edge, const Eigen::Vector2d &normal)
        {
            const double height = normal.dot(edge.from);
            double gap = -HUGE_VAL, low = HUGE_VAL, high = -HUGE_VAL, square = HUGE_VAL;
            for (std::size_t i = 0; i < piece.sides.size(); ++i)
            {
                const BodyPiece::Side &side = piece.sides[i];
                const Eigen::Vector2d &a = side.corner, b = piece.corner(i + 1, 0.0);
                gap = std::max(gap, std::min(side.normal.dot(edge.from), side.normal.dot(edge.to)) - side.offset);
                low = std::min(low, normal.dot(a));
                high = std::max(high, normal.dot(a));
                square = std::min(
                    {square,
                     squaredDistanceToSegment(a.x(), a.y(), edge.from.x(), edge.from.y(), edge.to.x(), edge.to.y()),
                     squaredDistanceToSegment(edge.from.x(), edge.from.y(), a.x(), a.y(), b.x(), b.y()),
                     squaredDistanceToSegment(edge.to.x(), edge.to.y(), a.x(), a.y(), b.x(), b.y())});
            }
            // If they do not intersect, a corner of one has the smallest distance from the other.
            return std::max({gap, height - high, low - height}) <= 0.0 ? 0.0 : std::sqrt(square);
        }

        std::size_t clampTo(double value, std::size_t count)
        {
            return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(count - 1)));
        }

        /** Clips an edge to the box. \return false if no part is left */
        bool clip(Edge &edge, const Box &box)
        {
            // The most common case requires no division.
            if (box.contains(edge.from.x(), edge.from.y()) && box.contains(edge.to.x(), edge.to.y()))
                return true;
            const Eigen::Vector2d from = edge.from, along = edge.to - edge.from;
            double begin = 0.0, end = 1.0;
            for (int axis = 0; axis < 2; ++axis)
            {
                const double low = box.min[axis] - from[axis], high = box.max[axis] - from[axis];
                if (along[axis] == 0.0)
                {
                    if (low > 0.0 || high < 0.0)
                        return false;
                    continue;
                }
                const double t0 = low / along[axis], t1 = high / along[axis];
                begin = std::max(begin, std::min(t0, t1));
                end = std::min(end, std::max(t0, t1));
            }
            if (begin > end)
                return false;
            if (begin > 0.0)
                edge.from = from + begin * along;
            if (end < 1.0)
                edge.to = from + end * along;
            return true;
        }

        /** Position along a Z-order curve through a square of 256 x 256 places, which keeps neighbours close. */
        std::uint32_t zOrder(double u, double v)
        {
            const auto spread = [](double value)
            {
                auto bits = static_cast<std::uint32_t>(std::clamp(value * 256.0, 0.0, 255.0));
                bits = (bits | (bits << 4)) & 0x0f0fU;
                bits = (bits | (bits << 2)) & 0x3333U;
                return (bits | (bits << 1)) & 0x5555U;
            };
            return spread(u) | (spread(v) << 1);
        }
    }  // namespace

    /** Eight neighbouring edges; the last one is repeated if there are fewer. */
    struct EdgeIndex::Block
    {
        Eight ax, ay, bx, by;
        Eight nx, ny;       // unit normals
        std::size_t edges;  // distinct ones

        /** The smallest separation of the box and the eight edges. */
        double separation(const OrientedBox &box) const
        {
            const double c = box.cosine, s = box.sine;
            const Eight dax = ax - box.x, day = ay - box.y, dbx = bx - box.x, dby = by - box.y;
            const Eight lax = c * dax + s * day, lay = c * day - s * dax;
            const Eight lbx = c * dbx + s * dby, lby = c * dby - s * dbx;
            const Eight gapX = lax.min(lbx).max(-lax.max(lbx)) - box.halfLength;
            const Eight gapY = lay.min(lby).max(-lay.max(lby)) - box.halfWidth;
            const Eight gapN = (nx * dax + ny * day).abs() - box.halfLength * (c * nx + s * ny).abs() -
                               box.halfWidth * (c * ny - s * nx).abs();
            return gapX.max(gapY).max(gapN).minCoeff();
        }

        /** The smallest separation of the pieces, given in the frame of the box, and the eight edges. */
        double separation(const OrientedBox &box, const std::vector<BodyPiece> &pieces) const;

        /** The smallest squared distance between the point and the eight edges. */
        double squaredDistance(double px, double py) const
        {
            const Eight dx = bx - ax, dy = by - ay, ux = px - ax, uy = py - ay;
            const Eight share = ((ux * dx + uy * dy) / (dx * dx + dy * dy).max(MIN_SQUARE)).max(0.0).min(1.0);
            return ((ux - share * dx).square() + (uy - share * dy).square()).minCoeff();
        }
    };

    // Not inline, so that the loops over blocks stay short for boxes.
    double EdgeIndex::Block::separation(const OrientedBox &box, const std::vector<BodyPiece> &pieces) const
    {
        const double c = box.cosine, s = box.sine;
        const Eight dax = ax - box.x, day = ay - box.y, dbx = bx - box.x, dby = by - box.y;
        const Eight lax = c * dax + s * day, lay = c * day - s * dax;
        const Eight lbx = c * dbx + s * dby, lby = c * dby - s * dbx;
        const Eight lnx = c * nx + s * ny, lny = c * ny - s * nx;
        const Eight height = lnx * lax + lny * lay;
        Eight smallest = Eight::Constant(HUGE_VAL);
        for (const BodyPiece &piece : pieces)
        {
            Eight gap = Eight::Constant(-HUGE_VAL), low = Eight::Constant(HUGE_VAL), high = gap;
            for (const BodyPiece::Side &side : piece.sides)
            {
                const double x = side.normal.x(), y = side.normal.y();
                gap = gap.max((x * lax + y * lay).min(x * lbx + y * lby) - side.offset);
                const Eight reach = lnx * side.corner.x() + lny * side.corner.y();
                low = low.min(reach);
                high = high.max(reach);
            }
            smallest = smallest.min(gap.max(height - high).max(low - height));
        }
        return smallest.minCoeff();
    }

    /** A block and its axis-parallel bounding box: centre and half lengths. */
    struct EdgeIndex::BlockInBox
    {
        double x, y, ex, ey;
        const Block *block;

        /** Lower bound of the distance between the oriented box and this one, along the axes of the former. */
        double gap(const OrientedBox &box) const
        {
            const double c = box.cosine, s = box.sine;
            const double dx = x - box.x, dy = y - box.y;
            const double ac = std::abs(c), as = std::abs(s);
            const double gapX = std::abs(c * dx + s * dy) - (ac * ex + as * ey) - box.halfLength;
            const double gapY = std::abs(c * dy - s * dx) - (ac * ey + as * ex) - box.halfWidth;
            return std::max(gapX, gapY) - ROUNDING;
        }
    };

    struct EdgeIndex::Cell
    {
        std::vector<Block> blocks;
        std::vector<BlockInBox> boxes;  // of the blocks
    };

    EdgeIndex::EdgeIndex(const ObstacleSet &obstacles, double reach, std::vector<BodyPiece> pieces)
      : EdgeIndex(obstacles.cellSize() > 0.0 ? std::vector<Edge>() : obstacles.edges(), obstacles.bounds(), reach,
                  std::move(pieces))
    {
        if (obstacles.cellSize() > 0.0)
            grid_ = &obstacles;
    }

    EdgeIndex::EdgeIndex(const std::vector<Edge> &edges, const Box &bounds, double reach, std::vector<BodyPiece> pieces)
      : reach_(reach),
        pieces_(std::move(pieces)),
        origin_(bounds.min)
    {
        const Eigen::Vector2d size = bounds.size();
        bucketSize_ = std::max(BUCKET_SIZE, std::sqrt(size.x() * size.y() / MAX_BUCKETS));
        inverseBucketSize_ = 1.0 / bucketSize_;
        columns_ = static_cast<std::size_t>(std::ceil(size.x() / bucketSize_)) + 1;
        rows_ = static_cast<std::size_t>(std::ceil(size.y() / bucketSize_)) + 1;
        cellSize_ = CELL_OF_BUCKETS * bucketSize_;
        cellColumns_ = static_cast<std::size_t>(static_cast<double>(columns_) / CELL_OF_BUCKETS) + 1;
        cellRows_ = static_cast<std::size_t>(static_cast<double>(rows_) / CELL_OF_BUCKETS) + 1;
        buckets_ = std::vector<std::atomic<List *>>(columns_ * rows_);
        cells_ = std::vector<std::atomic<Cell *>>(cellColumns_ * cellRows_);
        // Counting sort of the edges by the cells that their boxes overlap. Long diagonal edges are few.
        const auto forEachCell = [&](const Edge &edge, auto &&visit)
        {
            if (!((edge.to - edge.from).squaredNorm() > 0.0))
                return;
            const Eigen::Vector2d low = (edge.from.cwiseMin(edge.to) - origin_) / cellSize_;
            const Eigen::Vector2d high = (edge.from.cwiseMax(edge.to) - origin_) / cellSize_;
            const std::size_t left = clampTo(low.x(), cellColumns_), right = clampTo(high.x(), cellColumns_);
            const std::size_t top = clampTo(high.y(), cellRows_);
            for (std::size_t row = clampTo(low.y(), cellRows_); row <= top; ++row)
                for (std::size_t column = left; column <= right; ++column)
                    visit(row * cellColumns_ + column);
        };
        first_.assign(cells_.size() + 1, 0);
        for (const Edge &edge : edges)
            forEachCell(edge, [&](std::size_t cell) { ++first_[cell + 1]; });
        for (std::size_t cell = 1; cell < first_.size(); ++cell)
            first_[cell] += first_[cell - 1];
        ofCells_.resize(first_.back());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (const Edge &edge : edges)
            forEachCell(edge, [&](std::size_t cell) { ofCells_[next[cell]++] = edge; });
    }

    EdgeIndex::~EdgeIndex()
    {
        for (std::atomic<List *> &bucket : buckets_)
            delete bucket.load(std::memory_order_relaxed);
        for (std::atomic<Cell *> &cell : cells_)
            delete cell.load(std::memory_order_relaxed);
    }

    /** The object at \e place, made lazily. Several threads may make it concurrently; the first result is kept. */
    template <class T, class Make>
    const T &EdgeIndex::once(std::atomic<T *> &place, const Make &make)
    {
        T *known = place.load(std::memory_order_acquire);
        if (known == nullptr)
        {
            std::unique_ptr<T> fresh = make();
            if (place.compare_exchange_strong(known, fresh.get(), std::memory_order_acq_rel))
                known = fresh.release();
        }
        return *known;
    }

    std::unique_ptr<EdgeIndex::Cell> EdgeIndex::cut(std::size_t column, std::size_t row) const
    {
        // The cells at the border also contain the area beyond the world.
        const Eigen::Vector2d corner =
            origin_ + cellSize_ * Eigen::Vector2d(static_cast<double>(column), static_cast<double>(row));
        const Eigen::Vector2d hair(HAIR, HAIR);
        Box box{corner - hair, corner + Eigen::Vector2d(cellSize_, cellSize_) + hair};
        if (column == 0)
            box.min.x() = -HUGE_VAL;
        if (row == 0)
            box.min.y() = -HUGE_VAL;
        if (column + 1 == cellColumns_)
            box.max.x() = HUGE_VAL;
        if (row + 1 == cellRows_)
            box.max.y() = HUGE_VAL;

        // Edges sorted along the curve. The higher half of a key is the place, the lower half the edge.
        std::vector<Edge> ofGrid;
        const Edge *edges = nullptr;
        std::size_t count = 0;
        if (grid_ != nullptr)
        {
            ofGrid = grid_->edgesNear(box);
            edges = ofGrid.data();
            count = ofGrid.size();
        }
        else
        {
            const std::size_t *const first = &first_[row * cellColumns_ + column];
            edges = ofCells_.data() + first[0];
            count = first[1] - first[0];
        }
        std::vector<std::uint64_t> order;
        order.reserve(count);
        for (std::size_t k = 0; k < count; ++k)
        {
            Edge piece = edges[k];
            if (!clip(piece, box))
                continue;
            const Eigen::Vector2d middle = (0.5 * (piece.from + piece.to) - corner) / cellSize_;
            order.push_back(static_cast<std::uint64_t>(zOrder(middle.x(), middle.y())) << 32 | k);
        }
        std::sort(order.begin(), order.end());

        auto cell = std::make_unique<Cell>();
        cell->blocks.resize((order.size() + BLOCK_SIZE - 1) / BLOCK_SIZE);
        cell->boxes.reserve(cell->blocks.size());
        for (std::size_t k = 0; k < cell->blocks.size(); ++k)
        {
            Block &block = cell->blocks[k];
            block.edges = std::min(BLOCK_SIZE, order.size() - k * BLOCK_SIZE);
            Eigen::Vector2d low(HUGE_VAL, HUGE_VAL), high(-HUGE_VAL, -HUGE_VAL);
            Edge piece{};
            Eigen::Vector2d along(0.0, 0.0);
            for (std::size_t i = 0; i < BLOCK_SIZE; ++i)
            {
                if (i < block.edges)
                {
                    piece = edges[order[k * BLOCK_SIZE + i] & 0xffffffffu];
                    along = (piece.to - piece.from).normalized();
                    clip(piece, box);
                }
                const auto at = static_cast<Eigen::Index>(i);
                block.ax[at] = piece.from.x();
                block.ay[at] = piece.from.y();
                block.bx[at] = piece.to.x();
                block.by[at] = piece.to.y();
                block.nx[at] = -along.y();
                block.ny[at] = along.x();
                low = low.cwiseMin(piece.from.cwiseMin(piece.to));
                high = high.cwiseMax(piece.from.cwiseMax(piece.to));
            }
            const Eigen::Vector2d middle = 0.5 * (low + high), half = 0.5 * (high - low);
            cell->boxes.push_back({middle.x(), middle.y(), half.x() + ROUNDING, half.y() + ROUNDING, &block});
        }
        return cell;
    }

    void EdgeIndex::update(const std::vector<std::size_t> &changed)
    {
        const double side = grid_->cellSize();
        std::vector<std::size_t> dropped;
        for (const std::size_t index : changed)
        {
            const double x = side * static_cast<double>(index % grid_->columns()) - origin_.x();
            const double y = side * static_cast<double>(index / grid_->columns()) - origin_.y();
            // The outline of the changed cell may lie on the border of a cell of the index.
            const std::size_t right = clampTo((x + side + 2.0 * HAIR) / cellSize_, cellColumns_),
                              high = clampTo((y + side + 2.0 * HAIR) / cellSize_, cellRows_);
            for (std::size_t row = clampTo((y - 2.0 * HAIR) / cellSize_, cellRows_); row <= high; ++row)
                for (std::size_t column = clampTo((x - 2.0 * HAIR) / cellSize_, cellColumns_); column <= right;
                     ++column)
                    if (const std::size_t cell = row * cellColumns_ + column; dropped.empty() || dropped.back() != cell)
                        dropped.push_back(cell);
        }
        std::sort(dropped.begin(), dropped.end());
        dropped.erase(std::unique(dropped.begin(), dropped.end()), dropped.end());
        for (const std::size_t cell : dropped)
        {
            delete cells_[cell].exchange(nullptr, std::memory_order_relaxed);
            // All lists that may refer to the cell, see gather(). One more bucket on each side covers rounding.
            const double around = reach_ + 1.5 * bucketSize_;
            const double x = cellSize_ * static_cast<double>(cell % cellColumns_);
            const double y = cellSize_ * static_cast<double>(cell / cellColumns_);
            const std::size_t right = clampTo((x + cellSize_ + around) * inverseBucketSize_, columns_),
                              high = clampTo((y + cellSize_ + around) * inverseBucketSize_, rows_);
            for (std::size_t row = clampTo((y - around) * inverseBucketSize_, rows_); row <= high; ++row)
                for (std::size_t column = clampTo((x - around) * inverseBucketSize_, columns_); column <= right;
                     ++column)
                    delete buckets_[row * columns_ + column].exchange(nullptr, std::memory_order_relaxed);
        }
    }

    const EdgeIndex::Cell &EdgeIndex::cellAt(std::size_t column, std::size_t row) const
    {
        return once(cells_[row * cellColumns_ + column], [this, column, row] { return cut(column, row); });
    }

    std::unique_ptr<EdgeIndex::List> EdgeIndex::gather(std::size_t column, std::size_t row) const
    {
        const double half = 0.5 * bucketSize_, around = reach_ + half;
        const double x = origin_.x() + static_cast<double>(column) * bucketSize_ + half;
        const double y = origin_.y() + static_cast<double>(row) * bucketSize_ + half;
        const double farthest = reach_ + half * std::sqrt(2.0);
        const std::size_t left = clampTo((x - around - origin_.x()) / cellSize_, cellColumns_);
        const std::size_t right = clampTo((x + around - origin_.x()) / cellSize_, cellColumns_);
        const std::size_t low = clampTo((y - around - origin_.y()) / cellSize_, cellRows_);
        const std::size_t high = clampTo((y + around - origin_.y()) / cellSize_, cellRows_);
        std::size_t boxes = 0;
        for (std::size_t r = low; r <= high; ++r)
            for (std::size_t c = left; c <= right; ++c)
                boxes += cellAt(c, r).boxes.size();
        // The distance test is unpredictable, so a branch would take longer than writing all candidates.
        std::vector<const BlockInBox *> found(boxes + 1);
        std::size_t count = 0;
        for (std::size_t r = low; r <= high; ++r)
            for (std::size_t c = left; c <= right; ++c)
                for (const BlockInBox &each : cellAt(c, r).boxes)
                {
                    found[count] = &each;
                    count += squaredDistanceToBox(x - each.x, y - each.y, each.ex, each.ey) <= farthest * farthest;
                }
        auto list = std::make_unique<List>();
        list->reserve(count);
        for (std::size_t k = 0; k < count; ++k)
            list->push_back(*found[k]);
        return list;
    }

    const EdgeIndex::List &EdgeIndex::near(double x, double y) const
    {
        const auto index = [](double value, std::size_t count)
        {
            return value > 0.0 ? std::min(static_cast<std::size_t>(value), count - 1) : std::size_t{0};
        };
        const std::size_t column = index((x - origin_.x()) * inverseBucketSize_, columns_);
        const std::size_t row = index((y - origin_.y()) * inverseBucketSize_, rows_);
        return once(buckets_[row * columns_ + column], [this, column, row] { return gather(column, row); });
    }

    /** The separation of the body from a block; any value of at least \e ignored if that of its box is so large. */
    inline double EdgeIndex::separationOf(const Block &block, const OrientedBox &box, double ignored) const
    {
        const double ofBox = block.separation(box);
        return pieces_.empty() || ofBox >= ignored ? ofBox : block.separation(box, pieces_);
    }

    /** The distance between the body and an edge. */
    double EdgeIndex::distanceOf(const OrientedBox &box, const Edge &edge, const Eigen::Vector2d &normal) const
    {
        if (pieces_.empty())
            return distanceTo(box, edge, normal);
        const Eigen::Vector2d turned(box.cosine * normal.x() + box.sine * normal.y(),
                                     box.cosine * normal.y() - box.sine * normal.x());
        const Edge local{box.toFrame(edge.from), box.toFrame(edge.to)};
        double smallest = HUGE_VAL;
        for (const BodyPiece &piece : pieces_)
            smallest = std::min(smallest, distanceTo(piece, local, turned));
        return smallest;
    }

    double EdgeIndex::separation(const OrientedBox &box, double ignored) const
    {
        double smallest = ignored;
        for (const BlockInBox &each : near(box.x, box.y))
            if (each.gap(box) < smallest)
                smallest = std::min(smallest, separationOf(*each.block, box, smallest));
        return smallest;
    }

    bool EdgeIndex::isSeparate(const OrientedBox &box, double minSeparation) const
    {
        for (const BlockInBox &each : near(box.x, box.y))
            if (each.gap(box) < minSeparation && separationOf(*each.block, box, minSeparation) < minSeparation)
                return false;
        return true;
    }

    int EdgeIndex::side(const OrientedBox &box, double band) const
    {
        double smallest = HUGE_VAL;
        for (const BlockInBox &each : near(box.x, box.y))
            if (each.gap(box) <= band)
            {
                smallest = std::min(smallest, separationOf(*each.block, box, band));
                if (smallest < -band)
                    return -1;
            }
        return smallest > band ? 1 : 0;
    }

    double EdgeIndex::firstContact(const OrientedBox &box, const BoxSweep &sweep, double middleCosine,
                                   double middleSine) const
    {
        if (!pieces_.empty())
            return firstContactOfPieces(box, sweep, middleCosine, middleSine);
        const List &list = near(box.x, box.y);
        if (SweepFront::applies(sweep))
        {
            SweepFront front(box, sweep, middleCosine, middleSine);
            for (const auto &[x, y, ex, ey, pointer] : list)
            {
                if (!front.mayMeet(x, y, ex, ey))
                    continue;
                const Block &block = *pointer;
                // Most edges of the block lie beside the swept area and are skipped, all eight at a time.
                const Eight gaps = front.gap(block.ax, block.ay, block.bx, block.by);
                for (std::size_t i = 0; i < block.edges; ++i)
                {
                    const auto k = static_cast<Eigen::Index>(i);
                    if (gaps[k] > 0.0)
                        continue;
                    front.meetPoint(block.ax[k], block.ay[k]);
                    front.meetPoint(block.bx[k], block.by[k]);
                    front.meetEdge(block.ax[k], block.ay[k], block.bx[k], block.by[k], block.nx[k], block.ny[k]);
                }
            }
            return front.contact();
        }

        // No point of the box moves farther than this.
        const double farthest = std::hypot(std::abs(sweep.axle) + sweep.halfLength, sweep.halfWidth);
        const double moved = (sweep.length + OVERRUN) * (1.0 + std::abs(sweep.curvature) * farthest) + ROUNDING;
        OrientedBox enlarged = box;
        enlarged.halfLength = sweep.halfLength + moved;
        enlarged.halfWidth = sweep.halfWidth + moved;
        double first = HUGE_VAL;
        BoxSweep left = sweep;
        left.length += OVERRUN;
        const double c = box.cosine, s = box.sine;
        for (const BlockInBox &each : list)
        {
            if (each.gap(enlarged) > 0.0)
                continue;
            const Block &block = *each.block;
            for (std::size_t i = 0; i < block.edges; ++i)
            {
                const auto k = static_cast<Eigen::Index>(i);
                const double ax = block.ax[k] - box.x, ay = block.ay[k] - box.y;
                const double bx = block.bx[k] - box.x, by = block.by[k] - box.y;
                const double contact =
                    parking::firstContact(left, c * ax + s * ay, c * ay - s * ax, c * bx + s * by, c * by - s * bx);
                if (contact < first)
                {
                    first = contact;
                    left.length = contact;
                }
            }
        }
        return first;
    }

    /** firstContact() of the pieces, one after another. */
    double EdgeIndex::firstContactOfPieces(const OrientedBox &box, const BoxSweep &sweep, double middleCosine,
                                           double middleSine) const
    {
        // No enlarged corner lies farther out than this, see BodyPiece.
        const double more = sweep.halfLength - box.halfLength, cornerReach = 1.5 * more;
        BoxSweep around = sweep;
        around.halfLength = box.halfLength + cornerReach;
        around.halfWidth = box.halfWidth + cornerReach;
        const double farthest = std::hypot(std::abs(sweep.axle) + around.halfLength, around.halfWidth);
        const double moved = (sweep.length + OVERRUN) * (1.0 + std::abs(sweep.curvature) * farthest) + ROUNDING;
        OrientedBox enlarged = box;
        enlarged.halfLength = around.halfLength + moved;
        enlarged.halfWidth = around.halfWidth + moved;
        std::optional<SweepFront> area;
        if (SweepFront::applies(around))
            area.emplace(box, around, middleCosine, middleSine);
        const auto isNear = [&](const BlockInBox &each)
        {
            return area ? area->mayMeet(each.x, each.y, each.ex, each.ey) : each.gap(enlarged) <= 0.0;
        };
        const double sineOfTurn = 2.0 * middleSine * middleCosine;
        const double c = box.cosine, s = box.sine;
        const bool isFast = PieceFront::applies(sweep);
        BoxSweep left = sweep;
        left.length += isFast ? 0.0 : OVERRUN;
        double first = HUGE_VAL;
        for (const BodyPiece &piece : pieces_)
        {
            std::optional<PieceFront> front;
            if (isFast)
                front.emplace(piece, more, box, sweep, sineOfTurn);
            for (const BlockInBox &each : near(box.x, box.y))
            {
                if (!isNear(each))
                    continue;
                const Block &block = *each.block;
                const Eight gaps = area ? area->gap(block.ax, block.ay, block.bx, block.by) : Eight::Zero();
                for (std::size_t i = 0; i < block.edges; ++i)
                {
                    const auto k = static_cast<Eigen::Index>(i);
                    if (gaps[k] > 0.0)
                        continue;
                    if (front)
                    {
                        front->meet(block.ax[k], block.ay[k], block.bx[k], block.by[k], block.nx[k], block.ny[k]);
                        continue;
                    }
                    const double ax = block.ax[k] - box.x, ay = block.ay[k] - box.y;
                    const double bx = block.bx[k] - box.x, by = block.by[k] - box.y;
                    left.length =
                        std::min(left.length, parking::firstContact(left, piece, more, c * ax + s * ay, c * ay - s * ax,
                                                                    c * bx + s * by, c * by - s * bx));
                }
            }
            first = std::min(first, front                                  ? front->contact()
                                    : left.length < sweep.length + OVERRUN ? left.length
                                                                           : HUGE_VAL);
        }
        return first;
    }

    double EdgeIndex::distance(double x, double y) const
    {
        double smallest = HUGE_VAL;  // squared
        for (const BlockInBox &each : near(x, y))
            if (squaredDistanceToBox(x - each.x, y - each.y, each.ex, each.ey) < smallest)
                smallest = std::min(smallest, each.block->squaredDistance(x, y));
        return std::sqrt(smallest);
    }

    double EdgeIndex::nearest(const List &list, const OrientedBox &box, double smallest) const
    {
        for (const BlockInBox &each : list)
        {
            if (each.gap(box) >= smallest)
                continue;
            const Block &block = *each.block;
            for (std::size_t i = 0; i < block.edges; ++i)
            {
                const auto k = static_cast<Eigen::Index>(i);
                smallest = std::min(smallest, distanceOf(box, {{block.ax[k], block.ay[k]}, {block.bx[k], block.by[k]}},
                                                         {block.nx[k], block.ny[k]}));
            }
        }
        return smallest;
    }

    double EdgeIndex::distance(const OrientedBox &box) const
    {
        return nearest(near(box.x, box.y), box, HUGE_VAL);
    }

    double EdgeIndex::distanceToAll(const OrientedBox &box) const
    {
        const double circumradius = std::hypot(box.halfLength, box.halfWidth);
        double smallest = HUGE_VAL;
        const auto look = [&](std::size_t column, std::size_t row)
        {
            smallest = nearest(cellAt(column, row).boxes, box, smallest);
        };
        // Rings of cells about the centre, until the next ring is too far away.
        const std::size_t column = clampTo((box.x - origin_.x()) / cellSize_, cellColumns_);
        const std::size_t row = clampTo((box.y - origin_.y()) / cellSize_, cellRows_);
        const std::size_t rings = std::max(cellColumns_, cellRows_);
        for (std::size_t ring = 0; ring < rings; ++ring)
        {
            if (ring > 1 && static_cast<double>(ring - 1) * cellSize_ - circumradius > smallest)
                break;
            const std::size_t left = column - std::min(column, ring), right = std::min(cellColumns_ - 1, column + ring);
            const std::size_t low = row - std::min(row, ring), high = std::min(cellRows_ - 1, row + ring);
            for (std::size_t r = low; r <= high; ++r)
            {
                // Only the two ends of the rows in between belong to the ring.
                const bool whole = r + ring == row || r == row + ring;
                for (std::size_t c = left; whole && c <= right; ++c)
                    look(c, r);
                if (!whole && column >= ring)
                    look(column - ring, r);
                if (!whole && ring > 0 && column + ring < cellColumns_)
                    look(column + ring, r);
            }
        }
        return smallest;
    }
}  // namespace parking
