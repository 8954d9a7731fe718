#pragma once

#include "benchmarks/paper/DiscWorld.h"
#include "benchmarks/paper/JointSpline.h"
#include "benchmarks/paper/PaperDrive.h"
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/FootprintChecker.h"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief The point of the car round which the disc is drawn. */
    enum class DiscPlace
    {
        /** The body's middle, which is also the position that is planned and driven, by the equations of the rear axle:
            as printed. */
        Middle,
        /** The body's middle, ahead of the rear axle whose poses are planned and driven: as corrected. */
        Ahead,
        RearAxle  ///< the rear axle, whose poses are planned and driven
    };

    /** \brief Choices that the paper leaves open, or in which it errs; by default as printed. */
    struct PaperVariant
    {
        DiscPlace place{DiscPlace::Middle};  ///< position of the disc
        double radius{1.25};                 ///< radius in metres: half of the car's width, and 35 cm to open the doors
        bool scan{true};              ///< whether every cell in the disc is scanned; otherwise a distance field is used
        std::size_t degree{BSPLINE};  ///< degree of the curve of algorithms that smooth
        bool acrossCusps{true};       ///< whether one curve covers the whole path instead of each stretch
        std::size_t sampling{3};      ///< number of points per control point
        PaperDriveOptions drive;      ///< settings of the controller
    };

    /** \brief The result of one algorithm of the paper in one scenario. */
    struct PaperRun
    {
        /** Status of parking_plan (exact, approximate, infeasible, timeout, invalid_start or invalid_goal), or
         no_manoeuvre. */
        std::string status;
        std::string reason;                    ///< reason for any status but exact; otherwise empty
        double loadingTime{0.0};               ///< seconds of processor time before the search began
        double planningTime{0.0};              ///< seconds of processor time of search and spline
        search::SearchStatistics statistics;   ///< effort of the search
        DiscWorld::Counts counts;              ///< lookups in the world of discs
        std::vector<Eigen::Vector2d> corners;  ///< joined path of A* and manoeuvre; empty without a path
        std::vector<Eigen::Vector2d> curve;    ///< the path to be driven; empty without a path
        double approachLength{0.0};            ///< length in metres of A*'s path before smoothing
        double approachError{0.0};  ///< metres between the end of A*'s path and the pose where the manoeuvre begins
        /** Radians between the final heading of A*'s path and the first one of the manoeuvre; infinite without a
            path. */
        double arrivalTurn{std::numeric_limits<double>::infinity()};
        Pose parkingStart;                ///< first pose of the manoeuvre
        Pose goal;                        ///< pose where the car must stop
        double approachCollidingShare{};  ///< share of A*'s path along which the body, aligned with it, is in collision
        PaperDriveResult drive;           ///< the drive; no states if there was none
    };

    /** \brief The paper's run from the start to standstill (sections "Reverse Parking Planning Method", "Summary of
        Optimizations for Improved A* Algorithm", "Experimental Process").

        The run consists of the manoeuvre out of the slot in reverse, A* to its beginning, one spline along both, and
        the drive. Without a slot there is no manoeuvre, and A* plans to the goal.

        A* plans to a position and arrives with any heading. There may be manoeuvres from either side. Those
        whose heading differs from A*'s by at most a right angle come first, in order of the length of A*'s path. Others
        follow in order of the difference. */
    class PaperTask
    {
    public:
        /** \brief Reads obstacles and slot. Throws parking::Error for an invalid scenario or variant. */
        PaperTask(const Scenario &scenario, const PaperVariant &variant);

        /** \brief Plans, and drives if \e drive is set. Equal arguments give equal results except for times.

            \param parameters of a grid model; others throw parking::Error
            \param timeLimit limit of the search in seconds */
        PaperRun run(const PlannerParameters &parameters, double timeLimit, bool drive) const;

        /** \brief The planned car: its poses refer to the point selected by the variant. */
        const Vehicle &vehicle() const
        {
            return vehicle_;
        }

        /** \brief The manoeuvres into the slot, each from an end of A*'s path; empty when no manoeuvre fits. */
        const std::vector<Path> &manoeuvres() const
        {
            return manoeuvres_;
        }

    private:
        PaperRun runTo(const Path &manoeuvre, const PlannerParameters &parameters, double timeLimit) const;
        void addManoeuvres(ParkingSlot slot);
        void join(const Path &approach, const Path &manoeuvre, bool smooth, PaperRun &run) const;
        double collidingShare(const PaperRun &run) const;

        PaperVariant variant_;
        Box bounds_;
        Vehicle vehicle_;
        Pose start_;
        FootprintChecker body_;
        std::vector<Path> manoeuvres_;
        std::string whyNone_;
    };
}  // namespace parking
