#include "state_validity/sweeps/PathSweep.h"

#include "parking_geometry/curves/PathArcs.h"

#include <functional>

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

        bool isArcFree(const FootprintChecker &checker, const Pose &from, const PathPiece &arc, double enlargement)
        {
            CheckCounts counts;
            return checker.freeLength(from, arc.curvature, arc.length, enlargement, counts) >= arc.driven();
        }

        /** Visits path in arcs that deviate from it by less than the enlargement. */
        bool isPathFree(const FootprintChecker &checker, const Path &path, double enlargement,
                        const std::function<bool(const Pose &, const PathPiece &)> &isFree)
        {
            const auto isPieceFree = [&](const Pose &from, const PathPiece &piece)
            {
                return piece.turn != 0.0 ? isTurnFree(checker, from, piece) : isFree(from, piece);
            };
            // The sweep looks at the pose where it begins.
            return visitArcs(path, checker.farthestPoint(), DEVIATION * enlargement, isPieceFree) &&
                   checker.isFree(path.end());
        }
    }  // namespace

    bool isPathFree(const FootprintChecker &checker, const Path &path)
    {
        return isPathFree(checker, path, USUAL_ENLARGEMENT,
                          [&checker](const Pose &from, const PathPiece &arc)
                          { return isArcFree(checker, from, arc, USUAL_ENLARGEMENT); });
    }

    bool touchesNothing(const FootprintChecker &checker, const Path &path)
    {
        // Backwards as well: a sweep is more patient with what is near where it begins.
        return isPathFree(checker, path) ||
               isPathFree(checker, path, LEAST_ENLARGEMENT,
                          [&checker](const Pose &from, const PathPiece &arc)
                          {
                              return isArcFree(checker, from, arc, LEAST_ENLARGEMENT) ||
                                     isArcFree(checker, advance(from, arc), {arc.curvature, -arc.length},
                                               LEAST_ENLARGEMENT);
                          });
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
