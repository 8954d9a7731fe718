#include "path_tracking/trajectory/PathLikeness.h"

#include "parking_geometry/Pose.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace parking
{
    namespace
    {
        constexpr double LONGEST_STEP = 2.0;  // metres between two comparisons
        constexpr double FEWEST_STEPS = 4.0;  // of a stretch

        bool isNear(const Path &a, const Path &b, double distance)
        {
            const double lengthA = a.length(), lengthB = b.length();
            const double steps = std::max(FEWEST_STEPS, std::ceil(std::max(lengthA, lengthB) / LONGEST_STEP));
            for (double k = 0.0; k <= steps; ++k)
                if (positionDistance(a.at(lengthA * k / steps), b.at(lengthB * k / steps)) > distance)
                    return false;
            return true;
        }
    }  // namespace

    bool areAlike(const Path &a, const Path &b, double distance)
    {
        const std::vector<Stretch> ofA = a.stretches(), ofB = b.stretches();
        if (ofA.size() != ofB.size())
            return false;
        for (std::size_t i = 0; i < ofA.size(); ++i)
            if (ofA[i].direction != ofB[i].direction ||
                !isNear(a.part(ofA[i].first, ofA[i].last), b.part(ofB[i].first, ofB[i].last), distance))
                return false;
        return true;
    }
}  // namespace parking
