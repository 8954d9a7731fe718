#include "parking_geometry/FootprintQueries.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Length in metres of motions of the body below which the ends decide. */
        constexpr double MIN_MOTION = 5e-3;

        /** Distance in metres between checked poses if there is no clearance. */
        constexpr double SPACING = 0.1;

        /** Distance in metres from the midpoint of the rear axle to the farthest corner of the body. A turn moves no
            point of the body farther than this times the angle. */
        double farthestCorner(const Vehicle &vehicle)
        {
            return std::hypot(std::max(vehicle.wheelbase + vehicle.frontOverhang, vehicle.rearOverhang),
                              0.5 * vehicle.width);
        }

        /** Covers one piece of a path by poses. */
        class PieceCheck
        {
        public:
            /** \param reach of the body from its rear axle, metres */
            PieceCheck(const FootprintQueries &queries, const Pose &start, const PathPiece &piece, double reach)
              : queries_(queries),
                start_(start),
                piece_(piece),
                minMotion_(queries.clearance ? MIN_MOTION : SPACING)
            {
                const double steepest = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
                const double turning = queries.clearance ? steepest * reach : 0.0;
                motion_ = piece.driven() * (1.0 + turning) + std::abs(piece.turn) * reach;
            }

            /** Whether the piece is free between two shares of it with known clearances. */
            bool isFree(double from, double clearanceFrom, double to, double clearanceTo) const
            {
                // No point of the body moves farther than this.
                const double moved = (to - from) * motion_;
                if (clearanceFrom + clearanceTo > moved || moved <= minMotion_)
                    return true;
                const double middle = 0.5 * (from + to);
                const double clearance = clearanceAt(queries_, poseAt(middle));
                return clearance >= 0.0 && isFree(from, clearanceFrom, middle, clearance) &&
                       isFree(middle, clearance, to, clearanceTo);
            }

            /** A lower bound of the distance to the obstacles, negative when the pose collides. */
            static double clearanceAt(const FootprintQueries &queries, const Pose &pose)
            {
                if (queries.clearance)
                    if (const double clearance = queries.clearance(pose); clearance > 0.0)
                        return clearance;
                return queries.isFree && queries.isFree(pose) ? 0.0 : -1.0;
            }

        private:
            Pose poseAt(double share) const
            {
                PathPiece part = piece_;
                part.turn *= share;
                return advance(start_, part, share * piece_.driven());
            }

            const FootprintQueries &queries_;
            Pose start_;
            PathPiece piece_;
            double minMotion_, motion_;
        };
    }  // namespace

    bool isPathFree(const FootprintQueries &queries, const Vehicle &vehicle, const Path &path)
    {
        return isPathFree(queries, farthestCorner(vehicle), path);
    }

    bool isPathFree(const FootprintQueries &queries, double reach, const Path &path)
    {
        if (queries.isPathFree)
            return queries.isPathFree(path);
        if (!queries.clearance && !queries.isFree)
            return true;
        Pose pose = path.start;
        double clearance = PieceCheck::clearanceAt(queries, pose);
        for (const PathPiece &piece : path.pieces)
        {
            if (clearance < 0.0)
                return false;
            const Pose next = advance(pose, piece);
            const double there = PieceCheck::clearanceAt(queries, next);
            if (there < 0.0 || !PieceCheck(queries, pose, piece, reach).isFree(0.0, clearance, 1.0, there))
                return false;
            pose = next;
            clearance = there;
        }
        return clearance >= 0.0;
    }
}  // namespace parking
