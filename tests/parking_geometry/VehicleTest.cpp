#include "benchmarks/worlds/OutlinedVehicles.h"
#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Vehicle.h"

#include "parking_geometry/Polygon.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::expectError;

namespace
{
    constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

    struct Field
    {
        const char *name;
        double Vehicle::*member;
        bool zeroAllowed;
    };

    const Field FIELDS[] = {
        {"wheelbase", &Vehicle::wheelbase, false},
        {"front_overhang", &Vehicle::frontOverhang, true},
        {"rear_overhang", &Vehicle::rearOverhang, true},
        {"width", &Vehicle::width, false},
        {"max_steering_angle", &Vehicle::maxSteeringAngle, false},
        {"max_speed", &Vehicle::maxSpeed, false},
        {"max_acceleration", &Vehicle::maxAcceleration, false},
        {"max_steering_rate", &Vehicle::maxSteeringRate, false},
    };
}  // namespace

TEST(Vehicle, DefaultsAreTpcapsCarAndValid)
{
    const Vehicle car;
    EXPECT_NO_THROW(car.validate());
    EXPECT_EQ(car.wheelbase, 2.8);
    EXPECT_EQ(car.frontOverhang, 0.96);
    EXPECT_EQ(car.rearOverhang, 0.929);
    EXPECT_EQ(car.width, 1.942);
    EXPECT_EQ(car.maxSteeringAngle, 0.75);
    EXPECT_NEAR(car.minTurningRadius(), 3.006, 5e-4);
}

TEST(Vehicle, EveryBadFieldIsNamedWithItsValue)
{
    for (const Field &field : FIELDS)
    {
        const auto with = [&field](double value)
        {
            Vehicle car;
            car.*field.member = value;
            return car;
        };
        for (const auto &[bad, text] : {std::pair{NOT_A_NUMBER, "nan"},
                                        {HUGE_VAL, "inf"},
                                        {-HUGE_VAL, "-inf"},
                                        {-0.5, "-0.5"},
                                        {1e300, "1e+300"}})
            expectError([car = with(bad)] { car.validate(); }, {field.name, std::string("is ") + text, "must be"});
        if (field.zeroAllowed)
            EXPECT_NO_THROW(with(0.0).validate()) << field.name;
        else
            expectError([car = with(0.0)] { car.validate(); }, {field.name, "is 0"});
        EXPECT_NO_THROW(with(0.02).validate()) << field.name;
    }
    const auto refused = [](double Vehicle::*member, double value, const std::vector<std::string> &words)
    {
        Vehicle car;
        car.*member = value;
        expectError([&car] { car.validate(); }, words);
    };
    // Millimetres are not metres.
    refused(&Vehicle::wheelbase, 2800.0, {"wheelbase", "2800", "0.01 to 50"});
    refused(&Vehicle::wheelbase, 50.1, {"wheelbase", "50.1"});
    refused(&Vehicle::width, 1e-9, {"width", "0.01 to 50"});
    refused(&Vehicle::maxSteeringAngle, 0.5 * PI, {"max_steering_angle", "90 degrees"});
    // Cars that hardly turn, or on the spot: OMPL's curves fail their own checks for the first, and take any goal ahead
    // for reached with the second.
    for (const double angle : {1.570796326, std::nextafter(0.5 * PI, 0.0), 1e-20, 1e-3})
        refused(&Vehicle::maxSteeringAngle, angle, {"max_steering_angle", "radius", "0.01 to 1000"});
    // Cars that never get there, and other units.
    for (const auto &[name, limit] : {std::pair{"max_speed", &Vehicle::maxSpeed},
                                      {"max_acceleration", &Vehicle::maxAcceleration},
                                      {"max_steering_rate", &Vehicle::maxSteeringRate}})
        for (const double bad : {1e-300, 0.0199, 100.1})
            refused(limit, bad, {name, "from 0.02 to 100"});
    Vehicle extreme;
    extreme.wheelbase = 50.0;
    extreme.maxSteeringAngle = 1.5;
    extreme.maxSpeed = extreme.maxAcceleration = extreme.maxSteeringRate = 100.0;
    EXPECT_NO_THROW(extreme.validate());
}

TEST(Vehicle, CurvatureAndSteeringAreInverse)
{
    const Vehicle car;
    for (double angle = -0.75; angle <= 0.75; angle += 0.01)
        EXPECT_NEAR(car.steeringAngle(car.curvature(angle)), angle, 1e-12);
    EXPECT_NEAR(car.curvature(car.maxSteeringAngle), 1.0 / car.minTurningRadius(), 1e-12);
    EXPECT_LT(car.curvature(-0.1), 0.0);
}

