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
        constexpr double CURVATURE = 1.0001;  // largest curvature as a multiple of that of the car
        constexpr double NO_TURN = 1e-6;      // largest turn on the spot in radians that counts as rounding
        constexpr double FAR = 4.0;           // metres: more clearance than this does not matter
        constexpr double STRAIGHT = 8.0;      // longest straight drive in metres that one query covers

        std::string rounded(double value)
        {
            return formatNumber(std::round(1e3 * value) / 1e3);
        }

        bool isFinitePiece(const PathPiece &piece)
        {
            return std::isfinite(piece.curvature) && std::isfinite(piece.length) && std::isfinite(piece.sharpness) &&
                   std::isfinite(piece.turn);
        }

        /** The pose after a further \e step metres (signed) along a piece. The heading is exact because the curvature
            is linear. Gauss's rule with two points integrates the position with an error of fifth order. */
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

    /** Progress of a check: the current pose and the faults so far. */
    class Referee::Walk
    {
    public:
        Walk(const Referee &referee, const Pose &start) : referee_(referee), pose_(start)
        {
            verdict_.valid = true;
            verdict_.fault = Fault::None;
            verdict_.reason.clear();
            if (!referee_.isPlace(start))
                fail(Fault::NotFinite, "the first state is out of range");
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
            if (length_ > MAX_DISTANCE || !(curvature * driven < MAX_DISTANCE))
                return fail(Fault::NotFinite, "path too long");
            if (!referee_.isDisc_ &&
                curvature > CURVATURE * std::tan(referee_.vehicle_.maxSteeringAngle) / referee_.vehicle_.wheelbase)
                fail(Fault::NotDrivable, "curvature " + formatNumber(curvature) + " 1/m");
            if (!referee_.isDisc_ && std::abs(piece.turn) > NO_TURN)
                fail(Fault::NotDrivable, "turn on the spot");
            const double motion =
                driven + referee_.space_.farthestPoint() * (curvature * driven + std::abs(piece.turn));
            const std::size_t steps = stepsFor(motion);
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
                    clearance_ = 0.0;
                    k += freeSteps;
                    continue;
                }
                const double curvatureHere = piece.curvature + slope * step * static_cast<double>(k);
                pose_ = moved(pose_, curvatureHere, slope, step);
                pose_.yaw += piece.turn / static_cast<double>(steps);
                test(motion / static_cast<double>(steps));
                ++k;
            }
        }

        void glide(const Pose &to)
        {
            if (isOver())
                return;
            if (!referee_.isPlace(to))
                return fail(Fault::NotFinite, "a state is out of range");
            const Pose from = pose_;
            const double length = std::hypot(to.x - from.x, to.y - from.y);
            const double turn = std::remainder(to.yaw - from.yaw, 2.0 * PI);
            length_ += length;
            if (length_ > MAX_DISTANCE)
                return fail(Fault::NotFinite, "path too long");
            const double motion = length + referee_.space_.farthestPoint() * std::abs(turn);
            const std::size_t steps = stepsFor(motion);
            for (std::size_t k = 1; k <= steps && !isOver(); ++k)
            {
                const double share = static_cast<double>(k) / static_cast<double>(steps);
                pose_ = {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), from.yaw + share * turn};
                test(motion / static_cast<double>(steps));
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
        /** Whether the check ends: after NaN or infinite numbers and after too many collisions. */
        bool isOver() const
        {
            return verdict_.fault == Fault::NotFinite || verdict_.collisions >= MAX_COLLISIONS;
        }

        static std::size_t stepsFor(double motion)
        {
            return static_cast<std::size_t>(std::max(1.0, std::ceil(motion / STEP)));
        }

        /** \brief Checks the current pose. \param motion largest motion of the body since the last pose */
        void test(double motion)
        {
            ++verdict_.states;
            clearance_ -= motion;
            if (clearance_ > 0.0)
                return;
            isFree_ = referee_.space_.isFree(pose_);
            clearance_ = isFree_ ? referee_.space_.clearance(pose_, FAR) : 0.0;
            if (isFree_)
                return;
            ++verdict_.collisions;
            fail(Fault::Collision, "collision");
        }

        /** \brief Number of the next \e steps straight ahead that one query proves free; 0 without a proof. */
        std::size_t freeStraight(double step, std::size_t steps) const
        {
            if (!isFree_)
                return 0;
            const double limit = std::max(1.0, std::floor(STRAIGHT / std::max(std::abs(step), 1e-9)));
            if (limit < static_cast<double>(steps))
                steps = static_cast<std::size_t>(limit);
            const double length = static_cast<double>(steps) * step;
            return referee_.space_.clearanceAlong(pose_, length, STEP) > 0.0 ? steps : 0;
        }

        void fail(Fault fault, const std::string &what)
        {
            // The first fault is reported unless a later one ends the check.
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
        bool isFree_{false};     // whether the last checked pose is free
        double clearance_{0.0};  // metres that the body may move before the next query
        Verdict verdict_;
    };

    /** Minimum clearance of a path. Halves each motion until it cannot reduce the minimum. */
    class Referee::NearestApproach
    {
    public:
        explicit NearestApproach(const Referee &referee) : space_(referee.space_)
        {
        }

        double minimum() const
        {
            return minimum_;
        }

        void stand(const Pose &pose)
        {
            minimum_ = std::min(minimum_, space_.clearance(pose, minimum_));
        }

        void driveStraight(Pose pose, double length)
        {
            const double pieces = std::max(1.0, std::ceil(std::abs(length) / STRAIGHT));
            for (double k = 0.0; k < pieces && minimum_ > 0.0; ++k)
            {
                minimum_ = std::min(minimum_, space_.clearanceAlong(pose, length / pieces, minimum_));
                pose = advance(pose, 0.0, length / pieces);
            }
        }

        /** \brief \param motion metres that no point of the body exceeds
            \param at the pose at a share of the motion */
        template <class At>
        void move(double motion, const At &at)
        {
            const double pieces = std::max(1.0, std::ceil(motion / FAR));
            double begin = 0.0, clearance = clearanceAt(at(0.0), motion / pieces);
            for (double k = 1.0; k <= pieces && minimum_ > 0.0; ++k)
            {
                const double end = k / pieces, clearanceThere = clearanceAt(at(end), motion / pieces);
                halve(motion, at, begin, clearance, end, clearanceThere);
                begin = end;
                clearance = clearanceThere;
            }
        }

    private:
        double clearanceAt(const Pose &pose, double motion)
        {
            const double clearance = space_.clearance(pose, minimum_ + motion);
            minimum_ = std::min(minimum_, clearance);
            return clearance;
        }

        template <class At>
        void halve(double motion, const At &at, double begin, double clearanceBefore, double end, double clearance)
        {
            const double moved = (end - begin) * motion;
            // The clearances at both ends bound the distance from below.
            const double bound = 0.5 * (clearanceBefore + clearance - moved);
            if (bound >= minimum_ - std::max(CLEARANCE, 0.01 * minimum_) || minimum_ <= 0.0)
                return;
            const double middle = 0.5 * (begin + end), clearanceThere = clearanceAt(at(middle), 0.5 * moved);
            halve(motion, at, begin, clearanceBefore, middle, clearanceThere);
            halve(motion, at, middle, clearanceThere, end, clearance);
        }

        const FreeSpace &space_;
        double minimum_{std::numeric_limits<double>::infinity()};
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

    double Referee::minClearance(const Path &path) const
    {
        // Fast queries first, so that their minimum excludes most of the others.
        NearestApproach approach(*this);
        Pose pose = path.start;
        approach.stand(pose);
        // One query covers a straight drive of a rectangle or a disc.
        const auto isStraight = [this](const PathPiece &piece)
        {
            return !space_.hasOutline() && piece.curvature == 0.0 && piece.sharpness == 0.0 && piece.turn == 0.0;
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
        return approach.minimum();
    }

    double Referee::minClearance(const std::vector<Pose> &poses) const
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
        return approach.minimum();
    }

    bool Referee::isPlace(const Pose &pose) const
    {
        return std::isfinite(pose.x) && std::isfinite(pose.y) && std::abs(pose.yaw) <= MAX_DISTANCE &&
               pose.x >= bounds_.min.x() - MAX_DISTANCE && pose.x <= bounds_.max.x() + MAX_DISTANCE &&
               pose.y >= bounds_.min.y() - MAX_DISTANCE && pose.y <= bounds_.max.y() + MAX_DISTANCE;
    }

    Verdict check(const Scenario &scenario, const Path &path)
    {
        return Referee(scenario).check(path);
    }
}  // namespace parking
