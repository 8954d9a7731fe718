#include "parking_geometry/Error.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/text/NearestName.h"

#include <cmath>

namespace parking
{
    namespace
    {
        /** Published form of the limit of the front wheels. */
        enum class Steering
        {
            Angle,         ///< the mean steering angle itself, radians
            TurningCircle  ///< the diameter that the outer front tyre draws, metres
        };

        /** One published car. A front overhang of 0 means that no source gives the overhangs. */
        struct Entry
        {
            const char *name;
            double length, width, wheelbase, frontOverhang;
            Steering known;
            double steering;
        };

        /** Share of the overhangs that lies in front where only their sum, length - wheelbase, is published. The cars
            below with both published, and the car of MathWorks' vehicleDimensions (0.9 / 1.0 m), have 0.46 to 0.51. */
        constexpr double FRONT_SHARE = 0.48;

        /** Half the track as a share of the body's width, because widths are published more often than tracks (Lexus RX
            450h: 1.64 m of 1.896 m, Corolla Sport: 1.53 m of 1.79 m). */
        constexpr double HALF_TRACK = 0.43;

        /** Turning circle in wheelbases where none is published: the six cars below with a published circle lie between
            3.7 and 4.14. */
        constexpr double CIRCLE_IN_WHEELBASES = 4.0;

        /** The cars and their sources. Widths exclude mirrors unless a comment states otherwise. */
        const Entry CATALOGUE[] = {
            // Car of the Trajectory Planning Competition of Automated Parking: Vehicle.py of its-ant-bupt/HALOES.
            {"tpcap", 4.689, 1.942, 2.8, 0.96, Steering::Angle, 0.75},
            // Apollo's reference car: vehicle_param.pb.txt of ApolloAuto/apollo. Its width includes the mirrors.
            {"lincoln_mkz", 4.933, 2.11, 2.8448, 1.0452, Steering::Angle, 0.51269},
            // Autoware's sample car: vehicle_info.param.yaml of sample_vehicle_launch.
            {"lexus_rx450h", 4.89, 1.896, 2.79, 1.0, Steering::Angle, 0.7},
            // Volkswagen's press text of the Golf VIII; turning circle 10.9 m from neuss-autocenter.de.
            {"vw_golf8", 4.284, 1.789, 2.636, 0.0, Steering::TurningCircle, 10.9},
            // Wikipedia, BMW 3 Series (G20). No circle in the pages read: the rule gives the 11.4 m often quoted.
            {"bmw_3_g20", 4.709, 1.827, 2.851, 0.0, Steering::TurningCircle, CIRCLE_IN_WHEELBASES * 2.851},
            // Owner's manual as quoted by teslatuneup.com (length, width), teslahunt's list of Tesla specifications
            // (wheelbase), carspecslab.com (turning circle 11.8 m).
            {"tesla_model3", 4.694, 1.849, 2.875, 0.0, Steering::TurningCircle, 11.8},
            // autoevolution.com (length, wheelbase), mercedesblog.com: 12.2 m without rear-wheel steering. The 10.2 m
            // with it do not fit a car that steers with its front wheels only. The width is unverified.
            {"mercedes_s_w223", 5.179, 1.954, 3.106, 0.0, Steering::TurningCircle, 12.2},
            // Specification table of eathealthy365.com, a weak source.
            {"toyota_yaris", 4.105, 1.694, 2.57, 0.0, Steering::TurningCircle, 9.8},
            // Japanese sedan: bestcarweb.jp, auto.excite.co.jp; smallest turning radius 5.3 m (with the wider of its
            // tyres) from nextage.jp.
            {"toyota_corolla", 4.495, 1.745, 2.64, 0.0, Steering::TurningCircle, 10.6},
            // Third generation: carwow.co.uk (sizes), autonxt.net (turning circle 22.8 ft).
            {"smart_fortwo", 2.695, 1.663, 1.873, 0.0, Steering::TurningCircle, 6.95},
            // Vehicles 1 and 3 of CommonRoad (parameters_vehicleN.yaml). Their steering limits, above 0.9 rad, are
            // those of a dynamics model and not of the cars: the rule is used instead.
            {"ford_escort", 4.298, 1.674, 2.3927, 0.0, Steering::TurningCircle, CIRCLE_IN_WHEELBASES * 2.3927},
            {"vw_vanagon", 4.569, 1.844, 2.4719, 0.0, Steering::TurningCircle, CIRCLE_IN_WHEELBASES * 2.4719},
        };

        /** Mean steering angle of a car whose outer front tyre draws a circle of diameter \e circle.

            By Ackermann steering, this tyre has the radius sqrt(wheelbase^2 + (R + track / 2)^2) about the turning
            centre. R is the radius of the rear axle's midpoint. */
        double steeringOfCircle(double circle, double wheelbase, double width)
        {
            const double radius = std::sqrt(0.25 * circle * circle - wheelbase * wheelbase) - HALF_TRACK * width;
            return std::atan(wheelbase / radius);
        }

        Vehicle toVehicle(const Entry &entry)
        {
            Vehicle vehicle;
            vehicle.name = entry.name;
            vehicle.wheelbase = entry.wheelbase;
            const double overhangs = entry.length - entry.wheelbase;
            vehicle.frontOverhang = entry.frontOverhang > 0.0 ? entry.frontOverhang : FRONT_SHARE * overhangs;
            vehicle.rearOverhang = overhangs - vehicle.frontOverhang;
            vehicle.width = entry.width;
            vehicle.maxSteeringAngle = entry.known == Steering::Angle
                                           ? entry.steering
                                           : steeringOfCircle(entry.steering, entry.wheelbase, entry.width);
            return vehicle;
        }
    }  // namespace

    Vehicle vehicleByName(const std::string &name)
    {
        for (const Entry &entry : CATALOGUE)
            if (name == entry.name)
                return name == "tpcap" ? Vehicle() : toVehicle(entry);
        throw Error(unknownName("vehicle", name, vehicleNames()));
    }

    std::vector<std::string> vehicleNames()
    {
        std::vector<std::string> names;
        for (const Entry &entry : CATALOGUE)
            names.emplace_back(entry.name);
        return names;
    }
}  // namespace parking
