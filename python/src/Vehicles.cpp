// Vehicle and Slot.
#include "parking_geometry/Error.h"
#include "parking_geometry/ParkingSlot.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/NearestName.h"
#include "python/src/Bindings.h"
#include "python/src/Pickling.h"
#include "python/src/Values.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <utility>

namespace parking::python
{
    namespace
    {
        struct Field
        {
            const char *name;
            double Vehicle::*value;
            const char *about;
        };
        constexpr std::array<Field, 8> FIELDS{
            {{"wheelbase", &Vehicle::wheelbase, "Distance between the axles in metres."},
             {"front_overhang", &Vehicle::frontOverhang, "Distance from front axle to front bumper in metres."},
             {"rear_overhang", &Vehicle::rearOverhang, "Distance from rear axle to rear bumper in metres."},
             {"width", &Vehicle::width, "Width of the body in metres."},
             {"max_steering_angle", &Vehicle::maxSteeringAngle,
              "Maximum steering angle in radians, mean of the front wheels."},
             {"max_speed", &Vehicle::maxSpeed, "Maximum speed in m/s, in both directions."},
             {"max_acceleration", &Vehicle::maxAcceleration, "Maximum acceleration in m/s^2, of either sign."},
             {"max_steering_rate", &Vehicle::maxSteeringRate, "Maximum steering rate in rad/s."}}};

        Vehicle makeVehicle(const std::string &base, const py::kwargs &fields)
        {
            Vehicle vehicle = readVehicle(base);
            if (!fields.empty())
                vehicle.name = "custom";
            const bool hasLengths = fields.contains("front_overhang") || fields.contains("rear_overhang") ||
                                    fields.contains("width") || fields.contains("wheelbase");
            if (fields.contains("outline"))
            {
                if (fields.contains("wheelbase"))
                    vehicle.wheelbase = numberFrom(fields["wheelbase"], "vehicle: wheelbase");
                vehicle.setOutline(polygonFrom(fields["outline"], "vehicle: outline"));
            }
            else if (hasLengths)
                vehicle.outline.clear();
            for (const auto &[key, value] : fields)
            {
                const auto name = py::cast<std::string>(key);
                if (name == "outline")
                    continue;
                if (name == "name")
                {
                    vehicle.name = py::cast<std::string>(py::str(value));
                    continue;
                }
                const auto *const field =
                    std::find_if(FIELDS.begin(), FIELDS.end(), [&](const Field &each) { return each.name == name; });
                if (field == FIELDS.end())
                {
                    std::vector<std::string> names{"name", "outline"};
                    for (const auto &each : FIELDS)
                        names.emplace_back(each.name);
                    throw Error(unknownName("field of a vehicle", name, names));
                }
                vehicle.*field->value = numberFrom(value, "vehicle: " + name);
            }
            vehicle.validate();
            return vehicle;
        }

        const std::vector<std::string> KINDS{"perpendicular", "parallel", "angled"},
            ENTRIES{"reverse", "forward", "either"}, SIDES{"right", "left", "either"};

        template <class Enum>
        Enum named(const std::string &name, const std::vector<std::string> &names, const std::string &field)
        {
            const auto found = std::find(names.begin(), names.end(), name);
            if (found == names.end())
                throw Error("slot: " + unknownName(field, name, names));
            return static_cast<Enum>(found - names.begin());
        }

        template <class Enum>
        std::string nameOf(Enum value, const std::vector<std::string> &names)
        {
            return names.at(static_cast<std::size_t>(value));
        }

        ParkingSlot makeSlot(const std::string &kind, const py::object &pose, const py::object &length,
                             const py::object &width, const std::string &entry, const py::object &angle,
                             const std::string &side, const py::object &depth, const py::object &lateralOffset)
        {
            ParkingSlot slot;
            slot.kind = named<SlotKind>(kind, KINDS, "kind");
            slot.pose = poseFrom(pose, "slot: pose");
            slot.length = numberFrom(length, "slot: length");
            slot.width = numberFrom(width, "slot: width");
            slot.entry = named<SlotEntry>(entry, ENTRIES, "entry");
            slot.angle = numberFrom(angle, "slot: angle");
            slot.side = named<SlotSide>(side, SIDES, "side");
            if (!depth.is_none())
                slot.depth = numberFrom(depth, "slot: depth");
            slot.lateralOffset = numberFrom(lateralOffset, "slot: lateral_offset");
            slot.validate();
            return slot;
        }

        py::array_t<double> rowsOf(const std::vector<Eigen::Vector2d> &points)
        {
            py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
            auto rows = array.mutable_unchecked<2>();
            for (std::size_t i = 0; i < points.size(); ++i)
                for (int k = 0; k < 2; ++k)
                    rows(static_cast<py::ssize_t>(i), k) = points[i][k];
            return array;
        }
    }  // namespace

