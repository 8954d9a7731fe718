#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Pose.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace parking
{
    class FootprintChecker;

    /** \brief Parameters of a TextbookSearch, with the usual values. */
    struct TextbookParameters
    {
        double xyResolution{0.1};       ///< cell size in metres of the lattice and of the disc's distances
        unsigned headingBins{72};       ///< number of headings round the circle
        unsigned steeringAngles{3};     ///< odd number: from full left to full right lock, evenly spaced
        double motionLength{0.5};       ///< length of a motion in metres
        double reversePenalty{1.0};     ///< extra cost per metre in reverse
        double gearChangePenalty{1.0};  ///< metres
        double steeringPenalty{0.0};    ///< extra cost per metre at full lock
        unsigned expansionInterval{5};  ///< number of nodes between analytic expansions
        double heuristicWeight{1.0};    ///< factor of the heuristic
        bool obstacleHeuristic{true};   ///< whether the disc's distance to the goal guides the search
    };

    /** \brief A problem of a TextbookSearch. All poses have the frame of the footprint's obstacles. */
    struct TextbookProblem
    {
        Pose start;                                       ///< where the path begins
        Pose goal;                                        ///< where it ends
        Box bounds;                                       ///< of the rear axle's position
        double turningRadius{0.0};                        ///< metres
        std::function<double(const Pose &)> curveToGoal;  ///< length in metres of the shortest curve to the goal
        /** Whether the shortest curve between two poses is free and the second is within the bounds. */
        std::function<bool(const Pose &from, const Pose &to)> isMotionFree;
        const FootprintChecker *footprint{nullptr};  ///< of the disc's distances; nullptr: without them
        std::function<bool()> stop;                  ///< polled; true ends the search
    };

    /** \brief The search of a standard Hybrid A* (D. Dolgov, S. Thrun and others, Int. J. Robotics Research 29, 2010).

        One search from the start over a uniform lattice is guided by the maximum of the curve's length and a disc's
        distance to the goal. An analytic expansion is attempted at every n-th node. The class does not depend on OMPL:
        TextbookHybridAStar is its interface to OMPL, and the playground plans with it, too. */
    class TextbookSearch
    {
    public:
        /** \brief A node of the search. */
        struct Node
        {
            Pose pose;             ///< at the end of its motion
            double cost;           ///< of the path from the start
            double ahead;          ///< the heuristic: estimate of the cost to the goal
            std::uint32_t parent;  ///< index of the node before it; NOBODY for the start
            double curvature;      ///< 1/m, of the motion from its parent
            int direction;         ///< 1 forwards, -1 in reverse, 0 for the start
            bool closed;           ///< expanded, or replaced by a cheaper one
        };

        static constexpr std::uint32_t NOBODY = std::numeric_limits<std::uint32_t>::max();  ///< no parent

        /** \brief Computes the disc's distances. Throws parking::Error if the world has too many cells. */
        TextbookSearch(TextbookProblem problem, const TextbookParameters &parameters);
        ~TextbookSearch();

        /** \brief Searches until there is a path, the open list is empty or the problem's \e stop is true.

            \return the poses of a path, joined by shortest curves; empty without one */
        std::vector<Pose> run();

        /** \brief The parameters. */
        const TextbookParameters &parameters() const
        {
            return parameters_;
        }

        /** \brief The nodes in the order in which they were reached. */
        const std::vector<Node> &nodes() const
        {
            return nodes_;
        }

        /** \brief Number of nodes at each expansion. */
        const std::vector<std::size_t> &growth() const
        {
            return growth_;
        }

    private:
        class DiscWays;
        /** Ordered by f, then h, then age. */
        using OpenNode = std::tuple<double, double, std::uint32_t>;

        std::uint64_t keyOf(const Pose &pose) const;
        double heuristic(const Pose &pose) const;
        void add(Node node);
        void expand(std::uint32_t index);
        std::vector<Pose> pathTo(std::uint32_t index) const;

        TextbookProblem problem_;
        TextbookParameters parameters_;
        std::unique_ptr<const DiscWays> ways_;
        std::vector<Node> nodes_;
        std::vector<std::size_t> growth_;
        std::unordered_map<std::uint64_t, std::uint32_t> cells_;
        std::priority_queue<OpenNode, std::vector<OpenNode>, std::greater<>> open_;
    };
}  // namespace parking
