#pragma once

#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "parking_geometry/Box.h"
#include "parking_geometry/Pose.h"
#include "python/src/Bindings.h"
#include "python/src/Handles.h"
#include "state_validity/sweeps/ClearanceProof.h"

#include <array>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include <pybind11/stl.h>

// Footprint checks in the coordinates of OMPL's states, for improved_astar.ompl.
namespace parking::python
{
    namespace py = pybind11;

    /** \brief Conversion between the world coordinates of OMPL's states and the local ones of the core. Poses of the
        scenario keep their exact local values, which a subtraction would round. */
    class Frame
    {
    public:
        Frame() = default;

        /** \brief The coordinates of a scenario. */
        explicit Frame(const Scenario &scenario) : offset_(scenario.worldOffset), bounds_(scenario.bounds)
        {
            known_ = scenario.goals;
            known_.push_back(scenario.start);
        }

        /** \brief A pose in local coordinates. */
        Pose toLocal(const Pose &world) const
        {
            for (const Pose &pose : known_)
                if (pose.x + offset_.x() == world.x && pose.y + offset_.y() == world.y)
                    return {pose.x, pose.y, world.yaw};
            return {world.x - offset_.x(), world.y - offset_.y(), world.yaw};
        }

        /** \brief The bounds x min, y min, x max, y max in local coordinates. */
        Box toLocal(const std::array<double, 4> &bounds) const
        {
            const Box world{{bounds[0], bounds[1]}, {bounds[2], bounds[3]}};
            if (bounds_ && world.min == bounds_->min + offset_ && world.max == bounds_->max + offset_)
                return *bounds_;
            return {world.min - offset_, world.max - offset_};
        }

        /** \brief A pose in world coordinates with a heading in OMPL's range [-pi, pi). */
        Pose toWorld(const Pose &local) const
        {
            const double yaw = wrapAngle(local.yaw);
            return {local.x + offset_.x(), local.y + offset_.y(), yaw == PI ? -PI : yaw};
        }

    private:
        Eigen::Vector2d offset_{0.0, 0.0};
        std::optional<Box> bounds_;
        std::vector<Pose> known_;
    };

    /** \brief Footprint checks of single poses and motions. */
    class Footprint
    {
    public:
        /** \brief Builds the distance field of a Scenario. */
        explicit Footprint(const py::object &scenario) : scenario_(scenarioFrom(scenario, "scenario"))
        {
            const py::gil_scoped_release release;
            checker_ = &scenario_->planner().footprint();
            frame_ = Frame(scenario_->scenario());
        }

        /** \brief The checks in local coordinates. */
        const FootprintChecker &checker() const
        {
            return *checker_;
        }

        /** \brief The coordinates of the scenario. */
        const Frame &frame() const
        {
            return frame_;
        }

        /** \brief Whether the car is free of obstacles at a pose in world coordinates. */
        bool isFree(double x, double y, double yaw) const
        {
            return checker_->isFree(frame_.toLocal(Pose{x, y, yaw}));
        }

        /** \brief Metres between the car and the nearest obstacle at a pose in world coordinates. */
        double clearance(double x, double y, double yaw) const
        {
            return checker_->clearance(frame_.toLocal(Pose{x, y, yaw}));
        }

        /** \brief Whether a straight motion between local poses is free. */
        bool isLineFree(const Pose &from, const Pose &to) const
        {
            CheckCounts counts;
            return ClearanceProof(*checker_, FootprintEnvironment::TOLERANCE).proveLine(from, to, false, counts).whole;
        }

        /** \brief Whether a curve of the space is free. \param at returns the pose at a fraction of it, or None out of
            bounds \param length metres \param curvature the largest in 1/m */
        bool isCurveFree(const py::function &at, double length, double curvature) const
        {
            const auto pose = [&](double t)
            {
                const py::object answer = at(t);
                if (answer.is_none())
                    return Pose{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0};  // which is not free
                const auto [x, y, yaw] = py::cast<std::tuple<double, double, double>>(answer);
                return frame_.toLocal(Pose{x, y, yaw});
            };
            CheckCounts counts;
            return ClearanceProof(*checker_, FootprintEnvironment::TOLERANCE)
                .prove(pose, length * checker_->speedFactor(curvature), false, counts)
                .whole;
        }

    private:
        ScenarioPointer scenario_;
        const FootprintChecker *checker_{nullptr};
        Frame frame_;
    };
}  // namespace parking::python
