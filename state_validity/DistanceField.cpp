#include "state_validity/DistanceField.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double MAX_CELLS = 268435456.0;      // 2^28: a gigabyte of floats
        constexpr double CHOSEN_CELLS = 1e6;           // of a polygon world with automatic resolution
        constexpr double MIN_CHOSEN_RESOLUTION = 0.1;  // metres

        constexpr std::uint8_t FREE = 0, TOUCHED = 1, INSIDE = 2;

        /** Marks the cells of a grid that edges touch and those inside of polygons. */
        class Rasteriser
        {
        public:
            Rasteriser(std::vector<std::uint8_t> &cells, std::size_t columns, std::size_t rows, double resolution,
                       const Eigen::Vector2d &origin)
              : cells_(cells),
                columns_(columns),
                rows_(rows),
                resolution_(resolution),
                origin_(origin)
            {
            }

            /** Marks every cell that the edge touches or misses only by rounding. */
            void drawEdge(const Edge &edge)
            {
                Eigen::Vector2d a = (edge.from - origin_) / resolution_, b = (edge.to - origin_) / resolution_;
                if (a.y() > b.y())
                    std::swap(a, b);
                const long lastRow = clampRow(b.y() + SLACK);
                for (long row = clampRow(a.y() - SLACK); row <= lastRow; ++row)
                {
                    // The part of the edge between the lower and the upper line of this row.
                    const double low = std::clamp(static_cast<double>(row) - SLACK, a.y(), b.y());
                    const double high = std::clamp(static_cast<double>(row) + 1.0 + SLACK, a.y(), b.y());
                    double x0 = a.x(), x1 = b.x();
                    if (b.y() > a.y())
                    {
                        const double slope = (b.x() - a.x()) / (b.y() - a.y());
                        x0 = a.x() + slope * (low - a.y());
                        x1 = a.x() + slope * (high - a.y());
                        // Rounding of a nearly horizontal edge must not exceed the bounding box of the edge.
                        const double left = std::min(a.x(), b.x()), right = std::max(a.x(), b.x());
                        x0 = std::clamp(x0, left, right);
                        x1 = std::clamp(x1, left, right);
                    }
                    const long last = clampColumn(std::max(x0, x1) + SLACK);
                    for (long column = clampColumn(std::min(x0, x1) - SLACK); column <= last; ++column)
                        cells_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)] = TOUCHED;
                }
            }

            /** Marks the cells that lie entirely inside of the polygon: those with an inner centre that no edge
                touches. */
            void fill(const Polygon &polygon)
            {
                double low = std::numeric_limits<double>::infinity(), high = -low;
                for (const Eigen::Vector2d &corner : polygon)
                {
                    low = std::min(low, (corner.y() - origin_.y()) / resolution_);
                    high = std::max(high, (corner.y() - origin_.y()) / resolution_);
                }
                std::vector<double> crossings;
                for (long row = clampRow(low); row <= clampRow(high); ++row)
                {
                    const double y = origin_.y() + (static_cast<double>(row) + 0.5) * resolution_;
                    crossings.clear();
                    for (std::size_t i = 0; i < polygon.size(); ++i)
                    {
                        const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                        if ((a.y() > y) != (b.y() > y))
                            crossings.push_back(
                                (a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()) - origin_.x()) / resolution_);
                    }
                    std::sort(crossings.begin(), crossings.end());
                    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
                        for (long column = clampColumn(crossings[i] - 0.5);
                             column <= clampColumn(crossings[i + 1] + 0.5); ++column)
                        {
                            const double centre = static_cast<double>(column) + 0.5;
                            std::uint8_t &cell =
                                cells_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)];
                            if (cell == FREE && centre > crossings[i] && centre < crossings[i + 1])
                                cell = INSIDE;
                        }
                }
            }

        private:
            static constexpr double SLACK = 1e-6;  // of a cell

            long clampRow(double row) const
            {
                return static_cast<long>(std::floor(std::clamp(row, 0.0, static_cast<double>(rows_ - 1))));
            }
            long clampColumn(double column) const
            {
                return static_cast<long>(std::floor(std::clamp(column, 0.0, static_cast<double>(columns_ - 1))));
            }

            std::vector<std::uint8_t> &cells_;
            std::size_t columns_, rows_;
            double resolution_;
            Eigen::Vector2d origin_;
        };
    }  // namespace

    /** The field of a grid world with a limited reach: both passes of the transform on a part of the map.

        The passes are those of transform(), on small integers. Heights and squares are limited by the reach, so a cell
        depends on the cells within reach only, and several are computed per instruction. */
    class DistanceField::Transform
    {
    public:
        Transform(DistanceField &field, const ObstacleSet &obstacles)
          : field_(field),
            cells_(obstacles.cells()),
            reach_(static_cast<std::size_t>(field.reachCells_))
        {
        }

        void all()
        {
            // The ring of blocked cells has height 0.
            field_.heights_.assign(field_.columns_ * field_.rows_, 0);
            for (std::size_t column = 1; column + 1 < field_.columns_; column += STRIP)
                updateHeights(column, 1, field_.rows_ - 1);
            for (std::size_t row = 0; row < field_.rows_; ++row)
                updateRow(row, 0, field_.columns_);
        }

        void around(const std::vector<std::size_t> &changed)
        {
            const std::size_t columns = field_.columns_ - 2;
            std::vector<std::pair<std::size_t, std::size_t>> places;  // first column of the strip and row, in the field
            for (const std::size_t index : changed)
            {
                const std::pair<std::size_t, std::size_t> place{index % columns / STRIP * STRIP + 1,
                                                                index / columns + 1};
                if (places.empty() || places.back() != place)
                    places.push_back(place);
            }
            std::sort(places.begin(), places.end());
            // A changed cell changes heights less than the reach above and below it.
            for (std::size_t k = 0; k < places.size();)
            {
                const auto [column, row] = places[k];
                const std::size_t low = row - std::min(row - 1, reach_ - 1);
                std::size_t high = row;
                for (; k < places.size() && places[k].first == column && places[k].second < high + 2 * reach_; ++k)
                    high = places[k].second;
                updateHeights(column, low, std::min(high + reach_, field_.rows_ - 1));
            }
            updateRows();
        }

    private:
        static constexpr std::size_t STRIP = 64;  // columns whose heights are computed together
        static constexpr std::size_t BLOCK = 32;  // cells of a row that are computed together

        /** Columns of a row whose values depend on changed heights. */
        struct Interval
        {
            std::size_t row, begin, end;
        };

        /** Computes the heights of up to STRIP columns from \e left on, in the rows from \e low up to but excluding
            \e high, and stores where they have changed. The row on either side must be up to date. */
        void updateHeights(std::size_t left, std::size_t low, std::size_t high)
        {
            const std::size_t columns = field_.columns_, width = std::min(STRIP, columns - 1 - left);
            const auto farthest = static_cast<std::uint8_t>(reach_);
            const auto step = [farthest](std::uint8_t height)
            {
                return std::min(static_cast<std::uint8_t>(height + 1), farthest);
            };
            strip_.resize((high - low) * STRIP);
            const std::uint8_t *below = &field_.heights_[(low - 1) * columns + left];
            for (std::size_t row = low; row < high; ++row)
            {
                std::uint8_t *line = &strip_[(row - low) * STRIP];
                const std::uint8_t *blocked = &cells_[(row - 1) * (columns - 2) + left - 1];
                for (std::size_t i = 0; i < width; ++i)
                    line[i] = blocked[i] != 0 ? std::uint8_t{0} : step(below[i]);
                below = line;
            }
            const std::uint8_t *above = &field_.heights_[high * columns + left];
            for (std::size_t row = high; row-- > low;)
            {
                std::uint8_t *line = &strip_[(row - low) * STRIP];
                for (std::size_t i = 0; i < width; ++i)
                    line[i] = std::min(line[i], step(above[i]));
                above = line;
                replace(row, left, line, width);
            }
        }

        /** Stores heights of a row, and which of its values they may change. */
        void replace(std::size_t row, std::size_t left, const std::uint8_t *line, std::size_t width)
        {
            std::uint8_t *known = &field_.heights_[row * field_.columns_ + left];
            if (std::equal(line, line + width, known))
                return;
            std::size_t first = width, last = 0;
            std::uint8_t least = 255;
            for (std::size_t i = 0; i < width; ++i)
                if (line[i] != known[i])
                {
                    first = std::min(first, i);
                    last = i;
                    least = std::min({least, line[i], known[i]});
                }
            std::copy(line, line + width, known);
            // Farther columns are beyond the reach of both the old and the new height.
            const auto around = static_cast<std::size_t>(std::sqrt(reach_ * reach_ - std::size_t{least} * least));
            const std::size_t begin = left + first, end = left + last + 1;
            changed_.push_back({row, begin - std::min(begin, around), std::min(end + around, field_.columns_)});
        }

        /** Computes the values that depend on changed heights. */
        void updateRows()
        {
            if (changed_.empty())
                return;
            std::size_t low = changed_.front().row, high = low;
            for (const Interval &each : changed_)
            {
                low = std::min(low, each.row);
                high = std::max(high, each.row);
            }
            // A counting sort by rows. It keeps the order of the strips, from left to right.
            std::vector<std::size_t> first(high - low + 2, 0);
            for (const Interval &each : changed_)
                ++first[each.row - low + 1];
            for (std::size_t k = 1; k < first.size(); ++k)
                first[k] += first[k - 1];
            std::vector<Interval> sorted(changed_.size());
            for (const Interval &each : changed_)
                sorted[first[each.row - low]++] = each;
            for (std::size_t k = 0; k < sorted.size();)
            {
                Interval joined = sorted[k];
                for (++k; k < sorted.size() && sorted[k].row == joined.row && sorted[k].begin <= joined.end; ++k)
                {
                    joined.begin = std::min(joined.begin, sorted[k].begin);
                    joined.end = std::max(joined.end, sorted[k].end);
                }
                updateRow(joined.row, joined.begin, joined.end);
            }
        }

        /** Computes the values of a row from \e begin up to but excluding \e end. */
        void updateRow(std::size_t row, std::size_t begin, std::size_t end)
        {
            // Squared heights with as many cells on each side as a value depends on. Beyond the field there are none.
            const auto farthest = static_cast<std::int16_t>(reach_ * reach_);
            const std::size_t blocks = (end - begin + BLOCK - 1) / BLOCK;
            squares_.assign(blocks * BLOCK + 2 * reach_, farthest);
            const std::size_t left = begin - std::min(begin, reach_), right = std::min(end + reach_, field_.columns_);
            const std::uint8_t *heights = &field_.heights_[row * field_.columns_];
            for (std::size_t column = left; column < right; ++column)
                squares_[column + reach_ - begin] = static_cast<std::int16_t>(heights[column] * heights[column]);
            for (std::size_t block = 0; block < blocks; ++block)
            {
                const std::int16_t *const middle = &squares_[block * BLOCK + reach_];
                std::int16_t nearest[BLOCK];
                std::copy(middle, middle + BLOCK, nearest);
                for (std::size_t k = 1; k < reach_; ++k)
                {
                    const auto square = static_cast<std::int16_t>(k * k);
                    if (k % 8 == 1 && largest(nearest) <= square)
                        break;
                    const std::int16_t *const lower = middle - k, *const upper = middle + k;
                    for (std::size_t i = 0; i < BLOCK; ++i)
                        nearest[i] =
                            std::min(nearest[i], static_cast<std::int16_t>(std::min(lower[i], upper[i]) + square));
                }
                float *const values = &field_.values_[row * field_.columns_ + begin + block * BLOCK];
                const std::size_t count = std::min(BLOCK, end - begin - block * BLOCK);
                for (std::size_t i = 0; i < count; ++i)
                    values[i] = field_.ofSquare_[static_cast<std::size_t>(nearest[i])];
            }
        }

        static std::int16_t largest(const std::int16_t *values)
        {
            std::int16_t most = 0;
            for (std::size_t i = 0; i < BLOCK; ++i)
                most = std::max(most, values[i]);
            return most;
        }

        DistanceField &field_;
        const std::vector<std::uint8_t> &cells_;
        std::size_t reach_;                  // in cells
        std::vector<std::uint8_t> strip_;    // heights
        std::vector<Interval> changed_;      // in no order of rows, but from left to right in each
        std::vector<std::int16_t> squares_;  // of heights
    };

    DistanceField::DistanceField(const ObstacleSet &obstacles, double resolution, double reach)
    {
        if (!(reach > 0.0))
            throw Error("the reach of a distance field must be above 0 m, not " + formatNumber(reach) + " m");
        const Eigen::Vector2d size = obstacles.bounds().size();
        if (obstacles.cellSize() > 0.0)
        {
            // One ring of blocked cells represents the outside of the map.
            resolution = obstacles.cellSize();
            isGrid_ = true;
            prepare(resolution, obstacles.columns() + 2, obstacles.rows() + 2, {-resolution, -resolution});
            // Each point is at most half the shorter side from the outside.
            farthest_ = 0.5 * size.minCoeff() * (1.0 + 1e-9);
            if (std::isfinite(reach))
                limit(reach);
            transformGrid(obstacles);
            return;
        }
        if (resolution == 0.0)
            resolution = std::max(MIN_CHOSEN_RESOLUTION, std::sqrt(size.x() * size.y() / CHOSEN_CELLS));
        Require("distance field").positive("resolution", resolution, "metres");
        if (size.x() / resolution * (size.y() / resolution) > MAX_CELLS)
            throw Error("resolution of " + std::to_string(resolution) +
                        " m is too fine for a world of this size: the distance field would need more than 2^28 cells");
        prepare(resolution, static_cast<std::size_t>(std::ceil(size.x() / resolution)) + 2,
                static_cast<std::size_t>(std::ceil(size.y() / resolution)) + 2,
                obstacles.bounds().min - Eigen::Vector2d(resolution, resolution));
        std::vector<std::uint8_t> blocked(columns_ * rows_, FREE);
        Rasteriser raster(blocked, columns_, rows_, resolution_, origin_);
        for (const Edge &edge : obstacles.edges())
            raster.drawEdge(edge);
        for (const Polygon &polygon : obstacles.polygons())
            raster.fill(polygon);
        // The ring outside of the bounds. Its inner neighbours touch the outline of the bounds and do not change.
        for (std::size_t column = 0; column < columns_; ++column)
            for (const std::size_t row : {std::size_t{0}, rows_ - 1})
                if (blocked[row * columns_ + column] == FREE)
                    blocked[row * columns_ + column] = INSIDE;
        for (std::size_t row = 0; row < rows_; ++row)
            for (const std::size_t column : {std::size_t{0}, columns_ - 1})
                if (blocked[row * columns_ + column] == FREE)
                    blocked[row * columns_ + column] = INSIDE;
        transform(blocked);
    }

    void DistanceField::prepare(double resolution, std::size_t columns, std::size_t rows, const Eigen::Vector2d &origin)
    {
        resolution_ = resolution;
        inverse_ = 1.0 / resolution;
        columns_ = columns;
        rows_ = rows;
        width_ = static_cast<double>(columns);
        height_ = static_cast<double>(rows);
        origin_ = origin;
        // Slightly more than a diagonal, because cells that an outline misses by rounding are marked too.
        error_ = std::sqrt(2.0) * resolution_ * (1.0 + 1e-5);
        values_.resize(columns_ * rows_);
    }

    void DistanceField::limit(double reach)
    {
        const double cells = std::clamp(std::floor(reach / resolution_ + 1e-9), 1.0, static_cast<double>(MAX_REACH));
        reachCells_ = static_cast<int>(cells);
        for (int square = 0; square <= reachCells_ * reachCells_; ++square)
            ofSquare_.push_back(static_cast<float>(std::sqrt(static_cast<double>(square)) * resolution_));
        reach_ = static_cast<double>(ofSquare_.back());
        ofSquare_.front() = -1.0f;  // inside of an obstacle
    }

    void DistanceField::update(const ObstacleSet &obstacles, const std::vector<std::size_t> &changed)
    {
        if (reachCells_ > 0)
            Transform(*this, obstacles).around(changed);
        else
            transformGrid(obstacles);
    }

    void DistanceField::transformGrid(const ObstacleSet &obstacles)
    {
        if (reachCells_ > 0)
        {
            Transform(*this, obstacles).all();
            return;
        }
        std::vector<std::uint8_t> blocked(columns_ * rows_, INSIDE);
        for (std::size_t row = 0; row < obstacles.rows(); ++row)
            for (std::size_t column = 0; column < obstacles.columns(); ++column)
                blocked[(row + 1) * columns_ + column + 1] =
                    obstacles.cells()[row * obstacles.columns() + column] ? INSIDE : FREE;
        transform(blocked);
    }

    void DistanceField::transform(const std::vector<std::uint8_t> &blocked)
    {
        // Down and up each column, row by row to stay in the cache: distance in cells along the column.
        for (std::size_t column = 0; column < columns_; ++column)
            values_[column] = 0.0f;  // of the outside, which is blocked
        for (std::size_t row = 1; row < rows_; ++row)
        {
            const float *below = &values_[(row - 1) * columns_];
            float *line = &values_[row * columns_];
            const std::uint8_t *marks = &blocked[row * columns_];
            for (std::size_t column = 0; column < columns_; ++column)
                line[column] = marks[column] ? 0.0f : below[column] + 1.0f;
        }
        for (std::size_t row = rows_ - 1; row-- > 0;)
        {
            const float *above = &values_[(row + 1) * columns_];
            float *line = &values_[row * columns_];
            for (std::size_t column = 0; column < columns_; ++column)
                line[column] = std::min(line[column], above[column] + 1.0f);
        }

        // Along each row: lower envelope of the parabolas (x - i)^2 + d(i)^2.
        std::vector<double> heights(columns_), starts(columns_ + 1);
        std::vector<std::size_t> parabolas(columns_);
        for (std::size_t row = 0; row < rows_; ++row)
        {
            float *line = &values_[row * columns_];
            std::size_t count = 0;
            for (std::size_t i = 0; i < columns_; ++i)
            {
                const double x = static_cast<double>(i);
                const double height = static_cast<double>(line[i]) * static_cast<double>(line[i]) + x * x;
                double start = -std::numeric_limits<double>::infinity();
                while (count > 0)
                {
                    const double other = static_cast<double>(parabolas[count - 1]);
                    start = (height - heights[count - 1]) / (2.0 * (x - other));
                    if (start > starts[count - 1])
                        break;
                    --count;
                    start = -std::numeric_limits<double>::infinity();
                }
                parabolas[count] = i;
                heights[count] = height;
                starts[count] = start;
                ++count;
            }
            starts[count] = std::numeric_limits<double>::infinity();
            std::size_t k = 0;
            const std::uint8_t *marks = &blocked[row * columns_];
            for (std::size_t column = 0; column < columns_; ++column)
            {
                const double x = static_cast<double>(column);
                while (starts[k + 1] < x)
                    ++k;
                if (marks[column])
                {
                    // Distinguishes a cell inside of an obstacle from one that an outline only touches.
                    line[column] = marks[column] == INSIDE ? -1.0f : 0.0f;
                    continue;
                }
                const double dx = x - static_cast<double>(parabolas[k]);
                const double square =
                    heights[k] - static_cast<double>(parabolas[k]) * static_cast<double>(parabolas[k]);
                line[column] = static_cast<float>(std::sqrt(dx * dx + square) * resolution_);
            }
        }
    }
}  // namespace parking
