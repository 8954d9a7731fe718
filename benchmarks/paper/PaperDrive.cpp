#include "benchmarks/paper/PaperDrive.h"

#include "parking_geometry/Error.h"
#include "path_tracking/control/Mpc.h"
#include "path_tracking/simulation/BicycleModel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parking
{
    namespace
    {
        using Points = std::vector<Eigen::Vector2d>;

        constexpr double AT_REST = 0.02;      // m/s
        constexpr double RESTING_TIME = 1.0;  // seconds below that speed that end the drive
        constexpr double WAITING = 20.0;      // seconds for the car to stop after the reference has arrived

        /** The position on the path after a number of metres. */
        class WantedPosition
        {
        public:
            explicit WantedPosition(const Points &path) : path_(path), along_{0.0}
            {
                for (std::size_t i = 1; i < path.size(); ++i)
                    along_.push_back(along_.back() + (path[i] - path[i - 1]).norm());
            }

            double length() const
            {
                return along_.back();
            }

            Eigen::Vector2d at(double driven) const
            {
                const auto next = std::upper_bound(along_.begin(), along_.end(), driven);
                if (next == along_.end())
                    return path_.back();
                const auto i = static_cast<std::size_t>(next - along_.begin());
                const double share = (driven - along_[i - 1]) / (along_[i] - along_[i - 1]);
                return path_[i - 1] + share * (path_[i] - path_[i - 1]);
            }

        private:
            const Points &path_;
            std::vector<double> along_;
        };

        MpcParameters papersParameters(const PaperDriveOptions &options)
        {
            MpcParameters parameters;
            parameters.relativeSteering = false;
            parameters.relativeAcceleration = false;
            parameters.farHeadingWeight = 0.0;
            parameters.headingWeight = options.headingWeight;
            parameters.alignDistance = options.alignDistance;
            parameters.acrossWeight = parameters.alongWeight;  // W3 has no direction of travel.
            return parameters;
        }

        double distanceTo(const Points &path, const Pose &pose)
        {
            double least = std::numeric_limits<double>::infinity();
            for (const Eigen::Vector2d &point : path)
                least = std::min(least, std::hypot(point.x() - pose.x, point.y() - pose.y));
            return least;
        }
    }  // namespace

    PaperDriveResult drivePaper(const Vehicle &vehicle, const Points &path, const Pose &start, const Pose &goal,
                                const PaperDriveOptions &options, const std::function<bool(const Pose &)> &isFree)
    {
        if (path.empty() || !(options.speed > 0.0))
            throw Error("a drive requires a path and a positive speed");
        const MpcParameters parameters = papersParameters(options);
        Vehicle car = vehicle;
        car.maxSteeringRate = 2.0 * vehicle.maxSteeringAngle / parameters.step;
        Mpc mpc(car, parameters);
        const WantedPosition wanted(path);
        const double last = wanted.length() / options.speed + WAITING;
        PaperDriveResult result;
        PaperDriveState now;
        now.pose = start;
        result.states.push_back(now);
        MpcControl command;
        double resting = 0.0;
        std::size_t colliding = 0;
        for (std::size_t step = 1; now.time < last && resting < RESTING_TIME; ++step)
        {
            MpcProblem problem;
            problem.pose = now.pose;
            problem.speed = now.speed;
            problem.last = command;
            problem.wheels = now.steering;
            problem.eitherWay = true;
            problem.align = positionDistance(now.pose, goal) < parameters.alignDistance;
            for (std::size_t k = 1; k <= parameters.horizon; ++k)
            {
                const double time = now.time + static_cast<double>(k) * parameters.step;
                const Eigen::Vector2d at = wanted.at(options.speed * time);
                problem.reference.push_back({{at.x(), at.y(), goal.yaw}, 0.0, 0.0});
            }
            const MpcSolution solution = mpc.solve(problem);
            if (solution.usable)
                command = solution.controls.front();
            else
            {
                ++result.failures;
                const double brake = -now.speed / parameters.step;
                command = {std::clamp(brake, -car.maxAcceleration, car.maxAcceleration), now.steering};
            }
            const BicycleStep<double> moved = bicycleStep(now.pose.yaw, now.speed, command.acceleration, now.steering,
                                                          command.steering, parameters.step, car.wheelbase);
            now.time = static_cast<double>(step) * parameters.step;
            now.pose = {now.pose.x + moved.dx, now.pose.y + moved.dy, wrapAngle(now.pose.yaw + moved.dyaw)};
            now.speed += command.acceleration * parameters.step;
            now.acceleration = command.acceleration;
            now.steering = command.steering;
            result.states.push_back(now);
            result.greatestDeviation = std::max(result.greatestDeviation, distanceTo(path, now.pose));
            colliding += isFree && !isFree(now.pose);
            const bool waits = options.speed * now.time >= wanted.length();
            resting = waits && std::abs(now.speed) < AT_REST ? resting + parameters.step : 0.0;
        }
        result.stands = resting >= RESTING_TIME;
        result.collidingShare = static_cast<double>(colliding) / static_cast<double>(result.states.size());
        result.positionError = positionDistance(now.pose, goal);
        result.headingError = std::abs(wrapAngle(now.pose.yaw - goal.yaw));
        std::size_t moving = result.states.size();
        while (moving > 1 && std::abs(result.states[moving - 1].speed) < AT_REST)
            --moving;
        for (std::size_t i = 1; i < moving; ++i)
        {
            result.meanAcceleration += std::abs(result.states[i].acceleration);
            result.meanSteering += std::abs(result.states[i].steering);
        }
        if (moving > 1)
        {
            result.travelTime = result.states[moving - 1].time;
            result.meanAcceleration /= static_cast<double>(moving - 1);
            result.meanSteering /= static_cast<double>(moving - 1);
        }
        return result;
    }
}  // namespace parking
