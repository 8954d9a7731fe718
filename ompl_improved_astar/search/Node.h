#pragma once

#include "ompl_improved_astar/search/CarInSpace.h"
#include "ompl_improved_astar/search/containers/CellTable.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <cstdint>

/** \brief The search of the planner, independent of OMPL. */
namespace parking::search
{
    /** \brief The end of the problem that a frontier grows from. */
    enum class Side : std::uint8_t
    {
        Start,  ///< paths begin here
        Goal    ///< paths end here
    };

    /** \brief The other end. */
    inline Side opposite(Side side)
    {
        return side == Side::Start ? Side::Goal : Side::Start;
    }

    /** \brief Number of a node among those of its side. */
    using NodeIndex = std::uint32_t;

    /** \brief Stands for no node. */
    constexpr NodeIndex NO_NODE = CellTable::NONE;

    /** \brief Motion from a node to its child, seen from the root outwards: a turn on the spot, then a drive.

        On the goal's side the car drives it in the opposite direction. A car model has no turns. */
    struct Motion
    {
        double turn{0.0};       ///< radians, on the spot
        double curvature{0.0};  ///< 1/m, positive to the left
        double length{0.0};     ///< metres, negative in reverse

        /** \brief The motion without its turn, as a piece of a path. */
        PathPiece drive() const
        {
            return {curvature, length};
        }
    };

    /** \brief A pose that a search has reached, with its cost and parent. */
    struct Node
    {
        Pose pose;                   ///< exact, of the rear axle
        double g{0.0};               ///< cost of the path between root and node
        Motion motion;               ///< from the parent
        float h{0.0f};               ///< estimated cost of the rest of the path
        float densityPenalty{0.0f};  ///< part of the priority, for earlier expansions in the same region
        NodeIndex parent{NO_NODE};   ///< NO_NODE for a root
        std::uint8_t cusps{0};       ///< between root and node, at most ANY_CUSPS
        std::uint8_t level{0};       ///< the coarsest level on which its cell was free
        std::uint8_t next{0};        ///< the level on which it is expanded next
        bool fixed{false};           ///< may have children before it is expanded: a cheaper node must not replace it
        bool farthest{false};        ///< the motion ended at contact or at its maximum, not at the step of a level

        /** \brief Whether it has been expanded on at least one level. */
        bool isExpanded() const
        {
            return next > level;
        }
    };

    /** \brief Changes of direction between a root and the end of \e motion from \e parent. */
    inline std::uint8_t cuspsThrough(const Node &parent, const Motion &motion)
    {
        const bool isCusp = parent.motion.length * motion.length < 0.0;
        return static_cast<std::uint8_t>(parent.cusps + (isCusp && parent.cusps < ANY_CUSPS ? 1 : 0));
    }
}  // namespace parking::search
