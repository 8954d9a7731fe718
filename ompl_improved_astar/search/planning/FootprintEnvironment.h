#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "parking_geometry/Box.h"
#include "state_validity/FootprintChecker.h"

#include <vector>

namespace parking
{
    /** \brief Motion environment on top of a FootprintChecker: motions are swept exactly.

        The search then uses neither states nor interpolation of OMPL. */
    class FootprintEnvironment final : public search::MotionEnvironment
    {
    public:
        /** \brief Tolerance of the planner: metres kept from obstacles along motions. */
        static constexpr double TOLERANCE = 1e-3;

        /** \brief \param checker must outlive the environment
            \param bounds of the rear axle's position, in addition to the checker's world
            \param tolerance metres kept from obstacles along motions
            \param judge final check of whole paths; may be nullptr */
        FootprintEnvironment(const FootprintChecker &checker, const Box &bounds, double tolerance,
                             search::MotionEnvironment *judge = nullptr);

        bool isFree(const Pose &pose) override;
        void freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                         double *lengths) override;
        bool keeps(const Pose &pose, double clearance) override;
        /** \brief Sound, but not complete: see ClearanceProof. */
        bool isMotionFree(const Pose &from, const Pose &to) override;
        double roomAt(double x, double y) override;
        search::BlockedHeadings blockedHeadings(double side, int headings) override;
        /** \brief The escapes that stay within the bounds. */
        std::vector<Escape> escapes(const Pose &pose, double maxDepth, double turningRadius, bool forwardOnly) override;
        bool acceptPath(const Path &path) override;
        Box bounds() const override
        {
            return bounds_;
        }
        bool wasInterrupted() const override
        {
            return judge_ != nullptr && judge_->wasInterrupted();
        }

        /** \brief Number of poses decided by each tier. */
        const CheckCounts &counts() const
        {
            return counts_;
        }

    private:
        double lengthInside(const Pose &from, double curvature, double length) const;

        const FootprintChecker &checker_;
        Box bounds_;
        double tolerance_;
        search::MotionEnvironment *judge_;
        bool boundsMatter_;
        CheckCounts counts_;
    };
}  // namespace parking
