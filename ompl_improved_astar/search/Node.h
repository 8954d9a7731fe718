#pragma once

#include "ompl_improved_astar/search/containers/CellTable.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <cstdint>

/** \brief The search: what is planned in, how nodes are reached, estimated and chosen. It knows nothing of OMPL. */
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

    /** \brief In the place of a node that there is not. */
    constexpr NodeIndex NO_NODE = CellTable::NONE;

    /** \brief In the place of a number of cusps: any number. */
    constexpr std::uint8_t ANY_CUSPS = 255;

    /** \brief What leads from a node to its child, as seen from the root outwards: a turn on the spot, then a drive.

        On the goal's side the car will do it the other way round. A car model has no turns. */
    struct Motion
    {
        double turn{0.0};       ///< radians, on the spot
        double curvature{0.0};  ///< 1/m where the drive begins, positive to the left
        double length{0.0};     ///< metres, negative when driven in reverse
        double sharpness{0.0};  ///< 1/m^2

        /** \brief The motion without its turn, as a piece of a path. */
        PathPiece drive() const
        {
            return {curvature, length, sharpness};
        }
    };

    /** \brief A pose that a search has reached, and how. */
    struct Node
    {
        Pose pose;                  ///< exact, of the rear axle
        double g{0.0};              ///< cost of the way between root and node
        Motion motion;              ///< from the parent
        float h{0.0f};              ///< estimated cost of the way on
        float mobility{0.0f};       ///< metres of the longest free motion from here, known after the first expansion
        float wait{0.0f};           ///< what its place in the open list costs it, being crowded
        NodeIndex parent{NO_NODE};  ///< NO_NODE for a root
        std::uint8_t cusps{0};      ///< between root and node, at most ANY_CUSPS
        std::uint8_t level{0};      ///< the coarsest level on which its cell was free
        std::uint8_t next{0};       ///< the level on which it is expanded next
        bool queued{false};         ///< of roots: has been put into the open list
        bool fixed{false};     ///< others may have been reached from here before it is expanded: must stay as it is
        bool farthest{false};  ///< the motion ended for want of reach, not because a shorter step was wanted

        /** \brief Has it been expanded, on one level at least? */
        bool isExpanded() const
        {
            return next > level;
        }
    };

    /** \brief Changes of direction between a root and where \e motion leads to from \e parent. */
    inline std::uint8_t cuspsThrough(const Node &parent, const Motion &motion)
    {
        const bool isCusp = parent.motion.length * motion.length < 0.0;
        return static_cast<std::uint8_t>(parent.cusps + (isCusp && parent.cusps < ANY_CUSPS ? 1 : 0));
    }
}  // namespace parking::search
