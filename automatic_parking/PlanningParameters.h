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
    /** \brief Method of planning the slot entry. */
    enum class EntryMode
    {
        Searched,    ///< the search plans the whole path, as for goals without a slot
        OneSweep,    ///< ReverseParking constructs the slot entry in one sweep, if such a manoeuvre fits
        InStretches  ///< as OneSweep; if no sweep fits, a search out of the slot finds an entry in several stretches
    };

    /** \brief Tuned constants of planning into slots.

        None of them changes which poses are free. The values were chosen by hand on the tuning set: the bundled
        scenarios, the TPCAP cases, and the slots of docs/results/car-slot-table.md. */
    struct PlanningTuning
    {
        /** Metres from contact down to which motions are proved free. */
        double sweepTolerance{1e-3};

        /** \name Whole paths
            @{ */
        double attemptsShare{0.5};    ///< share of the time limit for all attempts except the last
        double gapOffset{0.02};       ///< metres added to each gap, see PlanningParameters::gapWeight
        double manoeuvreRadius{1.1};  ///< preferred radius of a sweep, in minimum turning radii
        /** Factor by which a search of the whole path must be cheaper than a manoeuvre. */
        double manoeuvrePreference{1.5};
        /** @} */

        /** \name Slot entries in several stretches
            @{ */
        double gearChangeInSlot{4.0};   ///< metres, cost of a change of direction on the path out of the slot
        std::size_t manyStretches{8};   ///< number of stretches above which the next gap is tried, too
        double minStretchSaving{0.25};  ///< share of stretches that the next gap must save
        double shareOfStartGap{0.9};    ///< share of its own clearance kept by a start nearer to obstacles than the gap
        /** @} */

        /** \name Slots of known size only (SlotQuestions.h)
            @{ */
        double reach{15.0};       ///< metres of neighbours and walls on either side
        double openAisle{15.0};   ///< metres, width of an aisle without an opposite wall
        double growthStep{0.25};  ///< metres by which a slot that is too small grows per step
        double maxGrowth{2.0};    ///< metres of growth at which the search for a slot size ends
        /** @} */
    };

    /** \brief Parameters of a parking planner: the order of its attempts and its cost.

        The defaults are for driving in a measured world; intoTightSlots() is for slots with centimetres of clearance.
        The values of both were chosen as those of PlanningTuning. */
    struct PlanningParameters
    {
        /** Minimum gap of EntryMode::InStretches, in metres. Searches keep up to a sweep tolerance less than the gap,
            smoothing half. */
        static constexpr double MIN_GAP_IN_STRETCHES = 0.004;

        /** Seconds for all attempts in total. If it is infinite, searches end by expansions alone, independent of the
            machine. */
        double timeLimit{10.0};

        /** Polled while planning; once it returns true, no further attempt starts. May be empty. */
        std::function<bool()> interrupted;

        /** Gaps in metres around the body, largest first. A gap larger than the clearance of start or goal is skipped.
            \e InStretches requires at least 4 mm, and leaves a closer start with its own clearance. */
        std::vector<double> gaps{0.25, 0.12, 0.06, 0.03, 0.015, 0.0};

        /** Weight of a gap, in metres. Of two paths the planner chooses the smaller cost + gapWeight * 0.25 m / (gap +
            0.02 m). At 3, a gap of 25 cm may cost 7 m of path more than 6 cm, and 6 cm 28 m more than contact. */
        double gapWeight{3.0};

        /** Expansions per gap. The last gap may use all of the remaining time, if that is limited. */
        std::uint64_t expansionsPerGap{4000};

        /** Planned turning radius over the car's minimum, at least 1. The excess is reserved for smoothing and
            corrections. It is lowered to 1 if no other path is found; \e InStretches lowers it together with the
            gap. */
        double radiusFactor{1.05};

        double gearChangePenalty{2.0};      ///< metres, cost of a change of direction
        double steeringChangePenalty{0.1};  ///< metres, cost of steering to full lock
        double preferredClearance{0.5};     ///< metres kept from obstacles where that is cheap; 0: none
        double clearanceCost{1.0};          ///< extra cost per metre driven closer than preferredClearance

        EntryMode entryMode{EntryMode::OneSweep};  ///< for slots; without a slot the whole path is searched
        /** Options of the manoeuvre in one sweep. Its clearance is ignored: \e gaps replaces it. */
        ReverseParkingOptions sweep;

        bool smooth{true};           ///< whether the curvature is made continuous
        SmoothingOptions smoothing;  ///< of the path's curvature, if \e smooth is set

        PlanningTuning tuning;  ///< tuned constants, seldom changed

        /** \brief Parameters for slots with centimetres of clearance, in an exactly known world. They use slot entries
            in several stretches, gaps of 5, 2 and 1 cm, few stretches as the main criterion, and no time limit.

            \param aisleWidth metres, see ReverseParkingOptions */
        static PlanningParameters intoTightSlots(double aisleWidth = std::numeric_limits<double>::infinity());

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };
}  // namespace parking
