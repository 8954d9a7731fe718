#include "benchmarks/metrics/PathMetrics.h"

#include "parking_geometry/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace parking
{
    namespace
    {
        constexpr double SMOOTHNESS_STEP = 0.1;   // metres
        constexpr double CLEARANCE_STEP = 0.1;    // metres
        constexpr double MOST_CLEARANCES = 1000;  // poses
        constexpr double CLOTHOID_STEP = 0.01;    // step of the integrals in metres
        constexpr double SAME_STEERING = 1e-6;    // radians

        /** Absolute change of heading along a piece in radians: its curvature may change sign. */
        double turned(const PathPiece &piece)
        {
            const double begin = piece.curvature, end = piece.endCurvature(), length = piece.driven();
            if (begin * end >= 0.0)
                return 0.5 * std::abs(begin + end) * length + std::abs(piece.turn);
            const double share = begin / (begin - end);  // length until the sign changes
            return 0.5 * length * (std::abs(begin) * share + std::abs(end) * (1.0 - share));
        }

        /** Positions at most \e step apart, evenly spaced within each stretch. */
        std::vector<Pose> evenPoses(const Path &path, double step)
        {
            std::vector<Pose> poses{path.start};
            Pose pose = path.start;
            std::size_t next = 0;
            for (const Stretch &stretch : path.stretches())
            {
                const double length = path.part(stretch.first, stretch.last).length();
                const double parts = std::max(1.0, std::ceil(length / step));
                double before = 0.0;  // metres of the stretch in front of the piece
                double part = 1.0;
                for (; next < stretch.last; ++next)
                {
                    const PathPiece &piece = path.pieces[next];
                    for (; part <= parts; part += 1.0)
                    {
                        const double place = part == parts ? length : length * part / parts;
                        if (place > before + piece.driven() || piece.driven() == 0.0)
                            break;
                        poses.push_back(advance(pose, piece, place - before));
                    }
                    before += piece.driven();
                    pose = advance(pose, piece);
                }
                if (part <= parts)  // rounding has left out the last position
                    poses.push_back(pose);
            }
            return poses;
        }

        /** OMPL's PathGeometric::smoothness() on positions: the squared turning angles over the adjacent lengths. */
        double smoothnessOf(const std::vector<Pose> &poses)
        {
            double sum = 0.0;
            for (std::size_t i = 2; i < poses.size(); ++i)
            {
                const double a = positionDistance(poses[i - 2], poses[i - 1]);
                const double b = positionDistance(poses[i - 1], poses[i]);
                const double c = positionDistance(poses[i - 2], poses[i]);
                if (!(a > 0.0 && b > 0.0))
                    continue;
                const double cosine = std::clamp((a * a + b * b - c * c) / (2.0 * a * b), -1.0, 1.0);
                const double turn = 2.0 * (PI - std::acos(cosine)) / (a + b);
                sum += turn * turn;
            }
            return sum;
        }

        /** The fastest profile from rest to rest along a length. */
        class RestToRest
        {
        public:
            RestToRest(double length, const Vehicle &vehicle)
              : length_(length),
                acceleration_(vehicle.maxAcceleration),
                peak_(std::min(vehicle.maxSpeed, std::sqrt(length * acceleration_)))
            {
            }

            double duration() const
            {
                return peak_ > 0.0 ? peak_ / acceleration_ + length_ / peak_ : 0.0;
            }

            /** Integral of the squared acceleration. */
            double effort() const
            {
                return 2.0 * acceleration_ * peak_;
            }

            double speedAt(double place) const
            {
                const double squared = 2.0 * acceleration_ * std::min(place, length_ - place);
                return std::min(peak_, std::sqrt(std::max(0.0, squared)));
            }

            double timeAt(double place) const
            {
                const double rise = 0.5 * peak_ * peak_ / acceleration_;
                if (place <= rise)
                    return std::sqrt(2.0 * std::max(0.0, place) / acceleration_);
                if (place >= length_ - rise)
                    return duration() - std::sqrt(2.0 * std::max(0.0, length_ - place) / acceleration_);
                return peak_ / acceleration_ + (place - rise) / peak_;
            }

        private:
            double length_, acceleration_, peak_;
        };

        /** Adds the steering along a piece that begins \e place metres into its stretch. */
        void addSteering(CuspToCusp &figures, const PathPiece &piece, double place, const RestToRest &profile,
                         const Vehicle &vehicle)
        {
            const double length = piece.driven();
            const double parts = piece.sharpness == 0.0 ? 1.0 : std::ceil(length / CLOTHOID_STEP);
            for (double k = 0.0; k < parts; k += 1.0)
            {
                const double from = length * k / parts, to = length * (k + 1.0) / parts, middle = 0.5 * (from + to);
                const double time = profile.timeAt(place + to) - profile.timeAt(place + from);
                const double angle = vehicle.steeringAngle(piece.curvatureAt(middle));
                figures.cost.steeringIntegral += angle * angle * time;
                if (piece.sharpness == 0.0)
                    continue;
                const double perMetre =
                    (vehicle.steeringAngle(piece.curvatureAt(to)) - vehicle.steeringAngle(piece.curvatureAt(from))) /
                    (to - from);
                const double speed = profile.speedAt(place + middle);
                figures.cost.controlEffort += std::pow(speed * speed * perMetre, 2.0) * time;
            }
        }

        void addJump(CuspToCusp &figures, double before, double after, const Vehicle &vehicle)
        {
            const double angle = std::abs(vehicle.steeringAngle(after) - vehicle.steeringAngle(before));
            if (angle <= SAME_STEERING)
                return;
            ++figures.standingSteerings;
            figures.standingSteeringTime += angle / vehicle.maxSteeringRate;
        }

        void check(const Path &path)
        {
            bool finite = isFinite(path.start);
            for (const PathPiece &piece : path.pieces)
            {
                finite = finite && std::isfinite(piece.curvature) && std::isfinite(piece.length) &&
                         std::isfinite(piece.sharpness) && std::isfinite(piece.turn);
                if (piece.turn != 0.0)
                    throw Error("speed profile: the path turns on the spot, which a car cannot do");
            }
            if (!finite)
                throw Error("speed profile: the path is not finite");
        }
    }  // namespace

    PathShape shapeOf(const Path &path)
    {
        PathShape shape;
        const double length = path.length();
        if (!(length > 0.0))
            return shape;
        double reverse = 0.0;
        for (const PathPiece &piece : path.pieces)
        {
            shape.normalizedCurvature += turned(piece);
            const double most = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
            shape.maxCurvature =
                std::max(shape.maxCurvature, piece.turn != 0.0 ? std::numeric_limits<double>::infinity() : most);
            if (piece.length < 0.0)
                reverse += piece.driven();
        }
        shape.reverseShare = reverse / length;
        shape.angleOverLength = (shape.normalizedCurvature + PI * static_cast<double>(path.cusps())) / length;
        shape.smoothness = smoothnessOf(evenPoses(path, SMOOTHNESS_STEP));
        return shape;
    }

    ClearanceFigures clearanceAlong(const Path &path,
                                    const std::function<double(const Pose &, double enough)> &clearance)
    {
        std::vector<double> values;
        for (const Pose &pose : evenPoses(path, std::max(CLEARANCE_STEP, path.length() / MOST_CLEARANCES)))
            values.push_back(std::min(FARTHEST_CLEARANCE, clearance(pose, FARTHEST_CLEARANCE)));
        ClearanceFigures figures;
        for (const double value : values)
            figures.mean += value / static_cast<double>(values.size());
        std::sort(values.begin(), values.end());
        const std::size_t n = values.size();
        figures.median = 0.5 * (values[(n - 1) / 2] + values[n / 2]);
        return figures;
    }

    CuspToCusp cuspToCusp(const Path &path, const Vehicle &vehicle)
    {
        check(path);
        const std::vector<Stretch> stretches = path.stretches();
        if (stretches.empty())
            throw Error("speed profile: the path never drives");
        CuspToCusp figures;
        figures.cost.gearChanges = stretches.size() - 1;
        const PathPiece *before = nullptr;
        double changes = 0.0;  // direction of the acceleration, signed like the speed
        double acceleration = 0.0;
        const auto changeTo = [&](double next)
        {
            changes += std::abs(next - acceleration);
            acceleration = next;
        };
        for (const Stretch &stretch : stretches)
        {
            const double length = path.part(stretch.first, stretch.last).length();
            const RestToRest profile(length, vehicle);
            figures.cost.time += profile.duration();
            figures.cost.controlEffort += profile.effort();
            changeTo(stretch.direction * vehicle.maxAcceleration);
            if (length > vehicle.maxSpeed * vehicle.maxSpeed / vehicle.maxAcceleration)
                changeTo(0.0);
            changeTo(-stretch.direction * vehicle.maxAcceleration);
            double place = 0.0;
            for (std::size_t i = stretch.first; i < stretch.last; ++i)
            {
                const PathPiece &piece = path.pieces[i];
                if (piece.driven() == 0.0)
                    continue;
                if (before != nullptr)
                    addJump(figures, before->endCurvature(), piece.curvature, vehicle);
                addSteering(figures, piece, place, profile, vehicle);
                place += piece.driven();
                before = &piece;
            }
        }
        changeTo(0.0);
        figures.meanJerk = changes / figures.cost.time;
        return figures;
    }
}  // namespace parking
