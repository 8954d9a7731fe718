#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "parking_geometry/Box.h"
#include "state_validity/FootprintChecker.h"

#include <memory>

namespace parking
{
    /** \brief The world of the search when the validity checker is this project's own: motions are swept exactly.

        Nothing of OMPL is in the way of the search here: no states, no interpolation. */
    class FootprintEnvironment final : public search::MotionEnvironment
    {
    public:
        /** \brief \param checker must outlive the environment
            \param bounds of the rear axle's position, in addition to the checker's world
            \param tolerance metres kept from obstacles along motions
            \param judge has the last word on whole paths; may be nullptr */
        FootprintEnvironment(const FootprintChecker &checker, const Box &bounds, double tolerance,
                             search::MotionEnvironment *judge = nullptr);

        bool isFree(const Pose &pose) override;
        double clearance(const Pose &pose) override;
        double freeLength(const Pose &from, double curvature, double length) override;
        void freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double *free) override;
        bool keeps(const Pose &pose, double clearance) override;
        void freeLengthsBeyond(const Pose &from, const Arc *arcs, std::size_t count, const double *clear,
                               double *free) override;
        std::size_t countNearer(const Pose &from, const Arc &arc, double first, double apart, std::size_t samples,
                                double clearance, std::size_t most) override;
        void clearLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                          double *clear) override;
        Pose turnedRound(const Pose &pose) const override;
        Box bounds() const override
        {
            return bounds_;
        }
        double roomAt(double x, double y) override;
        double closeRoomAt(double x, double y) override;
        /** \brief Conservative: covers the motion by poses whose clearances overlap (conservative advancement). */
        bool isMotionFree(const Pose &from, const Pose &to) override;
        bool acceptPath(const Path &path) override;
        std::unique_ptr<search::BodyCells> bodyCells(double side, int headings) override;
        bool wasInterrupted() const override
        {
            return judge_ != nullptr && judge_->wasInterrupted();
        }

        /** \brief Which tier decided how many poses. */
        const CheckCounts &counts() const
        {
            return counts_;
        }

    private:
        void sweep(const FootprintChecker::SweepStart &start, const Pose &from, const Arc *arcs, std::size_t count,
                   double *lengths);
        double lengthInside(const Pose &from, double curvature, double length) const;

        const FootprintChecker &checker_;
        Box bounds_;
        double tolerance_;
        search::MotionEnvironment *judge_;
        bool boundsMatter_;
        bool hasWideCells_;
        CheckCounts counts_;
    };
}  // namespace parking
