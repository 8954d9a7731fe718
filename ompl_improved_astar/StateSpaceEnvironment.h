#pragma once

#include "ompl_improved_astar/search/GridEnvironment.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "parking_geometry/ArcPath.h"
#include "parking_geometry/Scenario.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>

#include <cstdint>

namespace parking
{
    /** \brief The world of the search as OMPL sees it, for any validity checker and motion validator.

        Motions are tried by asking for the validity of states along them; paths found are then put to the motion
       validator, motion by motion, in the direction in which they will be driven. */
    class StateSpaceEnvironment final : public search::MotionEnvironment, public search::GridEnvironment
    {
    public:
        /** \brief \param step metres between states asked for along a motion
            \param stateSpacing metres between the states of a path, see pathStates() */
        StateSpaceEnvironment(const ompl::base::SpaceInformationPtr &si, double step, double stateSpacing,
                              bool headingMatters);

        /** \brief While \e stop says true every motion is cut short, so that a slow checker does not delay the end. */
        void setStop(const search::StopFunction &stop)
        {
            stop_ = stop;
        }

        bool isFree(const Pose &pose) override;
        double clearance(const Pose &pose) override;
        double freeLength(const Pose &from, double curvature, double length) override;
        double roomAt(double x, double y) override;
        bool acceptPath(const ArcPath &path) override;

        bool isMotionFree(const Pose &from, const Pose &to) override;
        bool headingMatters() const override
        {
            return headingMatters_;
        }

        std::uint64_t checkedStates() const
        {
            return checkedStates_;
        }

    private:
        ompl::base::SpaceInformationPtr si_;
        double step_;
        double stateSpacing_;
        bool headingMatters_;
        bool clearanceKnown_;
        Bounds bounds_;
        search::StopFunction stop_;
        std::uint64_t checkedStates_{0};
        ompl::base::ScopedState<> state_, other_;
    };

    /** \brief The bounds of an SE2, Reeds-Shepp or Dubins space. */
    Bounds spaceBounds(const ompl::base::StateSpace &space);

    /** \brief The poses of \e path between which the space's own interpolation follows the path.

        \param spacing metres; 0 for spaces of curves, where the ends of short arcs suffice */
    std::vector<Pose> pathStates(const ArcPath &path, double spacing);
}  // namespace parking
