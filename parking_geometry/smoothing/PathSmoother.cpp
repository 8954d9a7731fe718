#include "parking_geometry/smoothing/PathSmoother.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/curves/Kinematics.h"
#include "parking_geometry/smoothing/StretchPart.h"
#include "parking_geometry/smoothing/StretchSmoother.h"
#include "parking_geometry/text/Require.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Share of its length by which smoothing may lengthen or shorten a stretch. */
        constexpr double LARGEST_CHANGE_OF_LENGTH = 0.03;

        /** Tolerance, metres, that makes a curve keep to the arcs as closely as its limits allow. */
        constexpr double NEAR = 0.005;

        /** Arcs are long enough to be followed exactly in their middle when they have room for this many transitions
            from lock to lock at the planned speed. */
        constexpr double LONG_ARC_IN_TRANSITIONS = 2.0;

        /** Only arcs that bend less than this part of the limit are followed exactly. */
        constexpr double BEND_OF_CUT = 0.99;

        /** The speed up to which the steering keeps up along all of \e piece. */
        double steeringLimit(const Vehicle &vehicle, const PathPiece &piece)
        {
            const double from = piece.curvature, to = piece.endCurvature();
            const double least = from * to <= 0.0 ? 0.0 : std::min(std::abs(from), std::abs(to));
            return maxSpeedForSharpness(vehicle, piece.sharpness, least);
        }

        /** A part of a stretch between two stops. */
        struct SmoothPart
        {
            Path path;
            double speed{0.0};
            bool changed{false};
            bool free{true};
            bool movingEnd{false};
        };

        /** Smooths parts of one path. */
        class PartSmoother
        {
        public:
            PartSmoother(const Vehicle &vehicle, const SmoothingOptions &options, const FootprintQueries &world)
              : vehicle_(vehicle),
                options_(options),
                world_(world),
                smoother_(vehicle)
            {
                planned_ = std::min(options.speed, vehicle.maxSpeed);
            }

            double plannedSpeed() const
            {
                return planned_;
            }

            /** One arc as it is. */
            SmoothPart keep(const StretchPart &part) const
            {
                return {part.arcs, planned_, false, isPathFree(world_, vehicle_, part.arcs), part.movingEnd};
            }

            /** \e whole in as few parts, divided by stops, as can be found. */
            std::vector<SmoothPart> smooth(const StretchPart &whole)
            {
                std::vector<SmoothPart> parts;
                SmoothPart found, attempt;
                for (std::size_t first = 0, arcs = whole.arcs.pieces.size(); first < arcs;)
                {
                    // The most arcs from here on that can be joined, by bisection when not all: one always can.
                    std::size_t last = arcs;
                    if (!smoothAsOne(whole.part(first, last), found))
                    {
                        std::size_t fails = last;
                        last = first + 1;
                        found = keep(whole.part(first, last));
                        while (fails - last > 1)
                        {
                            const std::size_t middle = last + (fails - last) / 2;
                            if (smoothAsOne(whole.part(first, middle), attempt))
                            {
                                last = middle;
                                std::swap(found, attempt);
                            }
                            else
                                fails = middle;
                        }
                    }
                    parts.push_back(std::move(found));
                    first = last;
                }
                return parts;
            }

        private:
            bool smoothAsOne(const StretchPart &part, SmoothPart &result)
            {
                if (part.arcs.pieces.size() < 2)
                {
                    result = keep(part);
                    return true;
                }
                // At the planned speed first, confined to the clearance only when it collides without.
                if (smoothAt(planned_, {false, false}, part, result) &&
                    (isFree(result) ||
                     (world_.clearance && smoothAt(planned_, {false, true}, part, result) && isFree(result))))
                    return true;
                return slowest() < planned_ && smoothSlower(part, result);
            }

            double slowest() const
            {
                return std::min(planned_, options_.minSpeed);
            }

            /** How to look for a curve at some speed. */
            struct Approach
            {
                bool
                    near;  ///< deviate as little as the speed allows, rather than steer as softly as at the planned one
                bool confined;  ///< to the clearance
            };

            /** Below the planned speed. What works is found out at the lowest one, where there is the most room, and
                then tried at higher ones. */
            bool smoothSlower(const StretchPart &part, SmoothPart &result)
            {
                for (const Approach approach : {Approach{false, false}, {false, true}, {true, true}, {true, false}})
                {
                    if (approach.confined && !world_.clearance)
                        continue;
                    if (!smoothAt(slowest(), approach, part, result))
                    {
                        if (approach.confined)
                            continue;
                        return false;
                    }
                    if (!isFree(result))
                        continue;
                    // A soft one steers fast only where it must: the speed it really allows says which one to try.
                    result.speed = std::min(planned_, steeringSpeed(result.path));
                    SmoothPart faster;
                    for (double speed = 0.5 * planned_; speed > result.speed; speed *= 0.5)
                        if ((approach.near || speed < 1.5 * result.speed) && smoothAt(speed, approach, part, faster) &&
                            isFree(faster))
                        {
                            result = std::move(faster);
                            break;
                        }
                    return true;
                }
                return false;
            }

            double steeringSpeed(const Path &path) const
            {
                double least = vehicle_.maxSpeed;
                for (const PathPiece &piece : path.pieces)
                    least = std::min(least, steeringLimit(vehicle_, piece));
                return least;
            }

            bool smoothAt(double speed, const Approach &approach, const StretchPart &part, SmoothPart &result)
            {
                const StretchSmoother::Limits limits{maxSharpness(vehicle_, speed),
                                                     maxSharpness(vehicle_, approach.near ? speed : planned_),
                                                     approach.near ? NEAR : options_.tolerance};
                result.path.start = part.arcs.start;
                result.speed = speed;
                result.changed = result.free = true;
                result.movingEnd = part.movingEnd;
                const double length = part.arcs.length();
                return smoother_.smooth(part, limits, approach.confined ? world_.clearance : nullptr,
                                        result.path.pieces) &&
                       std::abs(result.path.length() - length) <= LARGEST_CHANGE_OF_LENGTH * length;
            }

            bool isFree(const SmoothPart &part) const
            {
                return isPathFree(world_, vehicle_, part.path);
            }

            const Vehicle &vehicle_;
            const SmoothingOptions &options_;
            const FootprintQueries &world_;
            StretchSmoother smoother_;
            double planned_{1.0};
        };

        /** Appends what became of a stretch. */
        void append(SmoothPath &result, const std::vector<SmoothPart> &parts, StretchReport &report)
        {
            bool standing = true;
            for (const SmoothPart &part : parts)
            {
                if (standing && report.pieces.first < result.path.pieces.size())
                {
                    result.stops.push_back(result.path.pieces.size());
                    ++report.stops;
                }
                // After a stop a piece begins in any case; halves of an arc that was cut are one again.
                if (standing)
                    result.path.pieces.push_back(part.path.pieces.front());
                result.path.extend(part.path.part(standing ? 1 : 0, part.path.pieces.size()));
                report.speed = std::min(report.speed, part.speed);
                report.changed = report.changed || part.changed;
                result.free = result.free && part.free;
                standing = !part.movingEnd;
            }
            report.pieces.last = result.path.pieces.size();
        }

        /** The arcs of a stretch, equal neighbours merged. */
        StretchPart arcsOf(const Path &path, const Stretch &stretch)
        {
            const Path part = path.part(stretch.first, stretch.last);
            StretchPart result{{part.start, {}}, false, false};
            result.arcs.extend(part);
            return result;
        }
    }  // namespace

    std::size_t SmoothPath::continuousStretches() const
    {
        return static_cast<std::size_t>(std::count_if(stretches.begin(), stretches.end(),
                                                      [](const StretchReport &each) { return each.isContinuous(); }));
    }

    PathSmoother::PathSmoother(const Vehicle &vehicle, const SmoothingOptions &options)
      : vehicle_(vehicle),
        options_(options)
    {
        vehicle.validate();
        const Require require("smoothing");
        require.positive("speed", options.speed, "m/s");
        require.positive("min speed", options.minSpeed, "m/s");
        require.positive("tolerance", options.tolerance, "metres");
    }

    SmoothPath PathSmoother::smooth(const Path &path, const FootprintQueries &world) const
    {
        for (const PathPiece &piece : path.pieces)
            if (piece.turn != 0.0 || piece.sharpness != 0.0)
                throw Error("smoothing: piece " + std::to_string(&piece - path.pieces.data()) +
                            (piece.turn != 0.0 ? " turns on the spot" : " is a clothoid") +
                            "; only arcs and lines can be smoothed");
        SmoothPath result;
        result.path.start = path.start;
        result.lengthBefore = path.length();
        PartSmoother smoother(vehicle_, options_, world);
        const double maxCurvature = 1.0 / vehicle_.minTurningRadius();
        const double transition = 2.0 * maxCurvature / maxSharpness(vehicle_, smoother.plannedSpeed());
        for (const Stretch &stretch : path.stretches())
        {
            StretchReport report;
            report.pieces = {result.path.pieces.size(), 0, stretch.direction};
            report.speed = smoother.plannedSpeed();
            std::vector<SmoothPart> parts;
            for (const StretchPart &part :
                 arcsOf(path, stretch).cutAtLongArcs(LONG_ARC_IN_TRANSITIONS * transition, BEND_OF_CUT * maxCurvature))
                for (SmoothPart &each : smoother.smooth(part))
                    parts.push_back(std::move(each));
            append(result, parts, report);
            result.stretches.push_back(report);
        }
        return result;
    }
}  // namespace parking
