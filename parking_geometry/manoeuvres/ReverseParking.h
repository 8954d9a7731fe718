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
    /** \brief Options of ReverseParking. */
    struct ReverseParkingOptions
    {
        /** Width of the aisle in metres, from the line through the slots' mouths, or from the edge of a parallel slot,
            to the opposite boundary. */
        double aisleWidth{std::numeric_limits<double>::infinity()};

        /** Gap on all sides of the body in the construction, metres. With 0 the car may touch its neighbours. */
        double clearance{0.05};

        /** Length of the guard line, the straight line that ends at the first arc of the entry, metres. */
        double guardLength{1.5};

        /** Preferred radius in metres, used if the clearance suffices. 0 selects 1.15 times the minimum turning radius,
            a steering reserve for tracking and smoothing. Smaller values are raised to the minimum turning radius. */
        double preferredRadius{0.0};
    };

    /** \brief Whether a manoeuvre exists, and otherwise the reason. */
    enum class ReverseParkingStatus
    {
        Fits,  ///< a manoeuvre exists

        /** The gap at the closed end is too small. For parallel slots R_min > R_max: the corner A of the car would hit
            the corner P of the slot. */
        SlotTooShort,
        SlotTooNarrow,   ///< too narrow for the car, or the tail would cross the kerb of a parallel slot
        AisleTooNarrow,  ///< the aisle is too narrow for every radius
        Blocked          ///< the construction is legal, but the world's callables reject every variant
    };

    /** \brief A manoeuvre into a slot, or the reason for its absence. */
    struct ReverseParkingResult
    {
        ReverseParkingStatus status{ReverseParkingStatus::Blocked};  ///< existence, or the missing dimension
        std::string message;  ///< one line with the missing centimetres unless the manoeuvre fits

        SlotEntry entry{SlotEntry::Reverse};  ///< entry of the manoeuvre, Reverse or Forward
        SlotSide side{SlotSide::Right};       ///< side of the slot, Right or Left
        Pose goal;                            ///< pose of the parked car

        /** Path from the start of the guard line, which is the goal of a path planner, to \e goal. It has no pieces
            unless the manoeuvre fits. Near the end of the world the guard line is shorter than required. */
        Path path;

        double firstRadius{0.0};  ///< radius of the arc next to the slot, metres, in [minRadius, maxRadius]
        double minRadius{0.0};    ///< larger of the radii that the steering and the kerb require, metres
        double maxRadius{std::numeric_limits<double>::infinity()};  ///< R_max of the paper (parallel slots), metres

        double neededSlotLength{0.0};  ///< shortest slot for one sweep (parallel) or for the car (others), metres
        double neededAisleWidth{0.0};  ///< narrowest aisle from which one sweep enters this slot, metres
        double missing{0.0};           ///< missing metres of the dimension in status; 0 for Fits and Blocked

        /** \brief Whether a manoeuvre exists. */
        bool fits() const
        {
            return status == ReverseParkingStatus::Fits;
        }
    };

    /** \brief Reverse parking as in the paper (section "Reverse Parking Planning Method"): a path out of the slot,
        driven backwards.

        - Perpendicular and angled: straight out, an arc into the aisle, a guard line.
        - Parallel: two tangent arcs and a guard line.
        - Forward entry: the same shapes with the car turned round.

        \b Legality. The class assumes the world of slotSurroundings(). Within the family of manoeuvres above, its
        result is exact:
        - Parallel slots require R_min <= R_max. R_max belongs to the circle through the leading outer corner A of the
          body and the corner P of the slot. R_min is the larger of the minimum turning radius and the radius at which
          the tail clears the kerb.
        - Other slots require the narrowest aisle over all radii.

        For forward entry into a parallel slot, the kerb condition includes a whole swing of the tail, which very long
        slots do not need.

        \b Irregular \b worlds. With callables in FootprintQueries the class checks the manoeuvre along its whole
        length. If they reject the construction, the class attempts other radii and longer straight pieces before it
        returns Blocked. A slot that is illegal between walls is legal if the callables report that its neighbours are
        absent.

        All computations use the slot's frame. Rotated, shifted and mirrored slots yield rotated, shifted and mirrored
        manoeuvres. */
    class ReverseParking
    {
    public:
        /** \brief Throws parking::Error for an invalid vehicle or option, naming it. */
        explicit ReverseParking(const Vehicle &vehicle, const ReverseParkingOptions &options = {});

        /** \brief The first manoeuvre that fits among the allowed entries and sides, in their order. If none fits, the
            result with the smallest missing dimension.

            Throws parking::Error for an invalid slot and for one that is smaller than the car. */
        ReverseParkingResult plan(const ParkingSlot &slot, const FootprintQueries &world = {}) const;

        /** \brief One result per allowed entry and side. Each one that fits is a possible goal of a path planner. */
        std::vector<ReverseParkingResult> planAll(const ParkingSlot &slot, const FootprintQueries &world = {}) const;

        /** \brief The car of the manoeuvres. */
        const Vehicle &vehicle() const
        {
            return vehicle_;
        }

        /** \brief The options of the constructor. */
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

        Throws parking::Error unless \e second starts at the end of \e first within 1e-6 m and 1e-6 rad. The end of the
        result deviates by this gap. */
    Path joined(const Path &first, const Path &second);
}  // namespace parking
