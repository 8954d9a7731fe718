#include "state_validity/sweeps/PathSweep.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** By which the body is enlarged on all sides, metres: what freeLength() takes when nothing is said... */
        constexpr double USUAL_ENLARGEMENT = 1e-3;

        /** ...and what is left for rounding where a path has to touch nothing and no more. */
        constexpr double LEAST_ENLARGEMENT = 1e-5;

        /** From the arcs that are swept in the place of a clothoid; a share of the enlargement. */
        constexpr double DEVIATION = 0.1;

        /** How paths are swept. */
        struct Sweeping
        {
            const FootprintChecker &checker;
            double enlargement;
            bool bothWays;  ///< backwards as well: a sweep is more patient with what is near where it begins
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
            Vehicle body = checker.vehicle();
            body.frontOverhang += checker.margin();
            body.rearOverhang += checker.margin();
            body.width += 2.0 * checker.margin();
            return isPathFree(poseQueriesOf(checker), body, Path{pose, {turn}});
        }

        /** Is it free to drive \e arc from where the sweep begins? */
        bool isArcFree(const Sweeping &sweeping, const FootprintChecker::SweepStart &start, const PathPiece &arc)
        {
            CheckCounts counts;
            return sweeping.checker.freeLength(start, arc.curvature, arc.length, counts) >= arc.driven();
        }

        bool isArcFree(const Sweeping &sweeping, const Pose &from, const PathPiece &arc)
        {
            CheckCounts counts;
            const auto isFree = [&](const Pose &begin, const PathPiece &way)
            {
                return isArcFree(sweeping, sweeping.checker.sweepStart(begin, sweeping.enlargement, counts), way);
            };
            return isFree(from, arc) || (sweeping.bothWays && isFree(advance(from, arc), {arc.curvature, -arc.length}));
        }

        /** By arcs from which the body deviates by less than \e deviation metres. Where a sweep begins so near to an
            obstacle that it enlarges the body by less than covers that, the arcs are divided. */
        bool isClothoidFree(const Sweeping &sweeping, const Pose &from, const PathPiece &clothoid, double deviation)
        {
            // Parts of a quarter of the length. No sweep enlarges the body by less than a part of a nanometre, so that
            // dividing ends soon.
            constexpr double FINER = 1.0 / 16.0;
            double driven = 0.0;
            const auto isPartFree = [&](const Pose &begin, const PathPiece &arc)
            {
                const PathPiece part{clothoid.curvatureAt(driven), arc.length, clothoid.sharpness};
                driven += arc.driven();
                double covered = 0.0;
                const auto isFree = [&](const Pose &pose, const PathPiece &way)
                {
                    CheckCounts counts;
                    const auto start = sweeping.checker.sweepStart(pose, sweeping.enlargement, counts);
                    if (deviation <= DEVIATION * start.enlargement)
                        return isArcFree(sweeping, start, way);
                    covered = std::max(covered, DEVIATION * start.enlargement);
                    return false;
                };
                return isFree(begin, arc) ||
                       (sweeping.bothWays && isFree(advance(begin, arc), {arc.curvature, -arc.length})) ||
                       (covered > 0.0 && isClothoidFree(sweeping, begin, part, std::min(covered, FINER * deviation)));
            };
            // Each part of the length h becomes the arc of its mean curvature, begun where the part begins on the
            // clothoid, so that nothing adds up. On the way the heading differs by at most |s| h^2 / 8, s being the
            // sharpness, and the position by at most |s| h^3 / 12: no point of the body, within r of the rear axle,
            // deviates by more than |s| h^2 (r / 8 + h / 12).
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
            // The sweep looks at the pose where it begins.
            return sweeping.checker.isFree(path.end());
        }
    }  // namespace

    bool isPathFree(const FootprintChecker &checker, const Path &path)
    {
        return isPathFree({checker, USUAL_ENLARGEMENT, false}, path);
    }

    bool touchesNothing(const FootprintChecker &checker, const Path &path)
    {
        return isPathFree(checker, path) || isPathFree({checker, LEAST_ENLARGEMENT, true}, path);
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
