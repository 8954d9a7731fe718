#include "parking_geometry/FootprintQueries.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Motions of the body shorter than this are decided by their ends, metres. */
        constexpr double FINEST_MOTION = 5e-3;

        /** Between the poses that are asked about where no clearance is known, metres driven. */
        constexpr double SPACING = 0.1;

        /** Metres from the midpoint of the rear axle to the farthest corner of the body: a turn moves no point of it
           farther than this times the angle. */
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
                finest_(queries.clearance ? FINEST_MOTION : SPACING)
            {
                const double steepest = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
                const double turning = queries.clearance ? steepest * reach : 0.0;
                motion_ = piece.driven() * (1.0 + turning) + std::abs(piece.turn) * reach;
            }

            /** Free between these shares of the piece, at whose ends so much clearance is known? */
            bool isFree(double from, double clearanceFrom, double to, double clearanceTo) const
            {
                // No point of the body moves farther than this.
                const double moved = (to - from) * motion_;
                if (clearanceFrom + clearanceTo > moved || moved <= finest_)
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
            double finest_, motion_;
        };
    }  // namespace

    bool isPathFree(const FootprintQueries &queries, const Vehicle &vehicle, const Path &path)
    {
        if (queries.isPathFree)
            return queries.isPathFree(path);
        if (!queries.clearance && !queries.isFree)
            return true;
        const double reach = farthestCorner(vehicle);
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
