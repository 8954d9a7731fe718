#include "path_tracking/reference/MakeDrivable.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "parking_geometry/text/Text.h"
#include "path_tracking/reference/CornerRounding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double SHUNT_STEP = 0.1;       ///< metres between the places where a shunt's deviation is looked at
        constexpr double SHORTEST_PIECE = 1e-7;  ///< metres; less is rounding
        constexpr double MOST_CURVATURE = 1.01;  ///< of the car's that a path may have: rounding of turning radii
        constexpr double ROUNDING_TURN = 1e-9;   ///< radians; less is rounding of headings and not a corner
        constexpr double EXACT = 1e-5;           ///< metres from a place that count as standing there
        constexpr double EXACT_YAW = 1e-6;       ///< radians likewise
        constexpr double BESIDE = 0.01;          ///< metres from a place that two gentle arcs make good
        constexpr double BESIDE_YAW = 0.03;      ///< radians likewise

        bool apart(const Pose &a, const Pose &b, double most, double mostYaw)
        {
            return positionDistance(a, b) > most || std::abs(wrapAngle(a.yaw - b.yaw)) > mostYaw;
        }

        bool isCorner(const PathPiece &piece)
        {
            return std::abs(piece.turn) > ROUNDING_TURN;
        }

        void check(const Path &path, const Vehicle &vehicle)
        {
            if (!isFinite(path.start))
                throw Error("path: its start must be finite numbers");
            const double most = MOST_CURVATURE / vehicle.minTurningRadius();
            for (std::size_t i = 0; i < path.pieces.size(); ++i)
            {
                const PathPiece &piece = path.pieces[i];
                const auto fail = [i](const std::string &what)
                {
                    throw Error("path piece " + std::to_string(i) + ": " + what);
                };
                for (const double value : {piece.curvature, piece.length, piece.sharpness, piece.turn})
                    if (!std::isfinite(value))
                        fail("curvature, length, sharpness and turn must be finite numbers");
                if (piece.turn != 0.0 && piece.length != 0.0)
                    fail("it both drives and turns on the spot");
                for (const double curvature : {piece.curvature, piece.endCurvature()})
                    if (std::abs(curvature) > most)
                        fail("curvature " + formatNumber(curvature) + " 1/m is beyond the car's " +
                             formatNumber(1.0 / vehicle.minTurningRadius()) + " 1/m");
            }
            // Shorter pieces are dropped, however many there are.
            if (std::none_of(path.pieces.begin(), path.pieces.end(),
                             [](const PathPiece &piece) { return piece.driven() >= SHORTEST_PIECE; }))
                throw Error("path: it must have a length");
        }

        /** The same path with at most one turn at a place. */
        Path withTurnsMerged(const Path &path)
        {
            Path merged{path.start, {}};
            for (const PathPiece &piece : path.pieces)
                if (piece.turn != 0.0 && !merged.pieces.empty() && merged.pieces.back().turn != 0.0)
                    merged.pieces.back().turn += piece.turn;
                else if (piece.turn != 0.0 || piece.driven() >= SHORTEST_PIECE)
                    merged.append(piece);
            return merged;
        }

        class Builder
        {
        public:
            Builder(const Vehicle &vehicle, const CornerParameters &parameters, const Pose &start)
              : vehicle_(vehicle),
                parameters_(parameters),
                curves_(vehicle.minTurningRadius()),
                car_(start)
            {
                result_.start = start;
            }

            /** Adds a stretch that begins where its first piece does, whatever the heading of the car. */
            void add(const Path &stretch)
            {
                if (corners(stretch) > 0)
                {
                    follow(stretch);
                    return;
                }
                if (!apart(car_, stretch.start, EXACT, EXACT_YAW))
                {
                    append(stretch);
                    return;
                }
                if (!apart(car_, stretch.start, BESIDE, BESIDE_YAW))
                    if (const auto joined = joinStretch(stretch, 0.0, car_, vehicle_))
                    {
                        append(*joined);
                        return;
                    }
                shuntTo(stretch.start);
                append(stretch);
            }

            Path finish(const Pose &goal, CornerReport &report)
            {
                if (apart(car_, goal, parameters_.endTolerance, parameters_.endYawTolerance))
                    shuntTo(goal);
                if (!(report_.deviation <= parameters_.maxDeviation))
                    throw Error("path: the car would leave it by " +
                                formatNumber(std::round(100.0 * report_.deviation) / 100.0) +
                                " m at its corners; at most " + formatNumber(parameters_.maxDeviation) +
                                " m are allowed");
                report.shunts = report_.shunts;
                report.deviation = report_.deviation;
                return std::move(result_);
            }

        private:
            static std::size_t corners(const Path &stretch)
            {
                return static_cast<std::size_t>(std::count_if(stretch.pieces.begin(), stretch.pieces.end(), isCorner));
            }

            void append(const Path &path)
            {
                for (const PathPiece &piece : path.pieces)
                {
                    if (piece.turn != 0.0)
                        continue;
                    result_.append(piece);
                    car_ = advance(car_, piece);
                }
            }

            /** Cuts the corners of \e stretch, or turns at the worst and tries both sides of it again. */
            void follow(const Path &stretch)
            {
                const RoundedCorners rounded = roundCorners(stretch, car_, vehicle_, parameters_.steeringSlope);
                if (rounded.following && rounded.deviation <= parameters_.maxCut)
                {
                    report_.deviation = std::max(report_.deviation, rounded.deviation);
                    append(rounded.path);
                    return;
                }
                const std::size_t corner = worstCorner(stretch, rounded.worstPlace);
                Path before{stretch.start, {}}, rest{stretch.start, {}};
                for (std::size_t i = 0; i < stretch.pieces.size(); ++i)
                {
                    if (i <= corner && isCorner(stretch.pieces[corner]))
                        rest.start = advance(rest.start, stretch.pieces[i]);
                    else
                        rest.append(stretch.pieces[i]);
                    if (i < corner)
                        before.append(stretch.pieces[i]);
                }
                if (corners(before) == 0 && !apart(car_, before.start, EXACT, EXACT_YAW))
                    append(before);
                else if (!before.pieces.empty())
                    follow(before);
                shuntTo(rest.start);
                add(rest);
            }

            /** The corner nearest to \e place metres from the begin; 0, which is none, for the begin itself when the
                car is not there. */
            std::size_t worstCorner(const Path &stretch, double place) const
            {
                std::size_t best = 0;
                double least = std::numeric_limits<double>::infinity();
                if (apart(car_, stretch.start, BESIDE, BESIDE_YAW))
                    least = place;
                double along = 0.0;
                for (std::size_t i = 0; i < stretch.pieces.size(); ++i)
                {
                    along += stretch.pieces[i].driven();
                    if (!isCorner(stretch.pieces[i]) || std::abs(along - place) >= least)
                        continue;
                    least = std::abs(along - place);
                    best = i;
                }
                return best;
            }

            /** Drives to \e pose by the shortest Reeds-Shepp curve. */
            void shuntTo(const Pose &pose)
            {
                const ReedsSheppCurve curve = curves_.shortest(car_, pose);
                Path path{car_, {}};
                for (std::size_t i = 0; i < curve.count; ++i)
                    if (std::abs(curve.pieces[i].length) > SHORTEST_PIECE)
                        path.append(curve.pieces[i]);
                for (const PathState &state : path.sample(SHUNT_STEP))
                    report_.deviation = std::max(report_.deviation, std::min(positionDistance(state.pose, car_),
                                                                             positionDistance(state.pose, pose)));
                ++report_.shunts;
                append(path);
            }

            const Vehicle &vehicle_;
            const CornerParameters &parameters_;
            ReedsShepp curves_;
            Pose car_;
            CornerReport report_;
            Path result_;
        };
    }  // namespace

    Path makeDrivable(const Path &path, const Vehicle &vehicle, const CornerParameters &parameters,
                      CornerReport *report)
    {
        check(path, vehicle);
        CornerReport ignored;
        CornerReport &told = report != nullptr ? *report : ignored;
        told = {};
        told.corners = static_cast<std::size_t>(std::count_if(path.pieces.begin(), path.pieces.end(), isCorner));
        if (told.corners == 0)
        {
            Path same{path.start, {}};
            for (const PathPiece &piece : path.pieces)
                if (piece.driven() >= SHORTEST_PIECE)
                    same.append(piece);
            return same;
        }
        const Path merged = withTurnsMerged(path);
        Builder builder(vehicle, parameters, path.start);
        Pose pose = path.start;
        for (const Stretch &stretch : merged.stretches())
        {
            // Turns before the stretch are its heading; behind the last one they are the goal's.
            Path part;
            bool driving = false;
            for (std::size_t i = stretch.first; i < stretch.last; ++i)
            {
                driving = driving || merged.pieces[i].length != 0.0;
                if (!driving)
                    pose = advance(pose, merged.pieces[i]);
                else
                    part.pieces.push_back(merged.pieces[i]);
            }
            part.start = pose;
            for (const PathPiece &piece : part.pieces)
                pose = advance(pose, piece);
            while (part.pieces.back().turn != 0.0)
                part.pieces.pop_back();
            builder.add(part);
        }
        return builder.finish(pose, told);
    }
}  // namespace parking
