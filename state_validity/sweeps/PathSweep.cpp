#include "state_validity/sweeps/PathSweep.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Enlargement of the body on all sides in metres, the default of freeLength(). */
        constexpr double DEFAULT_ENLARGEMENT = 1e-3;

        /** Enlargement in metres that only covers rounding, for paths that must touch no obstacle. */
        constexpr double MIN_ENLARGEMENT = 1e-5;

        /** Largest deviation of a clothoid from the arcs that replace it, as a share of the enlargement. */
        constexpr double DEVIATION = 0.1;

        /** Parameters of the sweeps. */
        struct Sweeping
        {
            const FootprintChecker &checker;
            double enlargement;
            bool bothWays;  ///< also backwards, because a sweep tolerates nearer obstacles at its beginning
        };

        FootprintQueries poseQueriesOf(const FootprintChecker &checker)
        {
            FootprintQueries queries;
            queries.isFree = [&checker](const Pose &pose)
            {
                return checker.isFree(pose);
            };
            queries.clearance = [&checker](const Pose &pose)
            {
                return checker.clearance(pose);
            };
            return queries;
        }

        bool isTurnFree(const FootprintChecker &checker, const Pose &pose, const PathPiece &turn)
        {
            return isPathFree(poseQueriesOf(checker), checker.farthestPoint(), Path{pose, {turn}});
        }

        /** Whether \e arc is free from the start of the sweep. */
        bool isArcFree(const Sweeping &sweeping, const FootprintChecker::SweepStart &start, const PathPiece &arc)
        {
            CheckCounts counts;
            return sweeping.checker.freeLength(start, arc.curvature, arc.length, counts) >= arc.driven();
        }

        bool isArcFree(const Sweeping &sweeping, const Pose &from, const PathPiece &arc)
        {
            CheckCounts counts;
            const auto isFree = [&](const Pose &begin, const PathPiece &drive)
            {
                return isArcFree(sweeping, sweeping.checker.sweepStart(begin, sweeping.enlargement, counts), drive);
            };
            return isFree(from, arc) || (sweeping.bothWays && isFree(advance(from, arc), {arc.curvature, -arc.length}));
        }

        /** Whether \e clothoid is free, by arcs from which the body deviates by less than \e deviation metres. If a
            sweep begins so near to an obstacle that its enlargement does not cover the deviation, the arcs are
            divided. */
        bool isClothoidFree(const Sweeping &sweeping, const Pose &from, const PathPiece &clothoid, double deviation)
        {
            // The factor divides parts by four. Every enlargement is at least a fraction of a nanometre, so the
            // division ends soon.
            constexpr double FINER = 1.0 / 16.0;
            double driven = 0.0;
            const auto isPartFree = [&](const Pose &begin, const PathPiece &arc)
            {
                const PathPiece part{clothoid.curvatureAt(driven), arc.length, clothoid.sharpness};
                driven += arc.driven();
                double covered = 0.0;
                const auto isFree = [&](const Pose &pose, const PathPiece &drive)
                {
                    CheckCounts counts;
                    const auto start = sweeping.checker.sweepStart(pose, sweeping.enlargement, counts);
                    if (deviation <= DEVIATION * start.enlargement)
                        return isArcFree(sweeping, start, drive);
                    covered = std::max(covered, DEVIATION * start.enlargement);
                    return false;
                };
                return isFree(begin, arc) ||
                       (sweeping.bothWays && isFree(advance(begin, arc), {arc.curvature, -arc.length})) ||
                       (covered > 0.0 && isClothoidFree(sweeping, begin, part, std::min(covered, FINER * deviation)));
            };
            // Each part of the length h becomes the arc of its mean curvature. It begins on the clothoid, so errors do
            // not accumulate. With the sharpness s, the heading deviates by at most |s| h^2 / 8 and the position by at
            // most |s| h^3 / 12. No point of the body, within r of the rear axle, deviates by more than |s| h^2 (r / 8
            // + h / 12).
            const double length = clothoid.driven(), reach = sweeping.checker.farthestPoint();
            const double share = std::abs(clothoid.sharpness) * (reach / 8.0 + length / 12.0) / deviation;
            const int count = 1 + static_cast<int>(length * std::sqrt(share));
            for (int i = 0; i < count; ++i)
            {
                const double begin = length * i / count, end = length * (i + 1) / count;
                const PathPiece arc{clothoid.curvatureAt(0.5 * (begin + end)), clothoid.length / count};
                if (!isPartFree(advance(from, clothoid, begin), arc))
                    return false;
            }
            return true;
        }

        bool isPathFree(const Sweeping &sweeping, const Path &path)
        {
            Pose pose = path.start;
            for (const PathPiece &piece : path.pieces)
            {
                const bool isFree = piece.turn != 0.0 ? isTurnFree(sweeping.checker, pose, piece)
                                    : piece.sharpness != 0.0
                                        ? isClothoidFree(sweeping, pose, piece, DEVIATION * sweeping.enlargement)
                                        : isArcFree(sweeping, pose, piece);
                if (!isFree)
                    return false;
                pose = advance(pose, piece);
            }
            // A sweep checks its first pose.
            return sweeping.checker.isFree(path.end());
        }
    }  // namespace

    bool isPathFree(const FootprintChecker &checker, const Path &path)
    {
        return isPathFree({checker, DEFAULT_ENLARGEMENT, false}, path);
    }

    bool touchesNothing(const FootprintChecker &checker, const Path &path)
    {
        return isPathFree(checker, path) || isPathFree({checker, MIN_ENLARGEMENT, true}, path);
    }

    FootprintQueries queriesOf(const FootprintChecker &checker)
    {
        FootprintQueries queries = poseQueriesOf(checker);
        queries.isPathFree = [&checker](const Path &path)
        {
            return isPathFree(checker, path);
        };
        return queries;
    }
}  // namespace parking
