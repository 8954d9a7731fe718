#include "parking_geometry/smoothing/PathSmoother.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/curves/GearSegments.h"
#include "parking_geometry/curves/Kinematics.h"
#include "parking_geometry/smoothing/GearSmoother.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        void check(const char *option, double value, const char *right)
        {
            if (!(std::isfinite(value) && value > 0.0))
                throw Error(std::string("smoothing: ") + option + " is " + formatNumber(value) + "; it must be " +
                            right);
        }

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
            Path pieces;
            Pose end;
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
            SmoothPart keep(const GearSegment &gear) const
            {
                SmoothPart result{{gear.start, {}}, gear.end, planned_, false, true, gear.movingEnd};
                for (const Arc &arc : gear.arcs)
                    result.pieces.pieces.emplace_back(arc.curvature, gear.direction * arc.length);
                result.free = isFree(result);
                return result;
            }

            /** \e piece in as few parts, divided by stops, as can be found. */
            std::vector<SmoothPart> smoothPiece(const GearSegment &piece)
            {
                std::vector<SmoothPart> parts;
                SmoothPart found, attempt;
                for (std::size_t first = 0, arcs = piece.arcs.size(); first < arcs;)
                {
                    // The most arcs from here on that can be joined, by bisection when not all: one always can.
                    std::size_t last = arcs;
                    if (!smooth(piece.part(first, last), found))
                    {
                        std::size_t fails = last;
                        last = first + 1;
                        found = keep(piece.part(first, last));
                        while (fails - last > 1)
                        {
                            const std::size_t middle = last + (fails - last) / 2;
                            if (smooth(piece.part(first, middle), attempt))
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
            bool smooth(const GearSegment &gear, SmoothPart &result)
            {
                if (gear.arcs.size() < 2)
                {
                    result = keep(gear);
                    return true;
                }
                // At the planned speed first, confined to the clearance only when it collides without.
                if (smoothAt(planned_, {false, false}, gear, result) &&
                    (isFree(result) ||
                     (world_.clearance && smoothAt(planned_, {false, true}, gear, result) && isFree(result))))
                    return true;
                return slowest() < planned_ && smoothSlower(gear, result);
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
            bool smoothSlower(const GearSegment &gear, SmoothPart &result)
            {
                for (const Approach approach : {Approach{false, false}, {false, true}, {true, true}, {true, false}})
                {
                    if (approach.confined && !world_.clearance)
                        continue;
                    if (!smoothAt(slowest(), approach, gear, result))
                    {
                        if (approach.confined)
                            continue;
                        return false;
                    }
                    if (!isFree(result))
                        continue;
                    // A soft one steers fast only where it must: the speed it really allows says which one to try.
                    result.speed = std::min(planned_, steeringSpeed(result.pieces));
                    SmoothPart faster;
                    for (double speed = 0.5 * planned_; speed > result.speed; speed *= 0.5)
                        if ((approach.near || speed < 1.5 * result.speed) && smoothAt(speed, approach, gear, faster) &&
                            isFree(faster))
                        {
                            result = std::move(faster);
                            break;
                        }
                    return true;
                }
                return false;
            }

            double steeringSpeed(const Path &pieces) const
            {
                double least = vehicle_.maxSpeed;
                for (const PathPiece &piece : pieces.pieces)
                    least = std::min(least, steeringLimit(vehicle_, piece));
                return least;
            }

            bool smoothAt(double speed, const Approach &approach, const GearSegment &gear, SmoothPart &result)
            {
                const GearSmoother::Limits limits{maxSharpness(vehicle_, speed),
                                                  maxSharpness(vehicle_, approach.near ? speed : planned_),
                                                  approach.near ? NEAR : options_.tolerance};
                result.pieces.start = gear.start;
                result.end = gear.end;
                result.speed = speed;
                result.changed = result.free = true;
                result.movingEnd = gear.movingEnd;
                return smoother_.smooth(gear, limits, approach.confined ? world_.clearance : nullptr,
                                        result.pieces.pieces) &&
                       std::abs(result.pieces.length() - gear.length()) <= LARGEST_CHANGE_OF_LENGTH * gear.length();
            }

            bool isFree(const SmoothPart &part) const
            {
                return isPathFree(world_, vehicle_, part.pieces.sampleEvenly(options_.step));
            }

            const Vehicle &vehicle_;
            const SmoothingOptions &options_;
            const FootprintQueries &world_;
            GearSmoother smoother_;
            double planned_{1.0};
        };

        /** Appends to the result, keeping states, limits and counts together. */
        class Assembly
        {
        public:
            Assembly(const Vehicle &vehicle, const SmoothingOptions &options, const Pose &start, SmoothPath &result)
              : vehicle_(vehicle),
                options_(options),
                result_(result)
            {
                result_.pieces.start = start;
                result_.path.push_back({start, 0.0, 0.0, 1});
                result_.path.back().pose.yaw = wrapAngle(start.yaw);
                result_.speedLimit.push_back(0.0);
            }

            void append(const SmoothPart &part)
            {
                const SampledPath states = part.pieces.sampleEvenly(options_.step);
                if (states.size() < 2)
                    return;
                if (result_.path.size() == 1)
                {
                    result_.path.front().curvature = states.front().curvature;
                    result_.path.front().direction = states.front().direction;
                }
                const double before = result_.path.back().arcLength;
                std::size_t piece = 0;
                double pieceEnd = std::abs(part.pieces.pieces.front().length);
                for (std::size_t i = 1; i < states.size(); ++i)
                {
                    double limit = limitOf(part.pieces.pieces[piece]);
                    while (piece + 1 < part.pieces.pieces.size() && pieceEnd < states[i].arcLength)
                    {
                        ++piece;
                        pieceEnd += std::abs(part.pieces.pieces[piece].length);
                        limit = std::min(limit, limitOf(part.pieces.pieces[piece]));
                    }
                    // The change of curvature between two states limits the speed at both.
                    if (i > 1 || moving_)
                        result_.speedLimit.back() = std::min(result_.speedLimit.back(), limit);
                    result_.path.push_back(states[i]);
                    result_.path.back().arcLength += before;
                    result_.speedLimit.push_back(limit);
                }
                result_.path.back().pose = part.end;
                result_.path.back().pose.yaw = wrapAngle(part.end.yaw);
                moving_ = part.movingEnd;
                if (!moving_)
                    result_.speedLimit.back() = 0.0;
                result_.pieces.pieces.insert(result_.pieces.pieces.end(), part.pieces.pieces.begin(),
                                             part.pieces.pieces.end());
            }

        private:
            double limitOf(const PathPiece &segment) const
            {
                return std::min(vehicle_.maxSpeed, steeringLimit(vehicle_, segment));
            }

            const Vehicle &vehicle_;
            const SmoothingOptions &options_;
            SmoothPath &result_;
            bool moving_{false};  // the last state is passed in motion
        };
    }  // namespace

    std::size_t SmoothPath::continuousGears() const
    {
        return static_cast<std::size_t>(
            std::count_if(gears.begin(), gears.end(), [](const GearReport &gear) { return gear.continuous(); }));
    }

    PathSmoother::PathSmoother(const Vehicle &vehicle, const SmoothingOptions &options)
      : vehicle_(vehicle),
        options_(options)
    {
        vehicle.validate();
        check("speed", options.speed, "a positive number of m/s");
        check("min speed", options.minSpeed, "a positive number of m/s");
        check("step", options.step, "a positive number of metres");
        check("tolerance", options.tolerance, "a positive number of metres");
    }

    SmoothPath PathSmoother::smooth(const Path &path, const FootprintQueries &world) const
    {
        return smooth(gearSegments(path), path.start, world);
    }

    SmoothPath PathSmoother::smooth(const SampledPath &path, const FootprintQueries &world) const
    {
        if (path.empty())
            throw Error("smoothing: the path is empty; it must have at least one state");
        return smooth(gearSegments(path), path.front().pose, world);
    }

    SmoothPath PathSmoother::smooth(const std::vector<GearSegment> &gears, const Pose &start,
                                    const FootprintQueries &world) const
    {
        SmoothPath result;
        Assembly assembly(vehicle_, options_, start, result);
        PartSmoother smoother(vehicle_, options_, world);
        const double maxCurvature = 1.0 / vehicle_.minTurningRadius();
        const double transition = 2.0 * maxCurvature / maxSharpness(vehicle_, smoother.plannedSpeed());
        for (const GearSegment &gear : gears)
        {
            GearReport report;
            report.firstState = result.path.size() - 1;
            report.speed = smoother.plannedSpeed();
            result.lengthBefore += gear.length();
            for (const GearSegment &piece :
                 gear.cutAtLongArcs(LONG_ARC_IN_TRANSITIONS * transition, BEND_OF_CUT * maxCurvature))
                for (const SmoothPart &part : smoother.smoothPiece(piece))
                {
                    assembly.append(part);
                    report.speed = std::min(report.speed, part.speed);
                    report.changed = report.changed || part.changed;
                    result.free = result.free && part.free;
                    if (!part.movingEnd)
                    {
                        result.stops.push_back(result.path.size() - 1);
                        ++report.stops;
                    }
                }
            // The stop at the end of the stretch is a change of direction or the goal.
            result.stops.pop_back();
            --report.stops;
            report.lastState = result.path.size() - 1;
            result.gears.push_back(report);
        }
        return result;
    }
}  // namespace parking
