#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "parking_geometry/Box.h"
#include "state_validity/CircleChecker.h"
#include "state_validity/ObstacleSet.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace parking
{
    /** \brief The paper's car as its search sees it (section "Introducing Vehicle Volume"): a disc that must be free at
        the ends of each step.

        A disc is free when no cell of the map that it touches is occupied. Either every cell is looked at, as in the
        paper, or a CircleChecker answers; both give the same answers up to rounding, at different cost. */
    class DiscWorld final : public search::MotionEnvironment
    {
    public:
        /** \brief Number of lookups. */
        struct Counts
        {
            std::uint64_t positions{0};  ///< of the disc
            std::uint64_t cells{0};      ///< of the map, when every cell is looked at
            /** Processor time in seconds at the first query for a motion, when eager loading is complete. Not set
                without such a query. */
            std::optional<double> firstMotionAt;
        };

        /** \brief \param bounds of the positions, in addition to the end of the world
            \param radius metres, positive
            \param ahead metres from the position to the centre of the disc, along the heading
            \param scan whether every cell is looked at

            Throws parking::Error for a radius that is not positive, and for a scan in a world of polygons. */
        DiscWorld(const ObstacleSet &obstacles, const Box &bounds, double radius, double ahead, bool scan);

        bool isFree(const Pose &pose) override;
        /** The ends of a step were checked; the paper checks no more. */
        bool isMotionFree(const Pose &from, const Pose &to) override;
        /** Not implemented, 0: the paper's models drive no arcs. */
        void freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                         double *lengths) override;
        double roomAt(double x, double y) override;
        bool knowsClearance() const override
        {
            return false;
        }
        bool headingMatters() const override
        {
            return ahead_ != 0.0;
        }
        Box bounds() const override
        {
            return bounds_;
        }

        /** \brief Lookups since construction. */
        const Counts &counts() const
        {
            return counts_;
        }

    private:
        bool isScanFree(double x, double y);

        ObstacleSet obstacles_;
        Box bounds_;
        double radius_, ahead_;
        std::unique_ptr<const CircleChecker> field_;  // null when cells are scanned
        Counts counts_;
    };
}  // namespace parking
