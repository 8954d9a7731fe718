#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "parking_geometry/Box.h"
#include "state_validity/CircleChecker.h"

#include <cstddef>

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
        void freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                         double *lengths) override;
        bool keeps(const Pose &pose, double clearance) override;
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
        double clearance(const Pose &pose) const;

        const CircleChecker &checker_;
        Box bounds_;
    };
}  // namespace parking