    void addVehicles(py::module_ &module)
    {
        module.def("vehicles", &vehicleNames, "Returns the names of the known vehicles.");

        py::class_<Vehicle> vehicle(module, "Vehicle",
                                    R"(A car: its body relative to the rear axle, and its limits.

Vehicle("vw_golf8")                     a known car, see vehicles()
Vehicle("van.yaml")                     a car from a file
Vehicle("vw_golf8", width=1.9)          a known car with another width
Vehicle(wheelbase=2.9, width=1.9)       the car of TPCAP with two other fields
Vehicle(wheelbase=1.5, outline=corners) a body that is any simple polygon: an n x 2 array in the frame of the car

The fields are in metres, radians and other SI units: wheelbase, front_overhang, rear_overhang, width,
max_steering_angle (mean of the front wheels), max_speed, max_acceleration, max_steering_rate. With an outline, overhangs
and width are those of its bounding rectangle. Other lengths replace the outline by a rectangle.)");
        vehicle.def(py::init(&makeVehicle), py::arg("name_or_file") = "tpcap");
        vehicle.def_readonly("name", &Vehicle::name, "Name of the car; custom after a change of its fields.");
        for (const auto &field : FIELDS)
            vehicle.def_readonly(field.name, field.value, field.about);
        vehicle.def_property_readonly("turning_radius", &Vehicle::minTurningRadius,
                                      "Minimum turning radius of the midpoint of the rear axle in metres.");
        vehicle.def_property_readonly("length", &Vehicle::length, "Length from bumper to bumper in metres.");
        vehicle.def_property_readonly(
            "outline", [](const Vehicle &self) { return rowsOf(self.outline); },
            "Corners of the body in the frame of the car, counter-clockwise, as an n x 2 array; empty for a "
            "rectangle.");
        vehicle.def(
            "footprint",
            [](const Vehicle &self, const py::object &pose) { return rowsOf(self.footprint(poseFrom(pose, "pose"))); },
            py::arg("pose"),
            "Returns the corners of the body at a pose, counter-clockwise, as an n x 2 array. Those of a rectangle "
            "begin "
            "at the rear right.");
        vehicle.def(py::pickle([](const Vehicle &self) { return stateOf(self); }, &vehicleOf));
        vehicle.def("__repr__", [](const Vehicle &self) { return "Vehicle('" + self.name + "')"; });

        py::class_<ParkingSlot>(module, "Slot", R"(A parking slot: a rectangle with a pose at its centre.

In perpendicular and angled slots, +x of the pose points out of the slot towards the aisle. In parallel slots, +x is the
direction of travel in the adjacent lane. See docs/scenarios.md for the fields.)")
            .def(py::init(&makeSlot), py::arg("kind"), py::arg("pose"), py::arg("length"), py::arg("width"),
                 py::arg("entry") = "reverse", py::arg("angle") = 0.25 * PI, py::arg("side") = "either",
                 py::arg("depth") = py::none(), py::arg("lateral_offset") = 0.0)
            .def_property_readonly(
                "kind", [](const ParkingSlot &self) { return nameOf(self.kind, KINDS); },
                "Kind of slot: perpendicular, parallel or angled.")
            .def_property_readonly(
                "entry", [](const ParkingSlot &self) { return nameOf(self.entry, ENTRIES); },
                "Direction in which the car enters: reverse, forward or either.")
            .def_property_readonly(
                "side", [](const ParkingSlot &self) { return nameOf(self.side, SIDES); },
                "Side of the aisle on which the slot lies: right, left or either.")
            .def_property_readonly(
                "pose", [](const ParkingSlot &self) { return toPython(self.pose); },
                "Pose of the centre of the slot: (x, y, yaw).")
            .def_readonly("length", &ParkingSlot::length, "Length along the parked car in metres.")
            .def_readonly("width", &ParkingSlot::width, "Width across the parked car in metres.")
            .def_readonly("angle", &ParkingSlot::angle,
                          "Angle between +x of the pose and the aisle of an angled slot, in radians.")
            .def_readonly("depth", &ParkingSlot::depth,
                          "Metres between the closed end of the slot and the car, or None for a centred car.")
            .def_readonly("lateral_offset", &ParkingSlot::lateralOffset,
                          "Offset of the parked car to the left of the slot's axis in metres.")
            .def_property_readonly(
                "outline", [](const ParkingSlot &self) { return rowsOf(self.outline()); },
                "Corners of the slot as a 4 x 2 array.")
            .def(
                "goals",
                [](const ParkingSlot &self, const Vehicle &car)
                {
                    py::list goals;
                    for (const Pose &pose : self.goals(car))
                        goals.append(toPython(pose));
                    return goals;
                },
                py::arg("vehicle"), "Returns the poses (x, y, yaw) of a car parked in the slot, preferred first.")
            .def(py::pickle([](const ParkingSlot &self) { return stateOf(self); }, &slotOf))
            .def("__repr__", [](const ParkingSlot &self) { return "Slot('" + nameOf(self.kind, KINDS) + "')"; });
    }
}  // namespace parking::python
