#include "state_validity/sweeps/SweptBox.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace parking
{
    namespace
    {
        /** Tests the roots of A q^2 + 2 B q + C = 0 in [0, limit) with \e accept. The smallest accepted one becomes the
            limit. */
        template <class Accept>
        void solve(double A, double B, double C, double &limit, const Accept &accept)
        {
            const double discriminant = B * B - A * C;
            if (!(discriminant >= 0.0))
                return;
            // Without cancellation: the root of larger magnitude first, the other one from the product of both.
            const double w = -(B + std::copysign(std::sqrt(discriminant), B));
            for (const auto &[numerator, denominator] : {std::pair<double, double>{w, A}, {C, w}})
            {
                if (denominator == 0.0)
                    continue;
                const double q = numerator / denominator;
                if (q >= 0.0 && q < limit && accept(q))
                    limit = q;
            }
        }

        /** The first contact of sides and corners of a moving body with a segment.

            A drive in reverse is the mirror image (x becomes -x) of a drive forwards with the same curvature. All
            coordinates are relative to the rear axle. With q = tan(turn / 2) / k and w = 1 + k^2 q^2: cosine =
            (1 - k^2 q^2) / w, sine = 2 k q / w. The axle is at (2 q, 2 k q^2) / w. */
        class Contact
        {
        public:
            Contact(const BoxSweep &sweep, double ax, double ay, double bx, double by)
              : k_(sweep.curvature),
                ax_((ax - sweep.axle) * sweep.direction),
                ay_(ay),
                bx_((bx - sweep.axle) * sweep.direction),
                by_(by)
            {
                const double halfTurn = 0.5 * std::abs(k_) * sweep.length * (1.0 + 1e-12);
                start_ = halfTurn < 1e-8 ? 0.5 * sweep.length * (1.0 + 1e-12) : std::tan(halfTurn) / std::abs(k_);
                limit_ = start_;
            }

            /** Contact of the ends of the segment with a side of the body: normal, and a point at either end. */
            void meetSide(double nx, double ny, double fromX, double fromY, double toX, double toY)
            {
                const double k = k_, offset = nx * fromX + ny * fromY;
                const double from = nx * fromY - ny * fromX, to = nx * toY - ny * toX;
                const double low = std::min(from, to), high = std::max(from, to);
                for (const auto &[px, py] : {std::pair<double, double>{ax_, ay_}, {bx_, by_}})
                    solve(k * (2.0 * ny - k * (nx * px + ny * py + offset)), nx * (k * py - 1.0) - ny * k * px,
                          nx * px + ny * py - offset, limit_,
                          [&, px = px, py = py](double q)
                          {
                              const double square = k * k * q * q;
                              const double x = (1.0 - square) * px + 2.0 * k * q * py - 2.0 * q;
                              const double y = (1.0 - square) * py - 2.0 * k * q * px + 2.0 * k * q * q;
                              const double along = nx * y - ny * x;
                              return along >= low * (1.0 + square) && along <= high * (1.0 + square);
                          });
            }

            /** Contact of a corner of the body with the segment. */
            void meetCorner(double vx, double vy)
            {
                const double k = k_, ex = bx_ - ax_, ey = by_ - ay_, nx = -ey, ny = ex;
                const double offset = nx * ax_ + ny * ay_, square = ex * ex + ey * ey;
                const double height = nx * vx + ny * vy;
                solve(k * (2.0 * ny - k * (height + offset)), nx * (1.0 - k * vy) + ny * k * vx, height - offset,
                      limit_,
                      [&](double q)
                      {
                          const double kq = k * q, scale = 1.0 / (1.0 + kq * kq);
                          const double x = (2.0 * q + (1.0 - kq * kq) * vx - 2.0 * kq * vy) * scale;
                          const double y = (2.0 * kq * q + 2.0 * kq * vx + (1.0 - kq * kq) * vy) * scale;
                          const double along = ex * (x - ax_) + ey * (y - ay_);
                          return along >= 0.0 && along <= square;
                      });
            }

            double length() const
            {
                if (!(limit_ < start_))
                    return std::numeric_limits<double>::infinity();
                const double tangent = std::abs(k_) * limit_;
                return tangent < 1e-8 ? 2.0 * limit_ : 2.0 * std::atan(tangent) / std::abs(k_);
            }

        private:
            double k_, ax_, ay_, bx_, by_;
            double start_, limit_;
        };
    }  // namespace

    double firstContact(const BoxSweep &sweep, double ax, double ay, double bx, double by)
    {
        const double axle = sweep.axle * sweep.direction;
        const double front = sweep.halfLength - axle, back = -sweep.halfLength - axle, side = sweep.halfWidth;
        Contact contact(sweep, ax, ay, bx, by);
        contact.meetSide(1.0, 0.0, back, -side, back, side);
        contact.meetSide(1.0, 0.0, front, -side, front, side);
        contact.meetSide(0.0, 1.0, back, -side, front, -side);
        contact.meetSide(0.0, 1.0, back, side, front, side);
        for (const double x : {back, front})
            for (const double y : {-side, side})
                contact.meetCorner(x, y);
        return contact.length();
    }

    double firstContact(const BoxSweep &sweep, const BodyPiece &piece, double more, double ax, double ay, double bx,
                        double by)
    {
        Contact contact(sweep, ax, ay, bx, by);
        for (std::size_t i = 0; i < piece.sides.size(); ++i)
        {
            const Eigen::Vector2d from = piece.corner(i, more), to = piece.corner(i + 1, more);
            const double fromX = (from.x() - sweep.axle) * sweep.direction;
            contact.meetSide(piece.sides[i].normal.x() * sweep.direction, piece.sides[i].normal.y(), fromX, from.y(),
                             (to.x() - sweep.axle) * sweep.direction, to.y());
            contact.meetCorner(fromX, from.y());
        }
        return contact.length();
    }
}  // namespace parking
