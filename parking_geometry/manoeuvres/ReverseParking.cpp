#include "parking_geometry/manoeuvres/ReverseParking.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/manoeuvres/SlotExit.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace parking
{
    namespace
    {
        /** Default preferred radius as a multiple of the minimum turning radius, a steering reserve. */
        constexpr double PREFERRED_RADIUS_FACTOR = 1.15;

        /** Largest additional clearance from the neighbours, in metres, if the aisle is wide enough. */
        constexpr double EXTRA_CLEARANCE = 0.25;

        /** Tolerance in metres, so that results do not depend on rounding. */
        constexpr double TOLERANCE = 1e-9;

        /** Additional straight lengths in metres to attempt if the world rejects the shortest one. */
        constexpr double LATER_TURNS[] = {0.0, 0.5, 1.0, 1.5, 2.0, 3.0};

        std::string inMetres(double metres)
        {
            return formatNumber(std::round(metres * 1000.0) / 1000.0) + " m";
        }

        std::string inCentimetres(double metres)
        {
            return formatNumber(std::ceil(metres * 1000.0 - 1e-6) / 10.0) + " cm";
        }

        /** One car that leaves one slot: the leaving body, its orientation and the result. */
        struct Exit
        {
            const Vehicle &vehicle;
            const ReverseParkingOptions &options;
            const ParkingSlot &slot;
            ExitBody body;
            double direction;  ///< 1 when the car leaves forwards, -1 in reverse
            double mirror;     ///< 1 for a slot on the right, -1 on the left
            double turn;       ///< curvature of the car per curvature in the frame of the leaving body
            Pose local;        ///< parked pose in the frame of the slot
            double minRadius;
            double preferredRadius;
            ReverseParkingResult result;

            /** Converts a piece from the frame of the leaving body of a slot on the right. */
            Arc piece(double curvature, double length) const
            {
                return {turn * curvature, direction * length};
            }

            /** The entry path: \e out, the exit path without its guard line, driven backwards from the start of the
                guard line. */
            Path entryPath(const std::vector<Arc> &out, double guard) const
            {
                Path path{result.goal, {}};
                for (const Arc &arc : out)
                    path.append(arc);
                path.append(piece(0.0, guard));
                return path.reversed();
            }

            void refuse(ReverseParkingStatus status, double missing, const std::string &message)
            {
                result.status = status;
                result.missing = missing;
                result.message = message;
            }
        };

        /** One variant of the manoeuvre. */
        struct Variant
        {
            double firstRadius;
            std::vector<Arc> out;
        };

        // ---- perpendicular and angled --------------------------------------------------------------------------

        Bay bayOf(const Exit &exit)
        {
            const ParkingSlot &slot = exit.slot;
            const double angle = slot.aisleAngle(), lean = slot.width * std::cos(angle) / std::sin(angle);
            const double left = 0.5 * slot.width - exit.local.y, right = 0.5 * slot.width + exit.local.y;
            Bay bay{angle, 0.5 * slot.length + lean - exit.local.x, 0.5 * slot.length - lean - exit.local.x, right,
                    left};
            if (exit.mirror < 0.0)
                std::swap(bay.nearGap, bay.farGap);
            return bay;
        }

        Variant bayVariant(const Exit &exit, const Bay &bay, double radius, double straight)
        {
            return {radius, {exit.piece(0.0, straight), exit.piece(-1.0 / radius, radius * bay.angle)}};
        }

        std::vector<Variant> planBay(Exit &exit, bool allVariants)
        {
            const ParkingSlot &slot = exit.slot;
            const Bay bay = bayOf(exit);
            const ExitBody &body = exit.body;
            ReverseParkingResult &result = exit.result;
            result.minRadius = exit.minRadius;
            result.neededSlotLength = exit.vehicle.length() + 2.0 * exit.options.clearance;
            const double tight = narrowestAisleRadius(bay, body, exit.minRadius);
            result.neededAisleWidth = aisleNeeded(bay, body, tight, straightBeforeTurn(bay, body, tight));
            // The closed end does not limit the exit, because the car moves away from it.
            if (const double outside = body.trail - 0.5 * slot.length - exit.local.x; outside > TOLERANCE)
                exit.refuse(ReverseParkingStatus::SlotTooShort, outside,
                            "the car, with " + inCentimetres(exit.options.clearance) +
                                " at the closed end, protrudes " + inCentimetres(outside) + " from the slot there");
            else if (const double side = std::min(bay.nearGap, bay.farGap); body.halfWidth > side + TOLERANCE)
                exit.refuse(ReverseParkingStatus::SlotTooNarrow, body.halfWidth - side,
                            "the car, with " + inCentimetres(exit.options.clearance) + " on each side, protrudes " +
                                inCentimetres(body.halfWidth - side) + " from the slot's side");
            else if (const double missing = result.neededAisleWidth - exit.options.aisleWidth; missing > TOLERANCE)
                exit.refuse(ReverseParkingStatus::AisleTooNarrow, missing,
                            "the aisle, " + inMetres(exit.options.aisleWidth) + ", is " + inCentimetres(missing) +
                                " too narrow to enter the slot in one sweep; it must be at least " +
                                inMetres(result.neededAisleWidth));

            std::vector<Variant> variants;
            const auto add = [&](double radius, double later)
            {
                const double straight = straightBeforeTurn(bay, body, radius);
                const double spare = exit.options.aisleWidth - aisleNeeded(bay, body, radius, straight);
                const double extra = std::min(EXTRA_CLEARANCE, 0.5 * std::max(0.0, spare)) / std::sin(bay.angle);
                if (later == 0.0 || later * std::sin(bay.angle) < spare)
                    variants.push_back(bayVariant(exit, bay, radius, straight + std::max(extra, later)));
            };
            const double wanted = exit.preferredRadius;
            const bool wantedFits =
                aisleNeeded(bay, body, wanted, straightBeforeTurn(bay, body, wanted)) <= exit.options.aisleWidth;
            const double chosen = wantedFits ? wanted : tight;
            add(chosen, 0.0);
            if (allVariants)
                for (const double radius : {chosen, exit.minRadius, 1.5 * exit.minRadius})
                    for (const double later : LATER_TURNS)
                        add(radius, later);
            return variants;
        }

        // ---- parallel ------------------------------------------------------------------------------------------

        Variant laneVariant(const Exit &exit, const LaneExit &lane)
        {
            return {lane.first,
                    {exit.piece(1.0 / lane.first, lane.first * lane.turn),
                     exit.piece(-1.0 / lane.second, lane.second * lane.turn)}};
        }

        void judgeParallel(Exit &exit, const KerbSlot &kerb, double back)
        {
            const ParkingSlot &slot = exit.slot;
            const ExitBody &body = exit.body;
            ReverseParkingResult &result = exit.result;
            const double swing = kerbRadius(kerb, body);
            result.minRadius = std::max(exit.minRadius, swing);
            result.maxRadius = cornerRadius(kerb, body);
            // A centred car gains half of any additional length at each end.
            const double front = std::isfinite(swing) ? frontNeeded(kerb, body, result.minRadius)
                                                      : std::numeric_limits<double>::infinity();
            const double share = slot.depth ? 1.0 : 2.0;
            result.neededSlotLength = std::max(slot.length + share * (front - kerb.front),
                                               exit.vehicle.length() + 2.0 * exit.options.clearance);

            const double outside = std::max(body.trail - back, body.lead - kerb.front);
            const double tooShort = share * (frontNeeded(kerb, body, exit.minRadius) - kerb.front);
            const double outer = result.maxRadius + body.halfWidth;
            const double tooNear = std::hypot(outer, body.trail) - outer - kerb.kerbGap;
            if (outside > TOLERANCE)
                exit.refuse(ReverseParkingStatus::SlotTooShort, outside,
                            "the car, with " + inCentimetres(exit.options.clearance) + " at each end, protrudes " +
                                inCentimetres(outside) + " from the slot's end");
            else if (kerb.kerbGap < -TOLERANCE)
                exit.refuse(ReverseParkingStatus::SlotTooNarrow, -kerb.kerbGap,
                            "the car, with " + inCentimetres(exit.options.clearance) +
                                " at its side, overlaps the kerb by " + inCentimetres(-kerb.kerbGap));
            else if (result.maxRadius < exit.minRadius - TOLERANCE)
                exit.refuse(ReverseParkingStatus::SlotTooShort, tooShort,
                            "the slot, " + inMetres(slot.length) + " long, is " + inCentimetres(tooShort) +
                                " too short for one sweep: R_min is " + inMetres(exit.minRadius) +
                                ", its corner allows R_max " + inMetres(result.maxRadius));
            else if (result.maxRadius < swing - TOLERANCE)
                exit.refuse(ReverseParkingStatus::SlotTooNarrow, tooNear,
                            "the kerb is " + inCentimetres(tooNear) +
                                " too near for one sweep: the tail would swing over it at R_max " +
                                inMetres(result.maxRadius));
        }

        std::vector<Variant> planParallel(Exit &exit, bool allVariants)
        {
            const ParkingSlot &slot = exit.slot;
            const ExitBody &body = exit.body;
            ReverseParkingResult &result = exit.result;
            const double offset = exit.mirror * exit.local.y;
            const KerbSlot kerb{0.5 * slot.length - exit.direction * exit.local.x, 0.5 * slot.width - offset,
                                0.5 * slot.width + offset - body.halfWidth};
            judgeParallel(exit, kerb, 0.5 * slot.length + exit.direction * exit.local.x);

            const double smallest = std::isfinite(result.minRadius) ? result.minRadius : exit.minRadius;
            const LaneExit tight = narrowestLaneExit(kerb, body, smallest, exit.minRadius);
            result.neededAisleWidth = laneNeeded(kerb, body, tight);
            const double aisle = exit.options.aisleWidth;
            if (result.status == ReverseParkingStatus::Fits && !passes(kerb, body, tight))
            {
                // With turns of a right angle it passes a neighbour at this distance.
                const double far = std::max(kerb.aisleSide + body.halfWidth, smallest + exit.minRadius);
                const double missing = (slot.depth ? 1.0 : 2.0) * std::max(1e-3, far - kerb.front);
                result.neededSlotLength = std::max(result.neededSlotLength, slot.length + missing);
                exit.refuse(ReverseParkingStatus::SlotTooShort, missing,
                            "the slot, " + inMetres(slot.length) + " long, is up to " + inCentimetres(missing) +
                                " too short for one sweep: the car would have to turn by more than a right angle");
            }
            if (result.status == ReverseParkingStatus::Fits)
                if (const double missing = result.neededAisleWidth - aisle; missing > TOLERANCE)
                    exit.refuse(ReverseParkingStatus::AisleTooNarrow, missing,
                                "the lane, " + inMetres(aisle) + ", is " + inCentimetres(missing) +
                                    " too narrow to leave the slot in one sweep; it must be at least " +
                                    inMetres(result.neededAisleWidth));

            std::vector<Variant> variants;
            const auto add = [&](const LaneExit &lane)
            {
                const double spare = aisle - laneNeeded(kerb, body, lane);
                const LaneExit wider = widened(lane, std::min(EXTRA_CLEARANCE, 0.5 * std::max(0.0, spare)));
                const bool isBetter = laneNeeded(kerb, body, wider) <= aisle && passes(kerb, body, wider);
                variants.push_back(laneVariant(exit, isBetter ? wider : lane));
            };
            const double wanted =
                std::max(smallest, std::min(exit.preferredRadius, std::max(result.maxRadius, smallest)));
            const LaneExit comfortable = shallowestExit(kerb, body, wanted, std::max(wanted, exit.preferredRadius));
            const bool isComfortable = laneNeeded(kerb, body, comfortable) <= aisle && passes(kerb, body, comfortable);
            add(isComfortable ? comfortable : tight);
            if (allVariants)
                for (const double first : {smallest, wanted})
                    for (const double second : {exit.minRadius, exit.preferredRadius, 2.0 * exit.minRadius})
                    {
                        add(shallowestExit(kerb, body, first, second));
                        variants.push_back(laneVariant(exit, shallowestExit(kerb, body, first, second)));
                    }
            return variants;
        }

        /** The allowed entries and sides, in their order. */
        std::vector<std::pair<SlotEntry, SlotSide>> entriesAndSides(const ParkingSlot &slot)
        {
            std::vector<std::pair<SlotEntry, SlotSide>> ways;
            for (const SlotEntry entry : {SlotEntry::Reverse, SlotEntry::Forward})
                for (const SlotSide side : {SlotSide::Right, SlotSide::Left})
                    if ((slot.entry == SlotEntry::Either || slot.entry == entry) &&
                        (slot.side == SlotSide::Either || slot.side == side))
                        ways.emplace_back(entry, side);
            return ways;
        }

        bool isEmpty(const FootprintQueries &world)
        {
            return !world.isFree && !world.clearance && !world.isPathFree;
        }
    }  // namespace

    ReverseParking::ReverseParking(const Vehicle &vehicle, const ReverseParkingOptions &options)
      : vehicle_(vehicle),
        options_(options)
    {
        vehicle.validate();
        const Require require("reverse parking");
        require.that(options.aisleWidth > 0.0, "aisle width", options.aisleWidth, "a positive number of metres");
        require.notNegative("clearance", options.clearance, "metres");
        require.notNegative("guard length", options.guardLength, "metres");
        require.notNegative("preferred radius", options.preferredRadius, "metres");
    }

    ReverseParkingResult ReverseParking::planOne(const ParkingSlot &slot, SlotEntry entry, SlotSide side,
                                                 const FootprintQueries &world) const
    {
        const bool tailLeads = entry == SlotEntry::Forward;
        const double direction = tailLeads ? -1.0 : 1.0, mirror = side == SlotSide::Left ? -1.0 : 1.0;
        // A car that leaves in reverse is turned round in that frame. Left stays left, and driving backwards changes
        // the sign of a turn. A car leaves a parallel slot backwards towards its rear, which mirrors the frame again.
        const double turn = slot.kind == SlotKind::Parallel ? mirror : mirror * direction;
        Exit exit{vehicle_, options_, slot, {}, direction, mirror, turn, {}, 0.0, 0.0, {}};
        const double front = vehicle_.wheelbase + vehicle_.frontOverhang + options_.clearance;
        const double rear = vehicle_.rearOverhang + options_.clearance;
        exit.body = {tailLeads ? rear : front, tailLeads ? front : rear, 0.5 * vehicle_.width + options_.clearance};
        // The formulas require a turning centre outside of the body, which holds for every real car.
        exit.minRadius = std::max(vehicle_.minTurningRadius(), 1.01 * exit.body.halfWidth);
        exit.preferredRadius =
            std::max(exit.minRadius, options_.preferredRadius > 0.0 ? options_.preferredRadius
                                                                    : PREFERRED_RADIUS_FACTOR * exit.minRadius);
        ReverseParkingResult &result = exit.result;
        result.status = ReverseParkingStatus::Fits;
        result.entry = entry;
        result.side = side;
        ParkingSlot entered = slot;
        entered.entry = entry;
        result.goal = entered.goals(vehicle_).front();
        exit.local = relativeTo(slot.pose, result.goal);

        const bool checked = !isEmpty(world);
        const std::vector<Variant> variants =
            slot.kind == SlotKind::Parallel ? planParallel(exit, checked) : planBay(exit, checked);
        if (!checked && !result.fits())
            return result;
        for (const Variant &variant : variants)
        {
            if (!isPathFree(world, vehicle_, exit.entryPath(variant.out, 0.0)))
                continue;
            double guard = options_.guardLength;
            result.path = exit.entryPath(variant.out, guard);
            for (; guard > 0.0 && !isPathFree(world, vehicle_, result.path);
                 result.path = exit.entryPath(variant.out, guard))
                guard = guard > 0.25 ? 0.5 * guard : 0.0;
            result.status = ReverseParkingStatus::Fits;
            result.message.clear();
            result.missing = 0.0;
            result.firstRadius = variant.firstRadius;
            return result;
        }
        if (result.fits())
            exit.refuse(ReverseParkingStatus::Blocked, 0.0,
                        "obstacles block all " + std::to_string(variants.size()) +
                            " variants of entering the slot in one sweep");
        return result;
    }

    std::vector<ReverseParkingResult> ReverseParking::planAll(const ParkingSlot &slot,
                                                              const FootprintQueries &world) const
    {
        slot.validate();
        std::vector<ReverseParkingResult> results;
        for (const auto &[entry, side] : entriesAndSides(slot))
            results.push_back(planOne(slot, entry, side, world));
        return results;
    }

    ReverseParkingResult ReverseParking::plan(const ParkingSlot &slot, const FootprintQueries &world) const
    {
        slot.validate();
        std::optional<ReverseParkingResult> best;
        for (const auto &[entry, side] : entriesAndSides(slot))
        {
            ReverseParkingResult result = planOne(slot, entry, side, world);
            if (result.fits())
                return result;
            if (!best || result.missing < best->missing)
                best = std::move(result);
        }
        return *best;
    }

    Path joined(const Path &first, const Path &second)
    {
        const Pose meeting = first.end();
        const double gap = positionDistance(second.start, meeting);
        const double turn = std::abs(wrapAngle(second.start.yaw - meeting.yaw));
        if (!(gap <= 1e-6 && turn <= 1e-6))
            throw Error("paths to be joined are " + formatNumber(gap) + " m and " + formatNumber(turn) +
                        " rad apart; the second must start where the first ends");
        Path path = first;
        path.extend(second);
        return path;
    }
}  // namespace parking