TEST(Vehicle, FootprintHasItsCornersInOrder)
{
    Vehicle car;
    car.wheelbase = 3.0;
    car.frontOverhang = 1.0;
    car.rearOverhang = 0.5;
    car.width = 2.0;
    const Polygon body = car.footprint({10.0, 20.0, 0.0});
    EXPECT_TRUE(body[0].isApprox(Eigen::Vector2d(9.5, 19.0)));   // rear right
    EXPECT_TRUE(body[1].isApprox(Eigen::Vector2d(14.0, 19.0)));  // front right
    EXPECT_TRUE(body[2].isApprox(Eigen::Vector2d(14.0, 21.0)));  // front left
    EXPECT_TRUE(body[3].isApprox(Eigen::Vector2d(9.5, 21.0)));   // rear left
    const Polygon turned = car.footprint({0.0, 0.0, 0.5 * PI});
    EXPECT_TRUE(turned[1].isApprox(Eigen::Vector2d(1.0, 4.0)));
}

/** By points of the outline: what lies between them is off by less than their distance. */
TEST(Vehicle, RoomThatTheBodyNeedsIsThatOfItsOutline)
{
    Vehicle tractor;  // hardly anything in front of the rear axle, which turns nearly on the spot
    tractor.wheelbase = 0.5;
    tractor.frontOverhang = 0.1;
    tractor.rearOverhang = 1.0;
    tractor.width = 0.8;
    tractor.maxSteeringAngle = 0.9;
    Vehicle stiff;
    stiff.maxSteeringAngle = 0.2;
    for (const Vehicle &vehicle : {Vehicle(), tractor, stiff})
        for (const double margin : {0.0, 0.2})
        {
            SCOPED_TRACE(vehicle.width + margin);
            const double rear = -vehicle.rearOverhang - margin, front = rear + vehicle.length() + 2.0 * margin,
                         half = 0.5 * vehicle.width + margin, radius = vehicle.minTurningRadius();
            const double middle = 0.5 * (rear + front);
            double outer = 0.0, inner = 1e9, round = 1e9;
            const int points = 4000;
            for (int i = 0; i <= points; ++i)
            {
                const double x = rear + (front - rear) * i / points, y = half * (2.0 * i / points - 1.0);
                for (const auto &[px, py] : {std::pair{x, -half}, {x, half}, {rear, y}, {front, y}})
                {
                    outer = std::max(outer, std::hypot(px, py - radius));
                    inner = std::min(inner, std::hypot(px, py - radius));
                    round = std::min(round, std::hypot(px - middle, py));
                }
            }
            const bool turnsAboutItself = radius < half && rear < 0.0 && front > 0.0;
            EXPECT_NEAR(vehicle.turningLane(margin), outer - (turnsAboutItself ? 0.0 : inner), 1e-3);
            EXPECT_NEAR(vehicle.bodyRadius(margin), round, 1e-3);
            EXPECT_GE(vehicle.bodyRadius(margin), vehicle.inscribedRadius(margin));
        }
}

TEST(Vehicle, FootprintMovesRigidlyWithItsPose)
{
    parking_test::Random random(7);
    const Vehicle car;
    const Polygon home = car.footprint({});
    for (int i = 0; i < 1000; ++i)
    {
        const Pose pose{random.between(-100.0, 100.0), random.between(-100.0, 100.0), random.between(-100.0, 100.0)};
        const Polygon body = car.footprint(pose);
        for (std::size_t k = 0; k < 4; ++k)
        {
            const Pose expected = compose(pose, {home[k].x(), home[k].y(), 0.0});
            EXPECT_NEAR(body[k].x(), expected.x, 1e-9);
            EXPECT_NEAR(body[k].y(), expected.y, 1e-9);
        }
        EXPECT_NEAR(signedArea({body.begin(), body.end()}), car.length() * car.width, 1e-8);
    }
}

