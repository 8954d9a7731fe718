#include "automatic_parking/ParkingStatus.h"

namespace parking
{
    std::string toString(ParkingStatus status)
    {
        switch (status)
        {
            case ParkingStatus::Parked:
                return "parked";
            case ParkingStatus::InvalidStart:
                return "invalid_start";
            case ParkingStatus::InvalidGoal:
                return "invalid_goal";
            case ParkingStatus::NoPath:
                return "no_path";
            case ParkingStatus::NotDrivable:
                return "not_drivable";
            case ParkingStatus::Collision:
                return "collision";
            case ParkingStatus::Stopped:
                return "stopped";
            case ParkingStatus::MissedGoal:
                return "missed_goal";
        }
        return "stopped";
    }
}  // namespace parking
