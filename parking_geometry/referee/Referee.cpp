#include "parking_geometry/referee/Referee.h"

#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double CURVATURE = 1.0001;  // share of the greatest curvature that may be used
        constexpr double NO_TURN = 1e-6;      // radians on the spot that are rounding
        constexpr double FAR = 4.0;           // metres: more clearance than this does not matter
        constexpr double STRAIGHT = 8.0;      // metres of a straight drive that are looked at as one

        std::string rounded(double value)
        {
            return formatNumber(std::round(1e3 * value) / 1e3);
        }

        bool isFinitePiece(const PathPiece &piece)
        {
            return std::isfinite(piece.curvature) && std::isfinite(piece.length) && std::isfinite(piece.sharpness) &&
                   std::isfinite(piece.turn);
        }

        /** Where the car is \e step metres (signed) farther along a piece. The heading is exact: curvature changes
            evenly. The position is integrated by Gauss's rule with two points, whose error shrinks with the fifth power
            of the step. */
        Pose moved(const Pose &pose, double curvature, double slope, double step)
        {
            const auto heading = [&](double distance)
            {
                return pose.yaw + distance * (curvature + 0.5 * slope * distance);
            };
            const double offset = 0.5 / std::sqrt(3.0);
            const double first = heading((0.5 - offset) * step), second = heading((0.5 + offset) * step);
            return {pose.x + 0.5 * step * (std::cos(first) + std::cos(second)),
                    pose.y + 0.5 * step * (std::sin(first) + std::sin(second)), heading(step)};
        }

        bool isNear(const Pose &a, const Pose &b)
        {
            const double turn = std::remainder(a.yaw - b.yaw, 2.0 * PI);
            return std::hypot(a.x - b.x, a.y - b.y) <= Referee::TOLERANCE && std::abs(turn) <= Referee::TOLERANCE;
        }
    }  // namespace

    /** A path under examination: where it has come to, and what was wrong so far. */
    class Referee::Walk
    {
    public:
        Walk(const Referee &referee, const Pose &start) : referee_(referee), pose_(start)
        {
            verdict_.valid = true;
            verdict_.fault = Fault::None;
            verdict_.reason.clear();
            if (!referee_.isPlace(start))
                fail(Fault::NotFinite, "the first state is no place");
            else if (!isNear(start, referee_.start_))
                fail(Fault::WrongStart, "begins");
            else
                test(0.0);
        }

        void drive(const PathPiece &piece)
        {
            if (isOver())
                return;
            if (!isFinitePiece(piece))
                return fail(Fault::NotFinite, "a piece is not finite");
            const double driven = std::abs(piece.length);
            const double end = piece.curvature + piece.sharpness * driven;
            const double curvature = std::max(std::abs(piece.curvature), std::abs(end));
            verdict_.maxCurvature = std::max(verdict_.maxCurvature, curvature);
            length_ += driven;
            if (length_ > FARTHEST || !(curvature * driven < FARTHEST))
                return fail(Fault::NotFinite, "longer than any drive");
            if (!referee_.isDisc_ &&
                curvature > CURVATURE * std::tan(referee_.vehicle_.maxSteeringAngle) / referee_.vehicle_.wheelbase)
                fail(Fault::NotDrivable, "curvature " + formatNumber(curvature) + " 1/m");
            if (!referee_.isDisc_ && std::abs(piece.turn) > NO_TURN)
                fail(Fault::NotDrivable, "turn on the spot");
            const double way = driven + referee_.space_.farthestPoint() * (curvature * driven + std::abs(piece.turn));
            const std::size_t steps = stepsFor(way);
            const double step = piece.length / static_cast<double>(steps);
            // Sharpness is per metre driven: along a reverse piece the curvature grows against the signed distance.
            const double slope = piece.length < 0.0 ? -piece.sharpness : piece.sharpness;
            const bool isStraight = curvature == 0.0 && piece.turn == 0.0;
            for (std::size_t k = 0; k < steps && !isOver();)
            {
                const std::size_t freeSteps = isStraight ? freeStraight(step, steps - k) : 0;
                if (freeSteps > 0)
                {
                    pose_ = moved(pose_, 0.0, 0.0, static_cast<double>(freeSteps) * step);
                    verdict_.states += freeSteps;
                    room_ = 0.0;
                    k += freeSteps;
                    continue;
                }
                const double curvatureHere = piece.curvature + slope * step * static_cast<double>(k);
                pose_ = moved(pose_, curvatureHere, slope, step);
                pose_.yaw += piece.turn / static_cast<double>(steps);
                test(way / static_cast<double>(steps));
                ++k;
            }
        }

        void glide(const Pose &to)
        {
            if (isOver())
                return;
            if (!referee_.isPlace(to))
                return fail(Fault::NotFinite, "a state is no place");
            const Pose from = pose_;
            const double length = std::hypot(to.x - from.x, to.y - from.y);
            const double turn = std::remainder(to.yaw - from.yaw, 2.0 * PI);
            length_ += length;
            if (length_ > FARTHEST)
                return fail(Fault::NotFinite, "longer than any drive");
            const double way = length + referee_.space_.farthestPoint() * std::abs(turn);
            const std::size_t steps = stepsFor(way);
            for (std::size_t k = 1; k <= steps && !isOver(); ++k)
            {
                const double share = static_cast<double>(k) / static_cast<double>(steps);
                pose_ = {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), from.yaw + share * turn};
                test(way / static_cast<double>(steps));
            }
        }

        Verdict finish(bool exact)
        {
            if (exact && !isOver() &&
                std::none_of(referee_.goals_.begin(), referee_.goals_.end(),
                             [this](const Pose &goal) { return isNear(goal, pose_); }))
                fail(Fault::MissesGoal, "ends");
            return std::move(verdict_);
        }

    private:
        /** Nothing can be computed after a number that is none, and nothing is learnt from ever more collisions. */
        bool isOver() const
        {
            return verdict_.fault == Fault::NotFinite || verdict_.collisions >= MOST_COLLISIONS;
        }

        static std::size_t stepsFor(double way)
        {
            return static_cast<std::size_t>(std::max(1.0, std::ceil(way / STEP)));
        }

        /** \brief The pose that the walk has come to. \param way that the body has moved at most since the last one */
        void test(double way)
        {
            ++verdict_.states;
            room_ -= way;
            if (room_ > 0.0)
                return;
            isFree_ = referee_.space_.isFree(pose_);
            room_ = isFree_ ? referee_.space_.clearance(pose_, FAR) : 0.0;
            if (isFree_)
                return;
            ++verdict_.collisions;
            fail(Fault::Collision, "collision");
        }

        /** \brief How many of the next \e steps straight ahead are free at a glance; 0 when that cannot be said. */
        std::size_t freeStraight(double step, std::size_t steps) const
        {
            if (!isFree_)
                return 0;
            const double most = std::max(1.0, std::floor(STRAIGHT / std::max(std::abs(step), 1e-9)));
            if (most < static_cast<double>(steps))
                steps = static_cast<std::size_t>(most);
            const double length = static_cast<double>(steps) * step;
            return referee_.space_.clearanceAlong(pose_, length, STEP) > 0.0 ? steps : 0;
        }

        void fail(Fault fault, const std::string &what)
        {
            // Of several faults the first is told, but for the one that stops the examination.
            if (!verdict_.valid && fault != Fault::NotFinite)
                return;
            verdict_.valid = false;
            verdict_.fault = fault;
            verdict_.reason = what + " at " + rounded(pose_.x) + ", " + rounded(pose_.y);
            if (fault == Fault::WrongStart)
                verdict_.reason += ", not at the start";
            if (fault == Fault::MissesGoal)
                verdict_.reason += ", not at the goal";
        }

        const Referee &referee_;
        Pose pose_;
        double length_{0.0};
        bool isFree_{false};  // the last pose that was looked at
        double room_{0.0};    // metres that the body may move before it has to be looked at again
        Verdict verdict_;
    };

    /** The least clearance of a path: halves each motion until it cannot matter any more. */
    class Referee::NearestApproach
    {
    public:
        explicit NearestApproach(const Referee &referee) : space_(referee.space_)
        {
        }

        double least() const
        {
            return least_;
        }

        void stand(const Pose &pose)
        {
            least_ = std::min(least_, space_.clearance(pose, least_));
        }

        void driveStraight(Pose pose, double length)
        {
            const double pieces = std::max(1.0, std::ceil(std::abs(length) / STRAIGHT));
            for (double k = 0.0; k < pieces && least_ > 0.0; ++k)
            {
                least_ = std::min(least_, space_.clearanceAlong(pose, length / pieces, least_));
                pose = advance(pose, 0.0, length / pieces);
            }
        }

        /** \brief \param way that no point of the body moves farther than
            \param at the pose at a share of the motion */
        template <class At>
        void move(double way, const At &at)
        {
            const double pieces = std::max(1.0, std::ceil(way / FAR));
            double begin = 0.0, room = roomAt(at(0.0), way / pieces);
            for (double k = 1.0; k <= pieces && least_ > 0.0; ++k)
            {
                const double end = k / pieces, roomThere = roomAt(at(end), way / pieces);
                halve(way, at, begin, room, end, roomThere);
                begin = end;
                room = roomThere;
            }
        }

    private:
        double roomAt(const Pose &pose, double way)
        {
            const double room = space_.clearance(pose, least_ + way);
            least_ = std::min(least_, room);
            return room;
        }

        template <class At>
        void halve(double way, const At &at, double begin, double roomThen, double end, double room)
        {
            const double moved = (end - begin) * way;
            // The two ends see to that the body comes no nearer than this.
            const double bound = 0.5 * (roomThen + room - moved);
            if (bound >= least_ - std::max(CLEARANCE, 0.01 * least_) || least_ <= 0.0)
                return;
            const double middle = 0.5 * (begin + end), roomThere = roomAt(at(middle), 0.5 * moved);
            halve(way, at, begin, roomThen, middle, roomThere);
            halve(way, at, middle, roomThere, end, room);
        }

        const FreeSpace &space_;
        double least_{std::numeric_limits<double>::infinity()};
    };

    std::string toString(Fault fault)
    {
        switch (fault)
        {
            case Fault::None:
                return "none";
            case Fault::NoPath:
                return "no_path";
            case Fault::NotFinite:
                return "not_finite";
            case Fault::WrongStart:
                return "wrong_start";
            case Fault::MissesGoal:
                return "misses_goal";
            case Fault::NotDrivable:
                return "not_drivable";
            case Fault::Collision:
                return "collision";
        }
        return "none";
    }

    Referee::Referee(const Scenario &scenario, double circleRadius)
      : vehicle_(scenario.vehicle),
        start_(scenario.start),
        goals_(scenario.goals),
        bounds_(scenario.bounds),
        space_(scenario, circleRadius),
        isDisc_(circleRadius > 0.0)
    {
    }

    Verdict Referee::check(const Path &path, bool exact) const
    {
        Walk walk(*this, path.start);
        for (const PathPiece &piece : path.pieces)
            walk.drive(piece);
        return walk.finish(exact);
    }

    Verdict Referee::checkLines(const std::vector<Pose> &poses, bool exact) const
    {
        if (poses.empty())
            return {};
        Walk walk(*this, poses.front());
        for (std::size_t i = 1; i < poses.size(); ++i)
            walk.glide(poses[i]);
        return walk.finish(exact);
    }

    double Referee::leastClearance(const Path &path) const
    {
        // First what is quick, so that most of the rest need not be looked at closely.
        NearestApproach approach(*this);
        Pose pose = path.start;
        approach.stand(pose);
        const auto isStraight = [](const PathPiece &piece)
        {
            return piece.curvature == 0.0 && piece.sharpness == 0.0 && piece.turn == 0.0;
        };
        for (const PathPiece &piece : path.pieces)
        {
            if (isStraight(piece))
                approach.driveStraight(pose, piece.length);
            pose = advance(pose, piece);
            approach.stand(pose);
        }
        pose = path.start;
        for (const PathPiece &piece : path.pieces)
        {
            const double curvature = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
            const double turn = curvature * piece.driven() + std::abs(piece.turn);
            if (!isStraight(piece))
                approach.move(piece.driven() + space_.farthestPoint() * turn,
                              [&](double share)
                              {
                                  PathPiece part = piece;
                                  part.turn *= share;
                                  return advance(pose, part, share * piece.driven());
                              });
            pose = advance(pose, piece);
        }
        return approach.least();
    }

    double Referee::leastClearance(const std::vector<Pose> &poses) const
    {
        NearestApproach approach(*this);
        for (const Pose &pose : poses)
            approach.stand(pose);
        for (std::size_t i = 1; i < poses.size(); ++i)
        {
            const Pose &from = poses[i - 1], &to = poses[i];
            const double turn = std::remainder(to.yaw - from.yaw, 2.0 * PI);
            approach.move(std::hypot(to.x - from.x, to.y - from.y) + space_.farthestPoint() * std::abs(turn),
                          [&](double share) {
                              return Pose{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
                                          from.yaw + share * turn};
                          });
        }
        return approach.least();
    }

    bool Referee::isPlace(const Pose &pose) const
    {
        return std::isfinite(pose.x) && std::isfinite(pose.y) && std::abs(pose.yaw) <= FARTHEST &&
               pose.x >= bounds_.min.x() - FARTHEST && pose.x <= bounds_.max.x() + FARTHEST &&
               pose.y >= bounds_.min.y() - FARTHEST && pose.y <= bounds_.max.y() + FARTHEST;
    }

    Verdict check(const Scenario &scenario, const Path &path)
    {
        return Referee(scenario).check(path);
    }
}  // namespace parking