TEST(Vehicle, OutlineDeterminesTheLengthsOfItsBoundingRectangle)
{
    Vehicle car;
    car.wheelbase = 2.0;
    // Clockwise, to the left of the axis and ahead of the rear axle.
    car.setOutline({{0.5, 0.2}, {1.0, 0.9}, {1.5, 0.2}});
    EXPECT_NO_THROW(car.validate());
    EXPECT_GT(signedArea(car.outline), 0.0);
    EXPECT_DOUBLE_EQ(car.rearOverhang, 0.0);  // both axles are within the rectangle
    EXPECT_DOUBLE_EQ(car.frontOverhang, 0.0);
    EXPECT_DOUBLE_EQ(car.width, 1.8);
    EXPECT_DOUBLE_EQ(car.inscribedRadius(), 0.0);  // the axle is outside
    EXPECT_NEAR(car.inscribedRadius(1.0), 1.0 - std::hypot(0.5, 0.2), 1e-12);
    const Vehicle lift = parking_test::forklift();
    EXPECT_DOUBLE_EQ(lift.rearOverhang, 1.6);
    EXPECT_NEAR(lift.frontOverhang, 0.4, 1e-12);
    EXPECT_DOUBLE_EQ(lift.width, 1.1);
    EXPECT_DOUBLE_EQ(lift.inscribedRadius(), 0.4);
}

TEST(Vehicle, CirclesOfTheOutlineAreWithinIt)
{
    parking_test::Random random(5);
    for (int i = 0; i < 200; ++i)
    {
        const Vehicle car = parking_test::randomOutlined(random);
        const Eigen::Vector2d middle = deepestPoint(car.outline);
        EXPECT_DOUBLE_EQ(car.bodyRadius(), depthWithin(car.outline, middle));
        EXPECT_GT(car.bodyRadius(), 0.0);
        EXPECT_GE(car.bodyRadius() + 1e-3, car.inscribedRadius());
        for (double angle = 0.0; angle < 2.0 * PI; angle += 0.1)
        {
            const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
            EXPECT_TRUE(contains(car.outline, middle + 0.999 * car.bodyRadius() * along));
            EXPECT_TRUE(car.inscribedRadius() == 0.0 || contains(car.outline, 0.999 * car.inscribedRadius() * along));
        }
    }
    EXPECT_NEAR(parking_test::rectangularOutline().bodyRadius(), Vehicle().bodyRadius(), 1e-6);
    EXPECT_NEAR(parking_test::rectangularOutline().inscribedRadius(), Vehicle().inscribedRadius(), 1e-12);
}

