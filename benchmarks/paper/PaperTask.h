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

    /** \brief Choices that the paper leaves open, or where it errs; by default as printed. */
    struct PaperVariant
    {
        DiscPlace place{DiscPlace::Middle};  ///< of the disc
        double radius{1.25};                 ///< metres: half of the car's width, and 35 cm to open the doors
        bool scan{true};                     ///< every cell in the disc is looked at; false: a distance field
        std::size_t degree{BSPLINE};         ///< of the curve of algorithms that smooth
        bool acrossCusps{true};              ///< one curve through the whole; false: one for each stretch
        std::size_t sampling{3};             ///< one point of this many is a control point
        PaperDriveOptions drive;             ///< of the controller
    };

    /** \brief The result of one algorithm of the paper in one scenario. */
    struct PaperRun
    {
        /** exact, approximate, infeasible, timeout, invalid_start or invalid_goal, as of parking_plan; or no_manoeuvre.
         */
        std::string status;
        std::string reason;                    ///< why not exact; otherwise empty
        double loadingTime{0.0};               ///< seconds of processor time before the search began
        double planningTime{0.0};              ///< seconds of processor time of search and spline
        search::SearchStatistics statistics;   ///< of the search
        DiscWorld::Counts counts;              ///< of the world of discs
        std::vector<Eigen::Vector2d> corners;  ///< of A*'s path and of the manoeuvre, joined; empty without a path
        std::vector<Eigen::Vector2d> curve;    ///< the path to be driven; empty without a path
        double approachLength{0.0};            ///< metres, of A*'s path as it was found
        double approachError{0.0};             ///< metres between its end and the pose where the manoeuvre begins
        /** Radians between the heading with which A*'s path arrives and that with which the manoeuvre begins; infinite
            without a path. */
        double arrivalTurn{std::numeric_limits<double>::infinity()};
        Pose parkingStart;                ///< where the manoeuvre begins
        Pose goal;                        ///< where the car must stop
        double approachCollidingShare{};  ///< of A*'s path: where the body, heading along it, stands in an obstacle
        PaperDriveResult drive;           ///< without states when nothing was driven
    };

    /** \brief The paper's run from the start to standstill (sections "Reverse Parking Planning Method", "Summary of
        Optimizations for Improved A* Algorithm", "Experimental Process"): the manoeuvre out of the slot in reverse, A*
        to where it begins, one spline through both, and the drive. A scenario without a slot has no manoeuvre: there A*
        plans to the goal.

        A* plans to a position and arrives with any heading. Of several manoeuvres (from either side) the one with the
        shortest path of A* is taken among those whose heading is at most a right angle off, otherwise the one that is
        least off. */
    class PaperTask
    {
    public:
        /** \brief Reads obstacles and slot. Throws parking::Error as the parts do. */
        PaperTask(const Scenario &scenario, const PaperVariant &variant);

        /** \brief Plans, and drives when \e drive says so. Equal arguments give equal results but for times.

            \param parameters of a grid model; others throw parking::Error
            \param timeLimit seconds of the search */
        PaperRun run(const PlannerParameters &parameters, double timeLimit, bool drive) const;

        /** \brief The car as it is planned for: its poses are of the point that the variant says. */
        const Vehicle &vehicle() const
        {
            return vehicle_;
        }

        /** \brief The paths from where A* plans to, each into the slot; empty when no manoeuvre fits. */
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
