#pragma once

#include "automatic_parking/ParkingStatus.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/smoothing/PathSmoother.h"
#include "state_validity/FootprintChecker.h"
#include "state_validity/ObstacleSet.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief How a parking path is planned. */
    struct PlanningParameters
    {
        double timeLimit{10.0};  ///< seconds for all tries together; half of them for all but the last

        /** Gaps in metres kept all round the body, largest first; one that start or goal do not leave is not tried. */
        std::vector<double> gaps{0.25, 0.12, 0.06, 0.03, 0.015, 0.0};
        /** What a gap is worth: of two paths the one with the smaller cost + gapWorth * 0.25 m / (gap + 0.02 m) is
            taken, in metres. At 3, keeping 25 cm may cost 7 m of way more than 6 cm, and 6 cm 28 m more than
            grazing. */
        double gapWorth{3.0};
        /** Expansions after which a gap is given up; the last one is granted all of the time. */
        std::uint64_t expansionsPerGap{4000};

        /** Planned turning radius over the car's smallest: what is above 1 is room for smoothing and correcting. Where
            there is no path with it, there may be one with 1. */
        double radiusFactor{1.05};

        double gearChangePenalty{2.0};      ///< metres that a change of direction may save
        double steeringChangePenalty{0.1};  ///< metres that turning the wheels to full lock may save
        double clearanceWeight{1.0};        ///< extra cost per metre in touch with an obstacle, none at 1 m

        /** Enter slots by a constructed manoeuvre (paper, "Reverse Parking Planning Method") where one fits, so that
            the planner only has to bring the car to where it begins. */
        bool manoeuvres{true};
        bool smooth{true};  ///< make the curvature continuous
        SmoothingOptions smoothing;

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };

    /** \brief What planning came to, stage by stage. */
    struct ParkingPlan
    {
        bool found{false};
        ParkingStatus failure{ParkingStatus::NoPath};  ///< why not, when nothing was found
        std::string message;                           ///< one line: what was planned, or why nothing was

        Pose goal;                ///< the one that was chosen
        Path approach;            ///< the planner's part
        Path manoeuvre;           ///< the constructed part, without segments where the planner did it all
        Path arcs;                ///< both
        SmoothPath smooth;        ///< what the smoother made of it; empty when it was not asked or refused
        Path path;                ///< to be driven: the smooth one, or \e arcs
        double gap{0.0};          ///< metres kept all round the body while planning
        double turningRadius{0};  ///< metres, planned with
        double clearance{0.0};    ///< metres, least between body and obstacles along \e path, to 1 mm or 1 %

        double loadingTime{0.0};          ///< seconds, obstacles and distance fields
        double planningTime{0.0};         ///< seconds, all tries
        double smoothingTime{0.0};        ///< seconds
        double cost{0.0};                 ///< metres: length and what the parameters add to it
        std::size_t tries{0};             ///< searches begun
        search::SearchStatistics search;  ///< of all tries
    };

    /** \brief Obstacles that can be asked. Cheap to copy. */
    class ParkingWorld
    {
    public:
        /** \brief Reads the obstacles of \e scenario, for its car. Throws what FootprintChecker throws. */
        explicit ParkingWorld(const Scenario &scenario);

        /** \brief The checker of the car's own rectangle. */
        const FootprintChecker &footprint() const
        {
            return *footprint_;
        }

        /** \brief A checker of the rectangle enlarged by \e gap metres on every side; null where it is larger than the
            world. */
        std::shared_ptr<const FootprintChecker> enlarged(double gap) const;

        /** \brief Is the whole of \e path free? Swept, not sampled. */
        bool isFree(const Path &path) const;

        /** \brief Least distance in metres between the body and the obstacles along \e path, to a millimetre or one
            percent; 0 when they touch. */
        double clearance(const Path &path) const;

    private:
        std::shared_ptr<const FootprintChecker> footprint_;
    };

    /** \brief Plans how a car gets from where it stands to where it shall stand (paper, "Overall Workflow"): the way
        into the slot is constructed, the planner brings the car to where it begins, both are smoothed as one.

        Where no manoeuvre fits, and for goals without a slot, the planner goes all the way. Equal inputs give equal
        paths as long as the time suffices. */
    class ParkingPlanner
    {
    public:
        /** \brief Throws parking::Error for parameters out of their range. */
        explicit ParkingPlanner(const PlanningParameters &parameters = {});

        const PlanningParameters &parameters() const
        {
            return parameters_;
        }

        /** \brief Plans from scenario.start; never throws for a problem that has no solution.

            Throws parking::Error for a scenario that makes no sense: no goal, a car that is not valid. */
        ParkingPlan plan(const Scenario &scenario) const;

        /** \brief The same in a world that is there already. */
        ParkingPlan plan(const Scenario &scenario, const ParkingWorld &world) const;

    private:
        PlanningParameters parameters_;
    };
}  // namespace parking
