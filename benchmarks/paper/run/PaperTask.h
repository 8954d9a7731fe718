#pragma once

#include "benchmarks/paper/run/DiscWorld.h"
#include "benchmarks/paper/run/JointSpline.h"
#include "benchmarks/paper/run/PaperDrive.h"
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/manoeuvres/ReverseParking.h"
#include "state_validity/FootprintChecker.h"

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief Round which point of the car the disc is drawn. */
    enum class DiscPlace
    {
        /** The body's middle, which is also the position that is planned and driven, by the equations of the rear axle:
            as printed. */
        Middle,
        /** The body's middle, ahead of the rear axle whose poses are planned and driven: as corrected. */
        Ahead,
        RearAxle  ///< the rear axle, whose poses are planned and driven
    };

    /** \brief Of middle, ahead or rear_axle. Throws parking::Error listing these for another name. */
    DiscPlace discPlaceByName(const std::string &name);

    /** \brief Of scan or field. Throws parking::Error listing these for another name. */
    DiscLookup discLookupByName(const std::string &name);

    /** \brief How the paper is taken where it can be taken in several ways; by default at its word. */
    struct PaperVariant
    {
        DiscPlace place{DiscPlace::Middle};      ///< of the disc
        double radius{1.25};                     ///< metres: half of the car's width, and 35 cm to open the doors
        DiscLookup lookup{DiscLookup::Scan};     ///< of obstacles within the disc
        SplineKind spline{SplineKind::Bspline};  ///< of the algorithms that smooth
        bool acrossCusps{true};                  ///< one spline through all; false: one for each stretch of the way
        std::size_t sampling{3};                 ///< every so many points one is a control point
        PaperDriveOptions drive;                 ///< of the controller
    };

    /** \brief What one algorithm of the paper came to in one scenario. */
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
        std::vector<Eigen::Vector2d> corners;  ///< of A*'s way and of the manoeuvre, joined
        std::vector<Eigen::Vector2d> curve;    ///< what is driven
        double approachLength{0.0};            ///< metres, of A*'s way as it was found
        /** Radians between the heading with which A*'s way arrives and that with which the manoeuvre begins; infinite
            without a way. */
        double arrivalTurn{std::numeric_limits<double>::infinity()};
        Pose parkingStart;       ///< where the manoeuvre begins
        Pose goal;               ///< in the slot
        PaperDriveResult drive;  ///< without states when nothing was driven
        bool driven{false};      ///< was it?
    };

    /** \brief The paper's run from the start to standstill in the slot (sections "Reverse Parking Planning Method",
        "Summary of Optimizations for Improved A* Algorithm", "Experimental Process"): the manoeuvre out of the slot
        turned round, A* to where it begins, one spline through both, and the drive.

        A* plans to a position: with which heading it gets there is left to chance. Of several manoeuvres (from either
        side) the one is taken with the shortest way among those whose heading is at most a right angle off, and without
        such a one that which is least off. */
    class PaperTask
    {
    public:
        /** \brief Reads obstacles and slot. Throws parking::Error for a scenario without a slot, and what the parts
            throw. */
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

        /** \brief The manoeuvres that fit into the slot; empty when none does. */
        const std::vector<ReverseParkingResult> &manoeuvres() const
        {
            return manoeuvres_;
        }

        /** \brief Why no manoeuvre fits; empty when one does. */
        const std::string &whyNone() const
        {
            return whyNone_;
        }

        /** \brief Is the body, the rectangle, free at this pose? */
        bool isBodyFree(const Pose &pose) const
        {
            return body_.isFree(pose);
        }

    private:
        PaperRun runTo(const ReverseParkingResult &manoeuvre, const PlannerParameters &parameters,
                       double timeLimit) const;
        void join(const Path &approach, const Path &manoeuvre, bool smooth, PaperRun &run) const;

        Scenario scenario_;
        PaperVariant variant_;
        Vehicle vehicle_;
        Pose start_;
        FootprintChecker body_;
        std::vector<ReverseParkingResult> manoeuvres_;
        std::string whyNone_;
    };
}  // namespace parking
