#pragma once

#include "automatic_parking/ParkingWorld.h"
#include "automatic_parking/PlanningParameters.h"
#include "ompl_improved_astar/search/SearchContext.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/manoeuvres/ReverseParking.h"
#include "state_validity/FootprintChecker.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

/** \brief Parts of ParkingPlanner that its users do not see. */
namespace parking::planning
{
    constexpr double SAME_POSE = 1e-6;  ///< metres and radians, as for joined()

    /** \brief A step of the ladder: how far to stay away from everything, and how tightly to turn. Metres. */
    struct Rung
    {
        double gap;           ///< what is asked for
        double radius;        ///< of the tightest turn
        double searchMargin;  ///< by which the body is enlarged for searches
        double checkMargin;   ///< and for constructed manoeuvres and smoothing
    };

    /** \brief A step for WayIn::InStretches: its searches keep up to a tolerance less than asked, and smoothing may use
        half of the gap. */
    Rung rungInStretches(double gap, double radius, const PlanningTuning &tuning);

    /** \brief What a rung has led to: a way from start to goal, or, where only the way in was asked for, that. */
    struct Candidate
    {
        ReverseParkingResult manoeuvre;  ///< the way into the slot; no pieces where there is none
        Path approach,                   ///< from the start to where the manoeuvre begins, or all the way
            arcs;                        ///< both, from start to goal
        Pose goal;                       ///< the pose that the way ends at
        /** Metres, 0 for a way in alone; infinite when nothing was found. */
        double cost{std::numeric_limits<double>::infinity()};
        std::size_t stretches{0};                         ///< at the slot
        Rung rung{};                                      ///< what it was found with
        std::shared_ptr<const FootprintChecker> checker;  ///< within whose margin it may be smoothed

        /** \brief Has a way been found? */
        bool found() const
        {
            return cost < std::numeric_limits<double>::infinity();
        }
    };

    /** \brief Time since it was made, in seconds. */
    class Stopwatch
    {
    public:
        /** \brief Seconds since it was made. */
        double seconds() const
        {
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        }

    private:
        std::chrono::steady_clock::time_point begin_{std::chrono::steady_clock::now()};
    };

    /** \brief The tries of one plan: what each rung of the ladder leads to, and what all of them together cost. */
    class Tries
    {
    public:
        /** \param startRoom metres that the start leaves all round the body
            \param onlyWayIn the part at the slot is enough, wherever the car comes from */
        Tries(const Scenario &scenario, const PlanningParameters &parameters, const ParkingWorld &world,
              double startRoom, bool onlyWayIn);

        /** \brief What \e rung allows.

            \param last there is no other: the search all the way is granted all of the time */
        Candidate find(Rung rung, bool last);

        /** \brief Is the time up, or has somebody interrupted? */
        bool isOver() const
        {
            return isInterrupted() || watch_.seconds() > parameters_.timeLimit;
        }

        /** \brief Is it time for the last resort? */
        bool isLate() const
        {
            return isInterrupted() || watch_.seconds() > parameters_.tuning.shareForTries * parameters_.timeLimit;
        }

        /** \brief Seconds since the tries began. */
        double seconds() const
        {
            return watch_.seconds();
        }

        /** \brief Why there is no way in, of the first try that found none. */
        const std::optional<ReverseParkingResult> &verdict() const
        {
            return verdict_;
        }

        /** \brief Seconds, of distance fields and the like. */
        double loadingTime() const
        {
            return loadingTime_;
        }

        /** \brief Searches begun. */
        std::size_t count() const
        {
            return count_;
        }

        /** \brief What all searches together took. */
        const search::SearchStatistics &statistics() const
        {
            return statistics_;
        }

    private:
        /** The body, enlarged for searches and for everything else. */
        struct Checkers
        {
            std::shared_ptr<const FootprintChecker> search, check;
        };

        struct SearchTask
        {
            Pose from;
            std::vector<Pose> to;
            Box bounds;  ///< of the rear axle
            double radius;
            double gearChange;
            bool bothSides;            ///< search from both ends; otherwise out of \e from
            std::uint64_t expansions;  ///< 0: as many as there is time for
        };

        bool isInterrupted() const
        {
            return parameters_.interrupted && parameters_.interrupted();
        }

        Checkers checkers(const Rung &rung);

        ReverseParkingOptions sweepOptions(const Rung &rung) const;

        /** The ways into the slot that \e rung allows, from P in the aisle to the parked pose: all that are one sweep,
            otherwise the best in several stretches. */
        std::vector<ReverseParkingResult> waysIn(const Rung &rung, const Checkers &body);

        SearchTask fromStart(const Rung &rung) const;

        /** To where one of \e ways begins, and on along it. */
        Candidate throughManoeuvre(const std::vector<ReverseParkingResult> &ways, SearchTask task,
                                   const FootprintChecker &checker);

        /** The search's own way to one of the goals. */
        Candidate allTheWay(SearchTask task, const FootprintChecker &checker, bool last);

        /** Without pieces when nothing was found. */
        Path search(const FootprintChecker &checker, const SearchTask &task);

        /** Cost as of the car itself, so that paths planned with different gaps can be compared. */
        double cost(const Path &path) const;

        const Scenario &scenario_;
        const PlanningParameters &parameters_;
        const ParkingWorld &world_;
        const double startRoom_;
        const bool onlyWayIn_, inStretches_;
        Stopwatch watch_;
        double loadingTime_{0.0};
        std::size_t count_{0};
        search::SearchStatistics statistics_;
        std::optional<ReverseParkingResult> verdict_;
    };
}  // namespace parking::planning
