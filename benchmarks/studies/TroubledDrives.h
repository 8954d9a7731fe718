#pragma once

#include "automatic_parking/AutomaticParking.h"
#include "parking_geometry/Scenario.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace parking
{
    /** \brief What goes wrong on a drive, beside an obstacle that may appear. */
    enum class Trouble
    {
        None,       ///< a car and measurements as they should be
        Dropout,    ///< no pose is measured for 0.1 to 1.5 s, once or twice
        Stuck,      ///< the wheels stay where they are for 0.2 to 3 s
        Wheelbase,  ///< 3 % longer or shorter than the controller believes
        Brake,      ///< slows down 20 % less than it is told to
        Delay,      ///< commands arrive 0.3 s late
        Several     ///< the last three together
    };

    /** \brief Number of values that a Trouble has. */
    constexpr std::size_t TROUBLES = static_cast<std::size_t>(Trouble::Several) + 1;

    /** \brief A few words for tables: "wheelbase wrong by 3 %". */
    std::string toString(Trouble trouble);

    /** \brief What came of one. */
    struct TroubledDrive
    {
        Trouble trouble{Trouble::None};               ///< what went wrong
        ParkingStatus status{ParkingStatus::NoPath};  ///< how it ended
        std::string message;                          ///< one line, of the pipeline
        bool stands{false};                           ///< at the end
        double duration{0.0};                         ///< seconds until then
        bool appeared{false};                         ///< did an obstacle appear on the way that was being driven?
        double ahead{0.0};                            ///< metres left to it then
        /** Could the car stop before it: reacting in a period of the controller, later by the delay, and then slowing
           down as hard as this car can? */
        bool avoidable{false};
        bool hitAppeared{false};  ///< the obstacle, before anything was planned round it
        bool hitOther{false};     ///< anything else
        /** Was that touch avoidable? Always, but where wheels stick: only when braking as soon as that could be seen
            would have avoided it. */
        bool otherAvoidable{false};
        double impactSpeed{0.0};          ///< m/s, of the first touch
        std::string brokenLimit;          ///< the first command beyond a limit of the car; empty when none is
        double fastest{0.0};              ///< share of the speed limit, as measured
        std::vector<std::string> events;  ///< what happened on the way, with times
    };

    /** \brief Parks the car of \e scenario, with trouble that depends on \e seed alone.

        The drive is first made without the obstacle, which says where the car will be when; the obstacle is put in its
       way 0.5 to 6 m ahead at a random time. Touches are looked for by the oracle of the tests every few millimetres of
       the way that the simulated car really took.

        \param parameters of the pipeline; their disturbances do not count */
    TroubledDrive driveInTrouble(const Scenario &scenario, Trouble trouble, std::uint64_t seed,
                                 const ParkingParameters &parameters);
}  // namespace parking
