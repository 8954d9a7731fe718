// Properties of Drive, the common base of Result and ParkingPlan.
#include "automatic_parking/drawing/DriveAnimation.h"
#include "parking_geometry/Error.h"
#include "python/src/Bindings.h"
#include "python/src/Signals.h"
#include "python/src/Values.h"

#include <type_traits>

namespace parking::python
{
    namespace
    {
        static_assert(sizeof(TrajectoryPoint) == 8 * sizeof(double) && std::is_standard_layout_v<TrajectoryPoint>);
        static_assert(sizeof(PathPiece) == 4 * sizeof(double) && std::is_standard_layout_v<PathPiece>);

        const PathHandle &of(const py::object &self)
        {
            return py::cast<const PathHandle &>(self);
        }

        py::array pathOf(const py::object &self)
        {
            const auto &rows = of(self).rows();
            return view(rows.data(), {static_cast<py::ssize_t>(rows.size() / 5), 5}, self);
        }

        py::array piecesOf(const py::object &self)
        {
            const auto &pieces = of(self).path().pieces;
            return view(reinterpret_cast<const double *>(pieces.data()), {static_cast<py::ssize_t>(pieces.size()), 4},
                        self);
        }

        const TrajectoryHandle &optimized(const PathHandle &self)
        {
            Signals signals;
            const TrajectoryHandle *found = nullptr;
            try
            {
                const py::gil_scoped_release release;
                found = &self.trajectory([&signals] { return signals.arrived(); });
            }
            catch (const Error &)
            {
                signals.raise();
                throw;
            }
            return *found;
        }

        py::array trajectoryOf(const py::object &self)
        {
            const Trajectory &points = optimized(of(self)).points;
            return view(reinterpret_cast<const double *>(points.data()), {static_cast<py::ssize_t>(points.size()), 8},
                        self);
        }

        py::object orNone(bool known, double value)
        {
            if (!known)
                return py::none();
            return py::float_(value);
        }

        std::string page(const PathHandle &self, const std::string &title, const std::string &subtitle)
        {
            const TrajectoryHandle &found = optimized(self);
            const Scenario &scenario = self.scenario().scenario();
            Trajectory local = found.points;
            for (TrajectoryPoint &point : local)
            {
                point.x -= scenario.worldOffset.x();
                point.y -= scenario.worldOffset.y();
            }
            return driveAnimation(scenario, self.path(), local, title, {subtitle, {}, {}});
        }
    }  // namespace

    void addPathProperties(py::class_<PathHandle, std::shared_ptr<PathHandle>> &type)
    {
        type.def_property_readonly(
            "scenario",
            [](const PathHandle &self) { return std::const_pointer_cast<ScenarioHandle>(self.scenarioPointer()); },
            "The Scenario of the path.");
        type.def_property_readonly("path", &pathOf,
                                   "States of the path at most 0.1 m apart, an n x 5 array: x, y, yaw, direction (1 "
                                   "or -1) and curvature (1/m) of the arc to the state. No rows without a path.");
        type.def_property_readonly("pieces", &piecesOf,
                                   "Pieces of the exact path, an m x 4 array: initial curvature (1/m), signed length "
                                   "(m), sharpness (1/m^2), turn on the spot (rad).");
        type.def_property_readonly(
            "length", [](const PathHandle &self) { return orNone(self.hasPath(), self.path().length()); },
            "Length of the path in metres; None without a path.");
        type.def_property_readonly(
            "cusps",
            [](const PathHandle &self) -> py::object
            {
                if (!self.hasPath())
                    return py::none();
                return py::int_(self.path().cusps());
            },
            "Number of changes of direction; None without a path.");
        type.def_property_readonly(
            "clearance",
            [](const PathHandle &self)
            {
                double least = 0.0;
                if (self.hasPath())
                {
                    const py::gil_scoped_release release;
                    least = self.clearance();
                }
                return orNone(self.hasPath(), least);
            },
            "Minimum distance between the car and obstacles along the path in metres; None without a path.");
        type.def_property_readonly("trajectory", &trajectoryOf,
                                   "Quickest trajectory near the path, at most 0.05 s between rows: an n x 8 array of "
                                   "t, x, y, yaw, v, acceleration, steering, steering rate. Computed on first use.");
        type.def_property_readonly(
            "duration", [](const PathHandle &self) { return optimized(self).duration; },
            "Duration of the trajectory in seconds.");
        type.def_property_readonly(
            "trajectory_info",
            [](const PathHandle &self)
            {
                const TrajectoryHandle &found = optimized(self);
                py::dict info;
                info["duration"] = found.duration;
                info["fallback"] = found.fallback;
                info["reason"] = found.reason;
                info["tpcap_cost"] = found.cost.total();
                info["gear_changes"] = found.cost.gearChanges;
                return info;
            },
            "Properties of the trajectory, a dict: duration, fallback (whether it stops to steer), reason of the "
            "fallback, tpcap_cost, gear_changes.");
        type.def("_page", &page, py::arg("title"), py::arg("subtitle"));
    }
}  // namespace parking::python
