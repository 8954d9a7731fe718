#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "parking_geometry/Box.h"
#include "state_validity/CircleChecker.h"
#include "state_validity/ObstacleSet.h"

#include <cstdint>
#include <memory>
#include <optional>

#include <Eigen/Core>

namespace parking
{
    /** \brief How it is found out whether a disc is free. */
    enum class DiscLookup
    {
        Scan,  ///< every cell of the map that the disc touches is looked at, as the paper does; grids only
        Field  ///< a distance field is made beforehand
    };

    /** \brief The paper's car as its search sees it (section "Introducing Vehicle Volume"): a disc, and where it
       stands.

        The paper draws the disc round the planned position, which to it is the body's middle. Here a planned position
        may be the middle as well (\e ahead 0, and the car described so that its poses are of the middle), or the rear
        axle with the disc round the middle that lies \e ahead of it, or round the axle itself (\e ahead 0).

        Both lookups give the same answers up to rounding; what they cost differs. Motions are checked along their
        length, which the paper does not do. */
    class DiscWorld final : public search::MotionEnvironment
    {
    public:
        /** \brief What was looked at. */
        struct Counts
        {
            std::uint64_t positions{0};  ///< of the disc, motions counted once
            std::uint64_t cells{0};      ///< of the map, by DiscLookup::Scan
            /** Seconds of processor time of the process when the first motion was asked about: what is loaded
               beforehand is loaded by then. Not set when none was. */
            std::optional<double> firstMotionAt;
        };

        /** \brief \param bounds of the positions, in addition to the end of the world
            \param radius metres, positive
            \param ahead metres from the position to the disc's centre, along the heading

            Throws parking::Error for a radius that is not positive, and for DiscLookup::Scan in a world of polygons. */
        DiscWorld(const ObstacleSet &obstacles, const Box &bounds, double radius, double ahead, DiscLookup lookup);

        bool isFree(const Pose &pose) override;
        /** Nothing is known with a clearance. */
        void freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                         double *lengths) override;
        bool knowsClearance() const override
        {
            return false;
        }
        Box bounds() const override
        {
            return bounds_;
        }
        double roomAt(double x, double y) override;
        bool isMotionFree(const Pose &from, const Pose &to) override;
        bool headingMatters() const override
        {
            return ahead_ != 0.0;
        }

        /** \brief What was looked at since the world was made. */
        const Counts &counts() const
        {
            return counts_;
        }

    private:
        Eigen::Vector2d centre(const Pose &pose) const;
        bool isSweepFree(const Eigen::Vector2d &from, const Eigen::Vector2d &to);
        bool isScanFree(const Eigen::Vector2d &from, const Eigen::Vector2d &to);

        ObstacleSet obstacles_;
        Box bounds_;
        double radius_, ahead_;
        std::unique_ptr<const CircleChecker> field_;  // null when cells are scanned
        Counts counts_;
    };
}  // namespace parking
