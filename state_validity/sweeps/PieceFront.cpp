#include "state_validity/sweeps/PieceFront.h"

#include <algorithm>
#include <limits>

namespace parking
{
    namespace
    {
        // Arcs of a larger radius in metres lose digits relative to their centre.
        constexpr double MAX_RADIUS = 1e4;
        constexpr double MAX_TURN = 1.01;  // radians
    }                                      // namespace

    bool PieceFront::applies(const BoxSweep &sweep)
    {
        const double curvature = std::abs(sweep.curvature);
        return curvature == 0.0 || (curvature * MAX_RADIUS >= 1.0 && curvature * sweep.length <= MAX_TURN);
    }

    PieceFront::PieceFront(const BodyPiece &piece, double more, const OrientedBox &box, const BoxSweep &sweep,
                           double sineOfTurn)
      : straight_(sweep.curvature == 0.0),
        turning_(sweep.curvature * sweep.direction < 0.0 ? -1.0 : 1.0),
        dx_(sweep.direction * box.cosine),
        dy_(sweep.direction * box.sine),
        lx_(-turning_ * dy_),
        ly_(turning_ * dx_)
    {
        // The centre in the frame of the motion, relative to the centre of the box.
        const double axle = straight_ ? 0.0 : sweep.direction * sweep.axle;
        radius_ = straight_ ? 0.0 : 1.0 / std::abs(sweep.curvature);
        cx_ = box.x + axle * dx_ + radius_ * lx_;
        cy_ = box.y + axle * dy_ + radius_ * ly_;
        limit_ = straight_ ? sweep.length + OVERRUN : sineOfTurn + OVERRUN / radius_;
        const double across = turning_ * sweep.direction;
        const std::size_t count = piece.sides.size();
        std::array<Corner, MAX_SIDES> all;
        for (std::size_t i = 0; i < count; ++i)
        {
            const Eigen::Vector2d corner = piece.corner(i, more);
            Corner &each = all[i];
            each.x = sweep.direction * corner.x() - axle;
            each.y = across * corner.y() - radius_;
            each.square = each.x * each.x + each.y * each.y;
        }
        nearest_ = std::numeric_limits<double>::infinity();
        farthest_ = 0.0;
        std::array<bool, MAX_SIDES> leads;
        std::fill(leads.begin(), leads.begin() + count, false);
        for (std::size_t i = 0; i < count; ++i)
        {
            const std::size_t next = i + 1 < count ? i + 1 : 0;
            const Eigen::Vector2d &normal = piece.sides[i].normal;
            addSide({sweep.direction * normal.x(), across * normal.y()}, all[i], all[next], leads[i], leads[next]);
        }
        for (std::size_t i = 0; i < count; ++i)
            if (leads[i])
                corners_[cornerCount_++] =
                    straight_ ? all[i]
                              : Corner{all[i].x * dx_ + all[i].y * lx_, all[i].x * dy_ + all[i].y * ly_, all[i].square};
    }

    /** Adds the leading part of the side from \e a to \e b, if there is one, and notes which of the two are its ends.
     */
    void PieceFront::addSide(const Eigen::Vector2d &normal, const Corner &a, const Corner &b, bool &leadsA,
                             bool &leadsB)
    {
        Part part{};
        part.nx = normal.x();
        part.ny = normal.y();
        if (straight_)
        {
            if (part.nx <= 0.0)
                return;
            leadsA = leadsB = true;
            const Corner &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
            part.low = low.y;
            part.high = high.y;
            part.x = low.x;
            part.slope = high.y > low.y ? (high.x - low.x) / (high.y - low.y) : 0.0;
        }
        else
        {
            // Positions along the side from the foot of the centre, positive in the direction of the turn.
            const double alongA = part.nx * a.y - part.ny * a.x, alongB = part.nx * b.y - part.ny * b.x;
            leadsA = leadsA || alongA < 0.0;
            leadsB = leadsB || alongB < 0.0;
            if (std::min(alongA, alongB) >= 0.0)
                return;
            part.distance = part.nx * a.x + part.ny * a.y;
            part.high = alongA < alongB ? a.square : b.square;
            part.low = std::max(alongA, alongB) >= 0.0 ? part.distance * part.distance
                       : alongA < alongB               ? b.square
                                                       : a.square;
        }
        nearest_ = std::min(nearest_, part.low);
        farthest_ = std::max(farthest_, part.high);
        parts_[partCount_++] = part;
    }

