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
    /** \brief Motion environment of the search on top of OMPL's validity checker and motion validator.

        It checks states along each motion. The motion validator then checks each path, motion by motion, in the
        direction of driving. */
    class StateSpaceEnvironment final : public search::MotionEnvironment
    {
    public:
        /** \brief \param step metres between the states checked along a motion
            \param stateSpacing between the states of a path */
        StateSpaceEnvironment(const ompl::base::SpaceInformationPtr &si, double step, const StateSpacing &stateSpacing,
                              bool headingMatters);

        /** \brief Sets a stop function. While it returns true, motions count as blocked and clearances as unknown, so
            that a slow checker does not delay termination. */
        void setStop(const search::StopFunction &stop)
        {
            stop_ = stop;
            interrupted_ = false;
        }

        /** \brief Sets a function that changes the poses of a path so that it ends exactly at the goal; acceptPath()
           checks the motions between these poses. */
        void setEnding(std::function<void(std::vector<Pose> &)> ending)
        {
            ending_ = std::move(ending);
        }

        bool isFree(const Pose &pose) override;
        /** Returns 0 for a positive clearance, which states cannot prove. */
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
        /** Infinite: obstacles are unknown. */
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

        /** \brief States checked since construction, without those of the motion validator. */
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
