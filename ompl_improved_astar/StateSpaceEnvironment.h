#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "parking_geometry/Box.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/ompl/CurveSpace.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace parking
{
    /** \brief How far apart the states of a path may be for the space's own interpolation to follow the path.

        Of straight lines and turns on the spot the ends suffice everywhere. Spaces of curves go from state to state
        along arcs at their turning radius, too; an arc that turns less, or a clothoid, they would replace by a sharper
        arc and a line. */
    struct StateSpacing
    {
        double onArcs{0.0};                 ///< metres; 0 where the ends of short arcs suffice
        double onGentleArcs{0.0};           ///< metres; 0 as above
        double sharpestCurvature{0.0};      ///< 1/m; arcs that turn less are gentle
        const CurveSpace *curves{nullptr};  ///< of the space, for straightened(); null: nothing is straightened
    };

    /** \brief The poses of \e path between which the space's own interpolation follows the path. */
    std::vector<Pose> pathStates(const Path &path, const StateSpacing &spacing);

    /** \brief The poses, and others in between where a Reeds-Shepp space would swerve instead of driving straight on.

        Of straight lines much shorter than the turning radius OMPL misses the shortest curve now and then, because of
        the last digits of their ends, and takes one of four arcs instead (measured with OMPL 1.5: 4 to 7 % of those up
        to 4 % of the radius, none from 8 % on, with coordinates below 50 m). Other digits will do. */
    std::vector<Pose> straightened(std::vector<Pose> poses, const CurveSpace &curves);

    /** \brief The world of the search as OMPL sees it, for any validity checker and motion validator.

        Motions are tried by asking for the validity of states along them; paths found are then put to the motion
        validator, motion by motion, in the direction in which they will be driven. */
    class StateSpaceEnvironment final : public search::MotionEnvironment
    {
    public:
        /** \brief \param step metres between states asked for along a motion
            \param stateSpacing between the states of a path */
        StateSpaceEnvironment(const ompl::base::SpaceInformationPtr &si, double step, const StateSpacing &stateSpacing,
                              bool headingMatters);

        /** \brief While \e stop says true every motion is cut short, and no clearance known, so that a slow checker
            does not delay the end. */
        void setStop(const search::StopFunction &stop)
        {
            stop_ = stop;
            interrupted_ = false;
        }

        /** \brief How the poses of a path are changed before it is handed out, to end at the very goal: what
           acceptPath() is asked for are the motions between these. */
        void setEnding(std::function<void(std::vector<Pose> &)> ending)
        {
            ending_ = std::move(ending);
        }

        bool isFree(const Pose &pose) override;
        /** Nothing is proven to keep a clearance. */
        void freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                         double *lengths) override;
        bool keeps(const Pose &pose, double clearance) override;
        bool knowsClearance() const override
        {
            return clearanceKnown_;
        }
        Box bounds() const override
        {
            return bounds_;
        }
        /** Infinite: nothing is known of the obstacles. */
        double roomAt(double x, double y) override;
        bool acceptPath(const Path &path) override;
        bool wasInterrupted() const override
        {
            return interrupted_;
        }

        bool isMotionFree(const Pose &from, const Pose &to) override;
        bool headingMatters() const override
        {
            return headingMatters_;
        }

        /** \brief States whose validity was asked for since construction, but by the motion validator. */
        std::uint64_t checkedStates() const
        {
            return checkedStates_;
        }

    private:
        bool isTimeUp();
        bool isTimeUpNowAndThen();

        ompl::base::SpaceInformationPtr si_;
        double step_;
        StateSpacing stateSpacing_;
        bool headingMatters_;
        bool clearanceKnown_;
        Box bounds_;
        search::StopFunction stop_;
        std::function<void(std::vector<Pose> &)> ending_;
        bool interrupted_{false};
        std::uint64_t checkedStates_{0}, questions_{0};
        ompl::base::ScopedState<> state_, other_;
    };

    /** \brief The bounds of an SE2, Reeds-Shepp or Dubins space. */
    Box spaceBounds(const ompl::base::StateSpace &space);

}  // namespace parking
