#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "parking_geometry/Box.h"
#include "state_validity/CircleChecker.h"

namespace parking
{
    /** \brief The world of the search for the paper's circle, which has no heading: what the grid models are meant
        for. */
    class CircleEnvironment final : public search::MotionEnvironment
    {
    public:
        /** \brief \param checker must outlive the environment
            \param bounds of the positions, in addition to the checker's world */
        CircleEnvironment(const CircleChecker &checker, const Box &bounds) : checker_(checker), bounds_(bounds)
        {
        }

        bool isFree(const Pose &pose) override;
        double clearance(const Pose &pose) override;
        double freeLength(const Pose &from, double curvature, double length) override;
        Box bounds() const override
        {
            return bounds_;
        }
        double roomAt(double x, double y) override;
        bool isMotionFree(const Pose &from, const Pose &to) override;
        bool headingMatters() const override
        {
            return false;
        }

    private:
        const CircleChecker &checker_;
        Box bounds_;
    };
}  // namespace parking
