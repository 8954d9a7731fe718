#include "state_validity/sweeps/SweptBox.h"

#include <cmath>
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
    }  // namespace

    double firstContact(const BoxSweep &sweep, double ax, double ay, double bx, double by)
    {
        // A drive in reverse is the mirror image (x becomes -x) of a drive forwards with the same curvature. All
        // coordinates are relative to the rear axle.
        const double k = sweep.curvature, axle = sweep.axle * sweep.direction;
        const double front = sweep.halfLength - axle, back = -sweep.halfLength - axle, side = sweep.halfWidth;
        ax = ax * sweep.direction - axle;
        bx = bx * sweep.direction - axle;
        const double halfTurn = 0.5 * std::abs(k) * sweep.length * (1.0 + 1e-12);
        const double start = halfTurn < 1e-8 ? 0.5 * sweep.length * (1.0 + 1e-12) : std::tan(halfTurn) / std::abs(k);
        double limit = start;

        // With q = tan(turn / 2) / k and w = 1 + k^2 q^2: cosine = (1 - k^2 q^2) / w, sine = 2 k q / w. The axle is at
        // (2 q, 2 k q^2) / w.
        for (const auto &[px, py] : {std::pair<double, double>{ax, ay}, {bx, by}})
        {
            for (const double x : {back, front})
                solve(-k * k * (px + x), k * py - 1.0, px - x, limit,
                      [&, px = px, py = py](double q)
                      {
                          const double square = k * k * q * q;
                          const double y = (1.0 - square) * py - 2.0 * k * q * px + 2.0 * k * q * q;
                          return std::abs(y) <= side * (1.0 + square);
                      });
            for (const double y : {-side, side})
                solve(k * (2.0 - k * (py + y)), -k * px, py - y, limit,
                      [&, px = px, py = py](double q)
                      {
                          const double square = k * k * q * q;
                          const double x = (1.0 - square) * px + 2.0 * k * q * py - 2.0 * q;
                          return x >= back * (1.0 + square) && x <= front * (1.0 + square);
                      });
        }

        const double ex = bx - ax, ey = by - ay;
        const double nx = -ey, ny = ex;
        const double offset = nx * ax + ny * ay;
        const double square = ex * ex + ey * ey;
        for (const double vx : {back, front})
            for (const double vy : {-side, side})
            {
                const double height = nx * vx + ny * vy;
                solve(k * (2.0 * ny - k * (height + offset)), nx * (1.0 - k * vy) + ny * k * vx, height - offset, limit,
                      [&, vx = vx, vy = vy](double q)
                      {
                          const double kq = k * q, scale = 1.0 / (1.0 + kq * kq);
                          const double x = (2.0 * q + (1.0 - kq * kq) * vx - 2.0 * kq * vy) * scale;
                          const double y = (2.0 * kq * q + 2.0 * kq * vx + (1.0 - kq * kq) * vy) * scale;
                          const double along = ex * (x - ax) + ey * (y - ay);
                          return along >= 0.0 && along <= square;
                      });
            }
        if (!(limit < start))
            return std::numeric_limits<double>::infinity();
        const double tangent = std::abs(k) * limit;
        return tangent < 1e-8 ? 2.0 * limit : 2.0 * std::atan(tangent) / std::abs(k);
    }
}  // namespace parking
