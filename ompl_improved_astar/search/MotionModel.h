#pragma once

#include "ompl_improved_astar/search/Node.h"
#include "ompl_improved_astar/search/Registry.h"
#include "ompl_improved_astar/search/SearchContext.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace parking::search
{
    /** \brief A motion from a node and the pose that it leads to, not yet a node. */
    struct Successor
    {
        Motion motion;         ///< from the node, as seen from the root outwards
        Pose pose;             ///< where it leads to
        bool farthest{false};  ///< see Node::farthest
        double clear{-1.0};    ///< metres at its beginning known to keep the preferred clearance; negative: unknown
    };

    /** \brief Properties of a motion model that control the search. */
    struct ModelTraits
    {
        /** Number of resolutions, each finer than the previous one (see Search). */
        std::size_t levels{1};
        /** Nodes are joined by curves with the other side's roots and its best closed node, and motions are priced by
            their clearance; otherwise nodes are joined with the one in the same cell, before they are expanded. */
        bool drivesCurves{false};
        /** If one side is exhausted, the other cannot be reached: cells leave nothing out. */
        bool isComplete{false};
        /** Estimates count to the other side's closed node of least cost (paper, "Bidirectional Search"). */
        bool aims{false};
        /** Its heading jumps: a space of curves cannot follow its paths. */
        bool turnsOnTheSpot{false};
        /** One expansion in that many goes to the side whose roots are less confined. */
        std::uint64_t otherSidePeriod{2};
    };

    /** \brief Successors and connections of nodes: the part of the search that models the car.

        An object belongs to one search; begin() prepares it for a query. Poses are those of the rear axle. Motions lead
        from the roots outwards on both sides: on the goal's side the car drives them in the opposite direction. */
    class MotionModel
    {
    public:
        virtual ~MotionModel() = default;

        /** \brief Begins a query. */
        virtual void begin(const SearchContext &context) = 0;

        /** \brief Traits of the model. Those that depend on parameters are valid after begin(). */
        virtual ModelTraits traits() const = 0;

        /** \brief The name of the heuristic that suits the model. */
        virtual std::string heuristic() const = 0;

        /** \brief Receives every root before it is searched from. */
        virtual void addRoot(Side /*side*/, const Pose & /*pose*/)
        {
        }

        /** \brief Key of the cell of a pose, 61 bits. The search keeps one node per cell and level.

            \param level 0 is the coarsest */
        virtual std::uint64_t cell(const Pose &pose, std::size_t level) const = 0;

        /** \brief Free length around a root in metres, summed over directions; small in a slot. */
        virtual double mobility(const Pose & /*root*/)
        {
            return 0.0;
        }

        /** \brief Mobility in metres by which the goal may exceed the start and still be the confined end. */
        virtual double mobilitySlack() const
        {
            return 0.0;
        }

        /** \brief Appends the motions from a node in the order in which they are tried. What is known to collide may be
            left out.

            \param index number of the node on its side
            \param level whose step is wanted
            \param isFirst the node has not been expanded on a coarser level */
        virtual void expand(Side side, NodeIndex index, const Node &node, std::size_t level, bool isFirst,
                            std::vector<Successor> &successors) = 0;

        /** \brief Whether the motion is free. Called only for motions that would become a node. */
        virtual bool isFree(Side /*side*/, const Node & /*from*/, const Successor & /*successor*/)
        {
            return true;
        }

        /** \brief Receives the pieces between two nodes and the cost of the whole path. Returns whether it accepts
            them.
         */
        using Offer = std::function<bool(const PathPiece *pieces, std::size_t count, double cost)>;

        /** \brief Offers free connections between a node of the start's side and one of the goal's, the cheapest first,
            until one is taken.

            \param sweptFrom the side near which a collision is more likely
            \param bound upper limit of the cost of the whole path \return whether one was accepted */
        virtual bool join(const Node &fromStart, const Node &fromGoal, Side sweptFrom, double bound,
                          const Offer &offer) = 0;

        /** \brief Follows the shortest motion to a pose, obstacles ignored, and ends where it may lose the preferred
            clearance or, if none is preferred, where it collides.

            \param motions receives consecutive motions, from the root outwards; empty if the model cannot drive to a
            pose */
        virtual void moveTowards(Side /*side*/, const Pose & /*from*/, const Pose & /*to*/,
                                 std::vector<Successor> &motions)
        {
            motions.clear();
        }

        /** \brief Length of the shortest motion between two poses, obstacles ignored: a lower bound of the cost of any
            path of the model. */
        virtual double distance(const Pose &from, const Pose &to) const = 0;

        /** \brief Curves that may replace parts of a path; nullptr for a model whose paths are not improved. */
        virtual const ReedsShepp *curves() const
        {
            return nullptr;
        }

        /** \brief Classifies cells before the search. \return false if \e stop ended it; the next call resumes */
        virtual bool load(const StopFunction & /*stop*/)
        {
            return true;
        }

        /** \brief Bytes of tables that grow with the search, for max_memory_mb. */
        virtual std::size_t bytes() const
        {
            return 0;
        }
    };

    /** \brief The motion models by name. */
    Registry<MotionModel> &motionModels();

    /** \brief Whether paths of this motion model turn on the spot. Throws parking::Error for an unknown model. */
    bool turnsOnTheSpot(const std::string &motionModel);
}  // namespace parking::search
