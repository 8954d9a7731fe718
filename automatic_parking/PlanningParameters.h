#pragma once

#include "parking_geometry/manoeuvres/ReverseParking.h"
#include "parking_geometry/smoothing/PathSmoother.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace parking
{
    /** \brief How much of the way is constructed, and not searched from the start. */
    enum class WayIn
    {
        Searched,    ///< nothing: the search goes all the way, as it does for goals without a slot
        OneSweep,    ///< the way into the slot, where a manoeuvre of ReverseParking fits
        InStretches  ///< the same; where none fits it is searched out of the slot, in as many stretches as it takes
    };

    /** \brief The constants that planning into slots was tuned with.

        None of them changes what counts as free. The values were chosen by hand on the known problems: the bundled
        scenarios, the TPCAP cases, and the slots of docs/results/car-slot-table.md. */
    struct PlanningTuning
    {
        /** Metres: motions are proved free as long as they stay so far from contact. */
        double sweepTolerance{1e-3};

        /** \name Whole ways
            @{ */
        double shareForTries{0.5};        ///< of the time limit, that all tries but the last may take together
        double gapOffset{0.02};           ///< metres, in PlanningParameters::gapWorth: what no gap at all counts as
        double manoeuvreRadius{1.1};      ///< of one sweep where there is room, in smallest turning radii
        double manoeuvrePreference{1.5};  ///< a search all the way must be cheaper than a manoeuvre by this factor
        /** @} */

        /** \name Ways in several stretches
            @{ */
        double gearChangeInSlot{4.0};   ///< metres that a change of direction may save on the way out of the slot
        std::size_t manyStretches{8};   ///< ways in of more stretches are sought with the next gap, too,
        double minStretchSaving{0.25};  ///< which is taken when it saves this share of them
        double shareOfStartGap{0.9};    ///< a start nearer to obstacles than the gap is left with this share of its own
        /** @} */

        /** \name Slots of which only the size is known (SlotQuestions.h)
            @{ */
        double reach{15.0};       ///< metres of neighbours and walls to either side
        double openAisle{15.0};   ///< metres after which an aisle without a wall across ends
        double growthStep{0.25};  ///< metres by which a slot that is too small grows
        double mostGrowth{2.0};   ///< metres after which it is given up
        /** @} */
    };

    /** \brief How a parking path is planned: what is tried in which order, and what counts as better.

        The defaults are for driving in a measured world, intoTightSlots() for slots that leave centimetres. The values
        of both were chosen as those of PlanningTuning. */
    struct PlanningParameters
    {
        /** Metres, of WayIn::InStretches: searches keep up to a sweep tolerance less than asked, smoothing half. */
        static constexpr double LEAST_GAP_IN_STRETCHES = 0.004;

        /** Seconds for all tries together; infinite: searches end by expansions alone, on any machine alike. */
        double timeLimit{10.0};

        /** Asked now and then while planning; once it says yes nothing more is tried. May be empty. */
        std::function<bool()> interrupted;

        /** Gaps in metres kept all round the body, largest first. One that start or goal do not leave is not tried.
            \e InStretches: at least 4 mm, and a start that leaves less is left with the room it has. */
        std::vector<double> gaps{0.25, 0.12, 0.06, 0.03, 0.015, 0.0};

        /** What a gap is worth: of two paths the one with the smaller cost + gapWorth * 0.25 m / (gap + 0.02 m) is
            taken, in metres. At 3, keeping 25 cm may cost 7 m of way more than 6 cm, and 6 cm 28 m more than
            grazing. */
        double gapWorth{3.0};

        /** Expansions after which a gap is given up; the last one is granted all of the time, where that is limited. */
        std::uint64_t expansionsPerGap{4000};

        /** Planned turning radius over the car's smallest, at least 1: what is above 1 is room for smoothing and
            correcting. It is given up, down to 1, where nothing else gets through; \e InStretches together with the
            gap. */
        double radiusFactor{1.05};

        double gearChangePenalty{2.0};      ///< metres that a change of direction may save
        double steeringChangePenalty{0.1};  ///< metres that turning the wheels to full lock may save
        double preferredClearance{0.5};     ///< metres kept from obstacles where that is cheap; 0: none
        double clearanceCost{1.0};          ///< extra cost per metre driven nearer than that

        WayIn wayIn{WayIn::OneSweep};  ///< into slots; without a slot everything is searched
        /** Of the manoeuvre in one sweep. Its clearance is not looked at: \e gaps say it. */
        ReverseParkingOptions sweep;

        bool smooth{true};           ///< make the curvature continuous
        SmoothingOptions smoothing;  ///< of the path's curvature, where \e smooth is set

        PlanningTuning tuning;  ///< constants that seldom need another value

        /** \brief For slots that leave centimetres, in a world that is as it is drawn: ways in several stretches, gaps
            of 5, 2 and 1 cm, few stretches before all else, and no clock.

            \param aisleWidth metres, see ReverseParkingOptions */
        static PlanningParameters intoTightSlots(double aisleWidth = std::numeric_limits<double>::infinity());

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };
}  // namespace parking