    inline void PieceFront::noteTurn(double sineTimesSquare, double cosineTimesSquare, double square)
    {
        if (sineTimesSquare >= 0.0 && sineTimesSquare <= limit_ * square && cosineTimesSquare > 0.0)
        {
            limit_ = sineTimesSquare / square;
            met_ = true;
        }
    }

    inline void PieceFront::noteDistance(double distance)
    {
        if (distance >= 0.0 && distance <= limit_)
        {
            limit_ = distance;
            met_ = true;
        }
    }

    /** A point in the frame of the motion. */
    inline void PieceFront::meetPoint(double ux, double uy)
    {
        if (straight_)
        {
            for (std::size_t i = 0; i < partCount_; ++i)
                if (const Part &part = parts_[i]; uy >= part.low && uy <= part.high)
                    noteDistance(ux - part.x - part.slope * (uy - part.low));
            return;
        }
        const double square = ux * ux + uy * uy;
        if (square < nearest_ || square > farthest_)
            return;
        for (std::size_t i = 0; i < partCount_; ++i)
        {
            const Part &part = parts_[i];
            if (square < part.low || square > part.high)
                continue;
            const double behind = std::sqrt(std::max(0.0, square - part.distance * part.distance));
            const double qx = part.distance * part.nx + behind * part.ny;
            const double qy = part.distance * part.ny - behind * part.nx;
            noteTurn(qx * uy - qy * ux, qx * ux + qy * uy, square);
        }
    }

    void PieceFront::meet(double ax, double ay, double bx, double by, double nx, double ny)
    {
        const double awx = ax - cx_, awy = ay - cy_, bwx = bx - cx_, bwy = by - cy_;
        const double aux = awx * dx_ + awy * dy_, auy = awx * lx_ + awy * ly_;
        const double bux = bwx * dx_ + bwy * dy_, buy = bwx * lx_ + bwy * ly_;
        meetPoint(aux, auy);
        meetPoint(bux, buy);
        if (straight_)
        {
            for (std::size_t i = 0; i < cornerCount_; ++i)
                if (const Corner &corner = corners_[i]; (auy < corner.y) != (buy < corner.y))
                    noteDistance(aux + (bux - aux) * (corner.y - auy) / (buy - auy) - corner.x);
            return;
        }
        const double distance = nx * awx + ny * awy, square = distance * distance;
        if (square > farthest_)
            return;
        // Places on the edge's line are given by their distance from the foot of the centre, positive to the edge's
        // left.
        constexpr double SLACK = 1e-11;
        const double a = nx * awy - ny * awx, b = nx * bwy - ny * bwx;
        const double from = (a < b ? a : b) - SLACK, to = (a < b ? b : a) + SLACK;
        // Most corners pass the edge at another distance from the centre, which the squares tell without a root.
        const double most = std::max(from * from, to * to);
        const double least = from <= 0.0 && to >= 0.0 ? 0.0 : std::min(from * from, to * to);
        for (std::size_t i = 0; i < cornerCount_; ++i)
        {
            const Corner &corner = corners_[i];
            const double squareOfHalf = corner.square - square;
            if (squareOfHalf < least || squareOfHalf > most)
                continue;
            const double half = std::sqrt(squareOfHalf);
            const double across = corner.x * nx + corner.y * ny, along = corner.y * nx - corner.x * ny;
            if (half >= from && half <= to)
                noteTurn(turning_ * (half * across - distance * along), distance * across + half * along,
                         corner.square);
            if (-half >= from && -half <= to)
                noteTurn(turning_ * (-half * across - distance * along), distance * across - half * along,
                         corner.square);
        }
    }

    double PieceFront::contact() const
    {
        if (!met_)
            return std::numeric_limits<double>::infinity();
        return straight_ ? limit_ : std::asin(std::min(1.0, limit_)) * radius_;
    }
}  // namespace parking
