#pragma once

#include "parking_geometry/FootprintQueries.h"
#include "parking_geometry/ParkingSlot.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace parking
{
    /** \brief What may be said about the world and the manoeuvre beforehand. */
    struct ReverseParkingOptions
    {
        /** Width of the aisle: from the line through the slots' mouths (parallel: the slot's edge) to what bounds it on
            the other side, metres. */
        double aisleWidth{std::numeric_limits<double>::infinity()};

        /** Gap kept all round the body in the construction, metres. 0: the car may graze. */
        double clearance{0.05};

        /** Straight line before (seen from the planner) the first arc, metres. */
        double guardLength{1.5};

        /** Radius to use where there is room for it, metres; 0: 1.15 times the smallest, so that tracking and smoothing
            keep a reserve of steering. Never below the smallest. */
        double preferredRadius{0.0};
    };

    /** \brief Whether there is a manoeuvre, and otherwise what is in its way. */
    enum class ReverseParkingStatus
    {
        Fits,  ///< there is one

        /** No room at the closed end, or (parallel) R_min > R_max: the corner A of the car would hit the bound P of the
            slot. */
        SlotTooShort,
        SlotTooNarrow,   ///< no room beside the car, or (parallel) its tail would swing over the kerb
        AisleTooNarrow,  ///< no radius gets the car round within the aisle
        Blocked          ///< the construction is legal, but the world's callables refuse every variant of it
    };

    /** \brief A manoeuvre into a slot, or why there is none. */
    struct ReverseParkingResult
    {
        ReverseParkingStatus status{ReverseParkingStatus::Blocked};  ///< whether there is one, or what is missing
        std::string message;  ///< one line; what is missing, in centimetres, unless the manoeuvre fits

        SlotEntry entry{SlotEntry::Reverse};  ///< Reverse or Forward
        SlotSide side{SlotSide::Right};       ///< Right or Left
        Pose goal;                            ///< the parked car

        /** From P, the start of the guard line and the planner's goal, to goal; no pieces unless it fits. Where the
            world ends the guard line is shorter than required. */
        Path path;

        double firstRadius{0.0};  ///< metres, of the arc that meets the slot; chosen from [minRadius, maxRadius]
        double minRadius{0.0};  ///< smallest radius: of the steering or, where larger, of the tail's swing to the kerb
        double maxRadius{std::numeric_limits<double>::infinity()};  ///< the paper's R_max (parallel slots)

        double neededSlotLength{0.0};  ///< metres: the shortest slot that would do (other kinds: that holds the car)
        double neededAisleWidth{0.0};  ///< metres: the narrowest aisle in which this slot can be entered in one sweep
        double missing{0.0};           ///< metres of what status names; 0 when it fits or is blocked

        /** \brief Is there a manoeuvre? */
        bool fits() const
        {
            return status == ReverseParkingStatus::Fits;
        }
    };

    /** \brief Reverse parking as in the paper (section "Reverse Parking Planning Method"): the way out of the slot is
        planned and driven backwards.

        - Perpendicular and angled: straight out, an arc into the aisle, a guard line.
        - Parallel: two tangent arcs and a guard line.
        - Forward entry: the same with the car turned round.

        \b Legality. The slot is taken to lie in the world of slotSurroundings(). Within the family of manoeuvres above
        the answer is exact: R_min <= R_max for parallel slots, with R_max from the circle on which the leading outer
        corner A of the body and the corner P of the slot both lie, and R_min the larger of the steering's limit and the
        radius at which the tail clears the kerb; the smallest aisle over all radii for the others. (Forward entry into
        a parallel slot: the kerb condition asks for a whole swing of the tail, which very long slots do not need.)

        \b The world may be less regular than that. With callables in FootprintQueries the manoeuvre is checked along
        its whole length; where the construction is refused, other radii and longer straight pieces are tried before the
        status becomes Blocked, and a slot that is illegal between walls may still be entered when the callables say
        that its neighbours are missing.

        Every computation is made in the slot's frame: rotated, shifted and mirrored slots give rotated, shifted and
        mirrored manoeuvres. */
    class ReverseParking
    {
    public:
        /** \brief Throws parking::Error for an invalid vehicle or option, naming it. */
        explicit ReverseParking(const Vehicle &vehicle, const ReverseParkingOptions &options = {});

        /** \brief The first manoeuvre that fits, of the allowed entries and sides in their order; when none does, the
            verdict that misses the least.

            Throws parking::Error for an invalid slot and for one smaller than the car. */
        ReverseParkingResult plan(const ParkingSlot &slot, const FootprintQueries &world = {}) const;

        /** \brief One result per allowed entry and side: each one that fits is a goal the planner may choose. */
        std::vector<ReverseParkingResult> planAll(const ParkingSlot &slot, const FootprintQueries &world = {}) const;

        /** \brief The car that manoeuvres are made for. */
        const Vehicle &vehicle() const
        {
            return vehicle_;
        }

        /** \brief What was said beforehand. */
        const ReverseParkingOptions &options() const
        {
            return options_;
        }

    private:
        ReverseParkingResult planOne(const ParkingSlot &slot, SlotEntry entry, SlotSide side,
                                     const FootprintQueries &world) const;

        Vehicle vehicle_;
        ReverseParkingOptions options_;
    };

    /** \brief \e first followed by \e second as one path.

        Throws parking::Error when \e second does not start where \e first ends, within 1e-6 m and 1e-6 rad; the end of
        the result is off by what the gap is. */
    Path joined(const Path &first, const Path &second);
}  // namespace parking
