#include "parking_geometry/referee/Referee.h"

#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double CURVATURE = 1.0001;  // share of the greatest curvature that may be used
        constexpr double NO_TURN = 1e-6;      // radians on the spot that are rounding

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
                test();
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
            const std::size_t steps =
                stepsFor(driven + referee_.space_.farthestPoint() * (curvature * driven + std::abs(piece.turn)));
            const double step = piece.length / static_cast<double>(steps);
            // Sharpness is per metre driven: along a reverse piece the curvature grows against the signed distance.
            const double slope = piece.length < 0.0 ? -piece.sharpness : piece.sharpness;
            for (std::size_t k = 0; k < steps; ++k)
            {
                const double curvatureHere = piece.curvature + slope * step * static_cast<double>(k);
                pose_ = moved(pose_, curvatureHere, slope, step);
                pose_.yaw += piece.turn / static_cast<double>(steps);
                test();
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
            const std::size_t steps = stepsFor(length + referee_.space_.farthestPoint() * std::abs(turn));
            for (std::size_t k = 1; k <= steps; ++k)
            {
                const double share = static_cast<double>(k) / static_cast<double>(steps);
                pose_ = {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), from.yaw + share * turn};
                test();
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
        /** Nothing can be computed after a number that is none. */
        bool isOver() const
        {
            return verdict_.fault == Fault::NotFinite;
        }

        static std::size_t stepsFor(double way)
        {
            return static_cast<std::size_t>(std::max(1.0, std::ceil(way / STEP)));
        }

        void test()
        {
            ++verdict_.states;
            if (referee_.space_.isFree(pose_))
                return;
            ++verdict_.collisions;
            fail(Fault::Collision, "collision");
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
        Verdict verdict_;
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
