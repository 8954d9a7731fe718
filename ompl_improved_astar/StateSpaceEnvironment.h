#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "ompl_improved_astar/search/planning/PathStates.h"
#include "parking_geometry/Box.h"
#include "parking_geometry/curves/Path.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace parking
{
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
