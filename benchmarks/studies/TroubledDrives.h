#pragma once

#include "automatic_parking/AutomaticParking.h"
#include "parking_geometry/Scenario.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace parking
{
    /** \brief A disturbance of a drive, in addition to an obstacle that may appear. */
    enum class Trouble
    {
        None,       ///< car and measurements without faults
        Dropout,    ///< poses are missing for 0.1 to 1.5 s, once or twice
        Stuck,      ///< the steering is stuck for 0.2 to 3 s
        Wheelbase,  ///< the wheelbase differs by 3 % from the controller's
        Brake,      ///< the brake is 20 % weaker than commanded
        Delay,      ///< commands arrive 0.3 s late
        Several     ///< wrong wheelbase, weak brake and delay combined
    };

    /** \brief Number of values of Trouble. */
    constexpr std::size_t TROUBLES = static_cast<std::size_t>(Trouble::Several) + 1;

    /** \brief A few words for tables: "wheelbase wrong by 3 %". */
    std::string toString(Trouble trouble);

    /** \brief Result of a drive with a disturbance. */
    struct TroubledDrive
    {
        Trouble trouble{Trouble::None};               ///< the disturbance
        ParkingStatus status{ParkingStatus::NoPath};  ///< status at the end
        std::string message;                          ///< message of the pipeline, one line
        bool stands{false};                           ///< whether the car is at rest in the end
        double duration{0.0};                         ///< seconds until the end
        bool appeared{false};                         ///< whether an obstacle appeared on the path in progress
        double ahead{0.0};                            ///< distance to the obstacle in metres when it appeared
        /** Whether the car could stop before the obstacle. It reacts in one period of the controller plus the delay,
           and then decelerates at this car's limit. */
        bool avoidable{false};
        bool hitAppeared{false};  ///< whether it touched the obstacle before a plan around it
        bool hitOther{false};     ///< whether it touched anything else
        /** Whether the other contact was avoidable: always, except for stuck steering, where braking when it was
            detectable must have sufficed. */
        bool otherAvoidable{false};
        double impactSpeed{0.0};          ///< speed of the first contact in m/s
        std::string brokenLimit;          ///< first command beyond a limit of the car; empty without one
        double fastest{0.0};              ///< maximum measured speed as a share of the limit
        std::vector<std::string> events;  ///< events of the drive, with times
    };

    /** \brief Parks the car of \e scenario, with a disturbance that depends only on \e seed.

        A drive without the obstacle determines the car's position over time. The obstacle is placed 0.5 to 6 m ahead of
        it at a random time. A reference checker tests the simulated drive for contacts every few millimetres.

        \param parameters of the pipeline; their disturbances are replaced */
    TroubledDrive driveInTrouble(const Scenario &scenario, Trouble trouble, std::uint64_t seed,
                                 const ParkingParameters &parameters);
}  // namespace parking
