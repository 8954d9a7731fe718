#include "automatic_parking/ParkingStatus.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace
{
    using parking::ParkingStatus;

    TEST(ParkingStatusTest, everyStatusHasANameOfItsOwn)
    {
        std::set<std::string> names;
        for (const ParkingStatus status :
             {ParkingStatus::Parked, ParkingStatus::InvalidStart, ParkingStatus::InvalidGoal, ParkingStatus::NoPath,
              ParkingStatus::NotDrivable, ParkingStatus::Collision, ParkingStatus::Stopped, ParkingStatus::MissedGoal})
            names.insert(toString(status));
        EXPECT_EQ(names.size(), 8u);
        EXPECT_EQ(names.count("parked"), 1u);
    }
}  // namespace