TEST(Vehicle, RefusesOutlinesThatAreNoBody)
{
    const auto refused = [](const Polygon &outline, const std::string &part)
    {
        Vehicle car;
        car.setOutline(outline);
        parking_test::expectError([&] { car.validate(); }, {"outline", part});
    };
    const double nan = std::nan("");
    refused({{0.0, 0.0}, {1.0, 0.0}}, "has 2 corners; it must have 3 to 128");
    refused(Polygon(129, Eigen::Vector2d(0.0, 0.0)), "has 129 corners");
    refused({{0.0, 0.0}, {nan, 0.0}, {1.0, 1.0}}, "corner 2 at (nan, 0)");
    refused({{0.0, 0.0}, {50.1, 0.0}, {1.0, 1.0}}, "within 50 m");
    refused({{0.0, 0.0}, {2.0, 0.0}, {0.0, 1.0}, {1.5, 1.0}}, "crosses itself");
    refused({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}, "nearer than 1 mm");              // no area
    refused({{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {2.0, 1.0}}, "nearer than 1 mm");  // a corner twice
    refused({{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 0.0}}, "nearer than 1 mm");  // touches itself
    Vehicle car = parking_test::forklift();
    std::reverse(car.outline.begin(), car.outline.end());
    parking_test::expectError([&] { car.validate(); }, {"outline is clockwise"});
    car = parking_test::forklift();
    car.width = 1.2;
    parking_test::expectError([&] { car.validate(); }, {"width is 1.2; it must be 1.1 m, as the outline determines"});
    car = parking_test::forklift();
    car.wheelbase = 1.5;
    parking_test::expectError([&] { car.validate(); }, {"front_overhang"});
    // At the limits.
    car = Vehicle();
    car.wheelbase = 1.0;
    car.setOutline({{-50.0, -0.5}, {0.0, -0.5}, {0.0, -0.4985}, {0.1, 0.5}});
    EXPECT_NO_THROW(car.validate());
}

TEST(VehicleCatalogue, HoldsTenRealCarsOfPlausibleSizes)
{
    const std::vector<std::string> names = vehicleNames();
    EXPECT_GE(names.size(), 11u);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    for (const std::string &name : names)
    {
        const Vehicle car = vehicleByName(name);
        EXPECT_EQ(car.name, name);
        EXPECT_NO_THROW(car.validate());
        EXPECT_GT(car.length(), 2.5) << name;
        EXPECT_LT(car.length(), 5.5) << name;
        EXPECT_GT(car.width, 1.6) << name;
        EXPECT_LT(car.width, 2.2) << name;
        EXPECT_GT(car.frontOverhang, 0.35) << name;
        EXPECT_GT(car.rearOverhang, 0.4) << name;
        // Between a London taxi and a large saloon with sluggish steering.
        EXPECT_GT(car.minTurningRadius(), 2.0) << name;
        EXPECT_LT(car.minTurningRadius(), 5.2) << name;
    }
}

TEST(VehicleCatalogue, PublishedNumbersAreKept)
{
    const Vehicle tpcap = vehicleByName("tpcap");
    EXPECT_EQ(tpcap.rearOverhang, 0.929);
    EXPECT_EQ(tpcap.maxSteeringAngle, 0.75);

    const Vehicle golf = vehicleByName("vw_golf8");
    EXPECT_NEAR(golf.length(), 4.284, 1e-12);
    EXPECT_EQ(golf.width, 1.789);
    EXPECT_EQ(golf.wheelbase, 2.636);
    // The outer front tyre draws the published circle of 10.9 m.
    const double outer = std::hypot(golf.wheelbase, golf.minTurningRadius() + 0.43 * golf.width);
    EXPECT_NEAR(2.0 * outer, 10.9, 1e-9);

    const Vehicle lincoln = vehicleByName("lincoln_mkz");
    EXPECT_NEAR(lincoln.rearOverhang, 1.043, 1e-9);
    EXPECT_NEAR(lincoln.minTurningRadius(), 5.054, 2e-3);
}

TEST(VehicleCatalogue, UnknownNameListsTheKnownOnesAndTheNearest)
{
    expectError([] { vehicleByName("golf"); }, {"'golf'", "did you mean 'vw_golf8', "});
    expectError([] { vehicleByName("telsa_model3"); }, {"did you mean 'tesla_model3'"});
    expectError([] { vehicleByName(""); }, {"unknown vehicle ''"});
    expectError([] { vehicleByName(std::string(5000, 'x') + "\n\x01"); }, {"unknown vehicle"});
}

TEST(VehicleReader, ReadsNamesAndFiles)
{
    const parking_test::TemporaryFolder folder;
    EXPECT_EQ(readVehicle("bmw_3_g20").wheelbase, 2.851);
    const std::string file = folder.write("van.yaml",
                                          "name: van\nwheelbase: 3.4\nfront_overhang: 1.0\nrear_overhang: 1.1\n"
                                          "width: 2.02\nmax_steering_angle: 0.6\nmax_speed: 3\n");
    const Vehicle van = readVehicle(file);
    EXPECT_EQ(van.name, "van");
    EXPECT_EQ(van.wheelbase, 3.4);
    EXPECT_EQ(van.maxSpeed, 3.0);
    EXPECT_EQ(van.maxAcceleration, Vehicle().maxAcceleration);
}

TEST(VehicleReader, NamesWhatIsWrongInAFile)
{
    const parking_test::TemporaryFolder folder;
    const std::string good =
        "wheelbase: 2.8\nfront_overhang: 1\nrear_overhang: 1\nwidth: 1.9\nmax_steering_angle: 0.6\n";
    const auto read = [&folder](const std::string &text)
    {
        return [file = folder.write("car.yaml", text)]
        {
            readVehicle(file);
        };
    };
    EXPECT_NO_THROW(read(good)());
    expectError(read("wheelbase: 2.8\n"), {"car.yaml:1", "'front_overhang' is missing"});
    expectError(read(good + "wheel_base: 2.8\n"), {"car.yaml:6", "'wheel_base'", "did you mean 'wheelbase'"});
    expectError(read(good + "max_speed: fast\n"), {"car.yaml:6", "max_speed is 'fast'"});
    expectError(read(good + "max_speed: -1\n"), {"car.yaml:6: ", "max_speed is -1", "from 0.02 to 100"});
    expectError(read(good + "max_steering_rate: 1e-9\n"), {"car.yaml:6: ", "max_steering_rate is 1e-09"});
    expectError(read("name: ': width is'\n" + std::string(good).replace(good.find("2.8"), 3, "-2")),
                {"car.yaml:2: ", "wheelbase is -2"});
    expectError(read(good + "---\n" + good), {"car.yaml:7: ", "second YAML document"});
    expectError(read(good + "max_speed: .nan\n"), {"car.yaml:6", "max_speed"});
    expectError(read("[1, 2]\n"), {"car.yaml:1", "mapping"});
    expectError([&folder] { readVehicle(folder.path("none.yaml")); }, {"none.yaml", "cannot be opened"});
    expectError([] { readVehicle("glf8"); }, {"'glf8'", "'vw_golf8'", "path of a .yaml file"});
}
