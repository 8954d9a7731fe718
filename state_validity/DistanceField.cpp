#include "state_validity/DistanceField.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

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

    DistanceField::DistanceField(const ObstacleSet &obstacles, double resolution)
    {
        std::vector<std::uint8_t> blocked;
        const Eigen::Vector2d size = obstacles.bounds().size();
        if (obstacles.cellSize() > 0.0)
        {
            // One ring of blocked cells represents the outside of the map.
            resolution_ = obstacles.cellSize();
            isGrid_ = true;
            columns_ = obstacles.columns() + 2;
            rows_ = obstacles.rows() + 2;
            origin_ = Eigen::Vector2d(-resolution_, -resolution_);
            blocked.assign(columns_ * rows_, INSIDE);
            for (std::size_t row = 0; row < obstacles.rows(); ++row)
                for (std::size_t column = 0; column < obstacles.columns(); ++column)
                    blocked[(row + 1) * columns_ + column + 1] =
                        obstacles.cells()[row * obstacles.columns() + column] ? INSIDE : FREE;
        }
        else
        {
            if (resolution == 0.0)
                resolution = std::max(MIN_CHOSEN_RESOLUTION, std::sqrt(size.x() * size.y() / CHOSEN_CELLS));
            Require("distance field").positive("resolution", resolution, "metres");
            if (size.x() / resolution * (size.y() / resolution) > MAX_CELLS)
                throw Error(
                    "resolution of " + std::to_string(resolution) +
                    " m is too fine for a world of this size: the distance field would need more than 2^28 cells");
            resolution_ = resolution;
            columns_ = static_cast<std::size_t>(std::ceil(size.x() / resolution)) + 2;
            rows_ = static_cast<std::size_t>(std::ceil(size.y() / resolution)) + 2;
            origin_ = obstacles.bounds().min - Eigen::Vector2d(resolution, resolution);
            blocked.assign(columns_ * rows_, FREE);
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
        }
        transform(blocked);
    }

    void DistanceField::transform(const std::vector<std::uint8_t> &blocked)
    {
        inverse_ = 1.0 / resolution_;
        width_ = static_cast<double>(columns_);
        height_ = static_cast<double>(rows_);
        // Slightly more than a diagonal, because cells that an outline misses by rounding are marked too.
        error_ = std::sqrt(2.0) * resolution_ * (1.0 + 1e-5);
        values_.resize(columns_ * rows_);

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
