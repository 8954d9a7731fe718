#include "automatic_parking/ParkingWorld.h"

#include "parking_geometry/Error.h"
#include "state_validity/ObstacleSet.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        // Accuracy of minClearance().
        constexpr double CLEARANCE_STEP = 1e-3;   // metres
        constexpr double CLEARANCE_SHARE = 0.01;  // or this share of the clearance
    }                                             // namespace

    ParkingWorld::ParkingWorld(const Scenario &scenario, ContactTestMaker contact, double fieldReach)
      : contact_(std::move(contact)),
        obstacles_(std::make_shared<IndexedObstacles>(ObstacleSet::fromScenario(scenario), 0.0, fieldReach)),
        footprint_(std::make_shared<const FootprintChecker>(obstacles_, scenario.vehicle, 0.0, contact_))
    {
    }

    void ParkingWorld::update(const GridUpdate &update)
    {
        obstacles_->update(update);
    }

    ParkingWorld ParkingWorld::snapshot() const
    {
        ParkingWorld copy(*this);
        copy.obstacles_ = obstacles_->copy();
        copy.footprint_ =
            std::make_shared<const FootprintChecker>(copy.obstacles_, footprint_->vehicle(), 0.0, contact_);
        return copy;
    }

    std::shared_ptr<const FootprintChecker> ParkingWorld::enlarged(double gap) const
    {
        if (gap == 0.0)
            return footprint_;
        try
        {
            return std::make_shared<const FootprintChecker>(obstacles_, footprint_->vehicle(), gap, contact_);
        }
        catch (const Error &)
        {
            return nullptr;
        }
    }

    double minClearance(const FootprintChecker &checker, const Path &path)
    {
        double least = checker.exactClearance(path.start);
        Pose from = path.start;
        // From a pose with clearance c the body cannot reach the minimum before its fastest point has moved by the
        // difference.
        for (const PathPiece &piece : path.pieces)
        {
            const double bend = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
            const double moved =
                piece.driven() * checker.speedFactor(bend) + std::abs(piece.turn) * checker.farthestPoint();
            for (double share = 0.0; share <= 1.0 && least > 0.0;)
            {
                const Pose pose = piece.turn != 0.0 ? Pose{from.x, from.y, from.yaw + share * piece.turn}
                                                    : advance(from, piece, share * piece.driven());
                double here = checker.clearance(pose);
                if (here < least)
                    here = checker.exactClearance(pose);
                least = std::min(least, here);
                if (moved <= 0.0 || share >= 1.0)
                    break;
                const double stride = here - least + std::max(CLEARANCE_STEP, CLEARANCE_SHARE * least);
                share = std::min(1.0, share + stride / moved);
            }
            from = advance(from, piece);
        }
        return least;
    }
}  // namespace parking
