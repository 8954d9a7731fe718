#include "state_validity/FootprintChecker.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace parking
{
    namespace
    {
        // Edges this far from the body still enter clearances.
        constexpr double CLEARANCE_REACH = 1.0;
        constexpr std::size_t COVERING_CIRCLES = 6;
        constexpr double MAX_TURN = 1.0;  // radians swept at a time
        // Enlargement at a corner of the body relative to that of its sides: sqrt(2) with a reserve.
        constexpr double CORNER = 1.5;
        // Rounding of rotated coordinates within a few kilometres of the frame.
        constexpr double ROUNDING = 1e-11;
        // Bodies closer than this touch an obstacle. The rounding of coordinates is smaller up to 100 km from the
        // origin.
        constexpr double CONTACT = 0.5 * FootprintChecker::CONTACT_BAND;
        // Circles with this clearance imply a separation above CONTACT_BAND, so all tiers agree on contact.
        constexpr double CLEAR = CORNER * FootprintChecker::CONTACT_BAND;

        /** Largest distance of a point of the body from its centre. */
        double circumradiusOf(const Body &body)
        {
            if (body.pieces.empty())
                return std::hypot(body.halfLength, body.halfWidth);
            double radius = 0.0;
            for (const BodyPiece &piece : body.pieces)
                for (const BodyPiece::Side &side : piece.sides)
                    radius = std::max(radius, side.corner.norm());
            return radius;
        }

        std::shared_ptr<const IndexedObstacles> checked(std::shared_ptr<const IndexedObstacles> obstacles)
        {
            if (!obstacles)
                throw Error("footprint checker: the obstacles are missing");
            return obstacles;
        }
    }  // namespace

    CheckCounts &CheckCounts::operator+=(const CheckCounts &other)
    {
        states += other.states;
        byField += other.byField;
        byCircles += other.byCircles;
        byEdges += other.byEdges;
        byContactTest += other.byContactTest;
        return *this;
    }

    FootprintChecker::FootprintChecker(ObstacleSet obstacles, const Vehicle &vehicle, double margin,
                                       ContactTestMaker contact, double fieldResolution)
      : FootprintChecker(std::make_shared<const IndexedObstacles>(std::move(obstacles), fieldResolution), vehicle,
                         margin, std::move(contact))
    {
    }

    FootprintChecker::FootprintChecker(std::shared_ptr<const IndexedObstacles> obstacles, const Vehicle &vehicle,
                                       double margin, ContactTestMaker contact)
      : world_(checked(std::move(obstacles))),
        obstacles_(world_->obstacles()),
        field_(world_->field()),
        vehicle_(vehicle),
        margin_(margin),
        body_(vehicle, margin),
        centreOffset_(body_.centreOffset),
        halfLength_(body_.halfLength),
        halfWidth_(body_.halfWidth),
        circumradius_(circumradiusOf(body_) + CLEAR),
        inradius_(body_.depthAt(0.0) - ROUNDING),
        farthest_(std::hypot(std::max(std::abs(centreOffset_ + halfLength_), std::abs(centreOffset_ - halfLength_)),
                             halfWidth_)),
        index_(world_->edges(circumradius_ + CLEARANCE_REACH, body_.pieces)),
        edges_(*index_),
        makeContactTest_(std::move(contact))
    {
        const Eigen::Vector2d world = obstacles_.bounds().size();
        const double width = 2.0 * (body_.pieces.empty() ? halfWidth_ : vehicle.bodyRadius(margin));
        if (width > world.maxCoeff() || 2.0 * inradius_ > world.minCoeff())
            throw Error("the car of " + std::to_string(vehicle.length()) + " m x " + std::to_string(vehicle.width) +
                        " m with a safety margin of " + std::to_string(margin) + " m does not fit into the world of " +
                        std::to_string(world.x()) + " m x " + std::to_string(world.y()) + " m");

        const double half = halfLength_ / static_cast<double>(COVERING_CIRCLES);
        for (std::size_t i = 0; i < COVERING_CIRCLES; ++i)
        {
            const double offset = -halfLength_ + half * static_cast<double>(2 * i + 1);
            covering_.push_back({offset, body_.reachBetween(offset - half, offset + half) + CLEAR});
            // Near the bumpers the nearest side of the body is the bumper.
            inscribed_.push_back({offset, body_.depthAt(offset) - ROUNDING});
        }
    }

    OrientedBox FootprintChecker::boxAt(const Pose &local) const
    {
        return bodyAt(local, centreOffset_, halfLength_, halfWidth_);
    }

    /** A point of the body that is far from its outline: the centre of a rectangle. */
    Eigen::Vector2d FootprintChecker::innerPoint(const OrientedBox &box) const
    {
        const Eigen::Vector2d &inner = body_.inner;
        return {box.x + box.cosine * inner.x() - box.sine * inner.y(),
                box.y + box.sine * inner.x() + box.cosine * inner.y()};
    }

    /** Moves the box as the car moves along an arc.

        \param chord signed metres between the ends of the arc
        \param cosine, sine of half of the signed turn: to the chord's direction, and on to the new heading */
    void FootprintChecker::drive(OrientedBox &box, double chord, double cosine, double sine) const
    {
        const double middleX = box.cosine * cosine - box.sine * sine;
        const double middleY = box.sine * cosine + box.cosine * sine;
        const double axleX = box.x - box.cosine * centreOffset_ + chord * middleX;
        const double axleY = box.y - box.sine * centreOffset_ + chord * middleY;
        box.cosine = middleX * cosine - middleY * sine;
        box.sine = middleY * cosine + middleX * sine;
        box.x = axleX + box.cosine * centreOffset_;
        box.y = axleY + box.sine * centreOffset_;
    }

    /** Whether a body within CONTACT_BAND of an outline touches an obstacle: poses and sweeps use the same rule. */
    bool FootprintChecker::touches(const OrientedBox &box) const
    {
        if (edges_.separation(box, CONTACT_BAND) <= CONTACT || isInsideObstacle(box))
            return true;
        if (!makeContactTest_)
            return false;
        ContactTest test;
        {
            const std::lock_guard<std::mutex> lock(contactMutex_);
            if (!contactTest_ || contactVersion_ != world_->version())
                contactTest_ = makeContactTest_(obstacles_, body_);
            contactVersion_ = world_->version();
            test = contactTest_;
        }
        return test(box);
    }

    /** Lower bound of the distance between the body and the obstacles by the field alone; negative if the field proves
        none. Values above \e enough and values up to \e lower need not be exact. */
    double FootprintChecker::clearanceByField(const OrientedBox &box, double lower, double enough) const
    {
        const double atCentre = field_.lowerBound(box.x, box.y), ofCentre = atCentre - circumradius_;
        // The field at a circle's centre exceeds that at the body's centre by at most the distance between them.
        const Circle &middle = covering_[covering_.size() / 2];
        if (ofCentre > enough || atCentre + middle.offset - middle.radius <= lower)
            return ofCentre;
        double ofCircles = HUGE_VAL;
        for (const Circle &circle : covering_)
        {
            const double x = box.x + box.cosine * circle.offset, y = box.y + box.sine * circle.offset;
            ofCircles = std::min(ofCircles, field_.lowerBound(x, y) - circle.radius);
            if (ofCircles <= lower)
                return ofCentre;
        }
        return std::max(ofCentre, ofCircles);
    }

    bool FootprintChecker::isFree(const Pose &pose) const
    {
        CheckCounts counts;
        return isFree(pose, counts);
    }

    bool FootprintChecker::isFree(const Pose &pose, CheckCounts &counts) const
    {
        ++counts.states;
        if (!isFinite(pose))
            return false;
        const OrientedBox box = boxAt(obstacles_.toLocal(pose));
        const DistanceField::Bounds bounds = field_.bounds(box.x, box.y);
        if (bounds.lower > circumradius_)
        {
            ++counts.byField;
            return true;
        }
        if (bounds.upper < inradius_)
        {
            ++counts.byField;
            return false;
        }
        bool covered = true;
        for (std::size_t i = 0; i < covering_.size(); ++i)
        {
            const double x = box.x + box.cosine * covering_[i].offset, y = box.y + box.sine * covering_[i].offset;
            const DistanceField::Bounds there = field_.bounds(x, y);
            if (there.upper < inscribed_[i].radius)
            {
                ++counts.byCircles;
                return false;
            }
            covered = covered && there.lower > covering_[i].radius;
        }
        if (covered)
        {
            ++counts.byCircles;
            return true;
        }
        const int side = edges_.side(box, CONTACT_BAND);
        if (side != 0)
        {
            ++counts.byEdges;
            return side > 0 && !isInsideObstacle(box);
        }
        ++counts.byContactTest;
        return !touches(box);
    }

    /** For a body that no outline crosses: does it lie inside of an obstacle? Then its inner point does. */
    bool FootprintChecker::isInsideObstacle(const OrientedBox &box) const
    {
        const Eigen::Vector2d inner = innerPoint(box);
        if (field_.isOutside(inner.x(), inner.y()))
            return false;
        if (field_.isInside(inner.x(), inner.y()))
            return true;
        // An outline touches the point's cell; that can be only when cells are as large as the body. The point itself
        // is far from all outlines.
        return obstacles_.covers(inner.x(), inner.y());
    }

    double FootprintChecker::clearance(const Pose &pose) const
    {
        CheckCounts counts;
        return clearance(pose, HUGE_VAL, counts);
    }

    double FootprintChecker::clearance(const Pose &pose, double enough, CheckCounts &counts) const
    {
        ++counts.states;
        if (!isFinite(pose))
            return 0.0;
        const OrientedBox box = boxAt(obstacles_.toLocal(pose));
        double bound = field_.lowerBound(box.x, box.y) - circumradius_;
        if (bound >= enough)
        {
            ++counts.byField;
            return bound;
        }
        double circles = HUGE_VAL;
        for (const Circle &circle : covering_)
            circles = std::min(circles,
                               field_.lowerBound(box.x + box.cosine * circle.offset, box.y + box.sine * circle.offset) -
                                   circle.radius);
        bound = std::max(bound, circles);
        if (bound >= std::min(enough, CLEARANCE_REACH))
        {
            ++counts.byCircles;
            return bound;
        }
        ++counts.byEdges;
        const double separation = edges_.separation(box, CLEARANCE_REACH + ROUNDING) - ROUNDING;
        // As in isFree(): the body crosses no outline, so its centre decides on which side it lies.
        return separation <= 0.0 || isInsideObstacle(box) ? 0.0 : std::max(bound, separation);
    }

    bool FootprintChecker::keeps(const Pose &pose, double clearance, CheckCounts &counts) const
    {
        ++counts.states;
        if (!isFinite(pose))
            return false;
        const OrientedBox box = boxAt(obstacles_.toLocal(pose));
        if (field_.lowerBound(box.x, box.y) - circumradius_ >= clearance)
        {
            ++counts.byField;
            return true;
        }
        bool covered = true;
        for (std::size_t i = 0; i < covering_.size(); ++i)
        {
            const double x = box.x + box.cosine * covering_[i].offset, y = box.y + box.sine * covering_[i].offset;
            const DistanceField::Bounds there = field_.bounds(x, y);
            if (there.upper < inscribed_[i].radius + clearance)
            {
                ++counts.byCircles;
                return false;
            }
            covered = covered && there.lower - covering_[i].radius >= clearance;
        }
        if (covered)
        {
            ++counts.byCircles;
            return true;
        }
        ++counts.byEdges;
        // clearance() is exact only up to its reach.
        return clearance <= CLEARANCE_REACH && edges_.isSeparate(box, clearance + ROUNDING) && !isInsideObstacle(box);
    }

    double FootprintChecker::exactClearance(const Pose &pose) const
    {
        if (!isFree(pose))
            return 0.0;
        const OrientedBox box = boxAt(obstacles_.toLocal(pose));
        const double near = edges_.distance(box);
        if (near <= CLEARANCE_REACH)
            return near;
        return edges_.distanceToAll(box);
    }

    double FootprintChecker::speedFactor(double curvature) const
    {
        // The farthest corner from the centre of rotation is one of the outer two.
        const double lateral = 1.0 + std::abs(curvature) * halfWidth_;
        const double reach = std::max(std::abs(centreOffset_ + halfLength_), std::abs(centreOffset_ - halfLength_));
        return std::sqrt(lateral * lateral + curvature * reach * curvature * reach);
    }

    double FootprintChecker::freeLength(const Pose &from, double curvature, double length) const
    {
        CheckCounts counts;
        return freeLength(from, curvature, length, 1e-3, counts);
    }

    double FootprintChecker::freeLength(const Pose &from, double curvature, double length, double tolerance,
                                        CheckCounts &counts) const
    {
        return freeLength(sweepStart(from, tolerance, counts), curvature, length, counts);
    }

    FootprintChecker::SweepStart FootprintChecker::sweepStart(const Pose &from, double tolerance,
                                                              CheckCounts &counts) const
    {
        if (!(tolerance > 0.0 && tolerance <= MAX_TOLERANCE))
            throw Error("the tolerance of a sweep must be above 0 and at most " + formatNumber(MAX_TOLERANCE) +
                        " m, not " + formatNumber(tolerance) + " m");
        ++counts.states;
        if (!isFinite(from))
            return {{}, tolerance, -1.0, 0.0};
        SweepStart start{boxAt(obstacles_.toLocal(from)), tolerance, tolerance, 0.0};
        const OrientedBox &box = start.box;
        const double corner = CORNER * tolerance;
        start.clearance = clearanceByField(box, corner, HUGE_VAL) - corner;
        if (start.clearance > 0.0)
        {
            ++counts.byField;
            return start;
        }
        ++counts.byEdges;
        const double separation = edges_.separation(box, 2.0 * std::max(tolerance, CONTACT_BAND));
        const bool collides = separation <= CONTACT_BAND ? touches(box) : isInsideObstacle(box);
        start.enlargement = collides ? -1.0 : std::min(tolerance, separation / CORNER);
        return start;
    }

    double FootprintChecker::freeLength(const SweepStart &start, double curvature, double length,
                                        CheckCounts &counts) const
    {
        if (start.enlargement < 0.0 || !std::isfinite(curvature) || !std::isfinite(length))
            return 0.0;
        const double wanted = std::abs(length), direction = length < 0.0 ? -1.0 : 1.0;
        const double turn = std::abs(curvature);
        const double speed = speedFactor(curvature) * (1.0 + 1e-9);
        const double longest = std::min((CLEARANCE_REACH - 2.0 * start.enlargement) /
                                            std::sqrt(1.0 + curvature * centreOffset_ * curvature * centreOffset_),
                                        MAX_TURN / (turn + 1e-12));
        const double corner = CORNER * start.tolerance;
        OrientedBox box = start.box;
        double driven = 0.0;
        for (;;)
        {
            ++counts.states;
            const double left = wanted - driven;
            double stride = std::min(left, longest);
            // Far from everything the field alone allows a long stride. Corners of the enlarged body reach farther out
            // than its sides.
            const double bound = driven == 0.0
                                     ? start.clearance
                                     : clearanceByField(box, stride * speed + corner, stride * speed + corner) - corner;
            if (bound >= left * speed)
            {
                ++counts.byField;
                return wanted;
            }
            const bool far = bound > stride * speed;
            if (far)
                stride = std::min(bound / speed, 2.0 / (turn + 1e-12));
            const double half = 0.5 * turn * stride;
            const double cosine = curvature == 0.0 ? 1.0 : std::cos(half),
                         sine = curvature == 0.0 ? 0.0 : std::sin(half);
            if (far)
                ++counts.byField;
            else
            {
                ++counts.byEdges;
                const BoxSweep sweep{halfLength_ + start.enlargement,
                                     halfWidth_ + start.enlargement,
                                     -centreOffset_,
                                     curvature,
                                     direction,
                                     stride};
                const double contact = edges_.firstContact(box, sweep, cosine, sine);
                if (contact <= stride || (contact < HUGE_VAL && stride < left))
                    return std::clamp(driven + contact - start.tolerance, 0.0, wanted);
            }
            driven += stride;
            if (!(driven < wanted))
                return wanted;
            drive(box, direction * (half < 1e-6 ? stride : stride * sine / half), cosine,
                  curvature * direction < 0.0 ? -sine : sine);
        }
    }
}  // namespace parking
