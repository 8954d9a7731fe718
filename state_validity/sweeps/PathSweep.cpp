#include "state_validity/sweeps/PathSweep.h"

#include "parking_geometry/curves/PathArcs.h"

namespace parking
{
    namespace
    {
        /** From the arcs that are swept in the place of a clothoid, metres. */
        constexpr double DEVIATION = 1e-4;

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
    }  // namespace

    bool isPathFree(const FootprintChecker &checker, const Path &path)
    {
        const auto isFree = [&checker](const Pose &from, const PathPiece &piece)
        {
            if (piece.turn != 0.0)
                return isTurnFree(checker, from, piece);
            return checker.freeLength(from, piece.curvature, piece.length) >= piece.driven();
        };
        // The sweep looks at the pose where it begins.
        return visitArcs(path, checker.farthestPoint(), DEVIATION, isFree) && checker.isFree(path.end());
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
