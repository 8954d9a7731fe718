#include "automatic_parking/PlanningParameters.h"

#include "parking_geometry/text/Require.h"

#include <cmath>

namespace parking
{
    PlanningParameters PlanningParameters::intoTightSlots(double aisleWidth)
    {
        PlanningParameters parameters;
        parameters.timeLimit = std::numeric_limits<double>::infinity();
        parameters.gaps = {0.05, 0.02, 0.01};
        parameters.expansionsPerGap = 60000;
        parameters.radiusFactor = 1.03;
        parameters.preferredClearance = 0.0;
        parameters.entryMode = EntryMode::InStretches;
        parameters.sweep.aisleWidth = aisleWidth;
        return parameters;
    }

    void PlanningParameters::validate() const
    {
        const Require require("planning");
        require.that(timeLimit > 0.0, "timeLimit", timeLimit, "a positive number of seconds");
        require.that(!gaps.empty(), "gaps", static_cast<double>(gaps.size()), "a list with at least one gap");
        for (const double gap : gaps)
            if (entryMode == EntryMode::InStretches)
                require.that(std::isfinite(gap) && gap >= MIN_GAP_IN_STRETCHES, "a gap", gap, "at least 0.004 m");
            else
                require.notNegative("a gap", gap);
        require.that(expansionsPerGap > 0, "expansionsPerGap", static_cast<double>(expansionsPerGap),
                     "a positive number of expansions");
        require.that(std::isfinite(radiusFactor) && radiusFactor >= 1.0, "radiusFactor", radiusFactor, "1 or more");
        require.notNegative("gapWeight", gapWeight);
        require.notNegative("gearChangePenalty", gearChangePenalty);
        require.notNegative("steeringChangePenalty", steeringChangePenalty);
        require.notNegative("preferredClearance", preferredClearance);
        require.notNegative("clearanceCost", clearanceCost);
    }
}  // namespace parking
