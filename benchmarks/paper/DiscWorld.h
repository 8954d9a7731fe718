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
    /** \brief The paper's model of the car in the search (section "Introducing Vehicle Volume"): a disc that must be
        free at the ends of each step.

        A disc is free when it touches no occupied cell of the map. Either every cell is scanned, as in the paper, or a
        CircleChecker decides; both agree up to rounding, at different cost. */
    class DiscWorld final : public search::MotionEnvironment
    {
    public:
        /** \brief Number of lookups. */
        struct Counts
        {
            std::uint64_t positions{0};  ///< number of discs checked
            std::uint64_t cells{0};      ///< number of cells of the map scanned, without a distance field
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
        /** Always true: the paper checks only the ends of a step. */
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
