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

    /** \brief What is peculiar to a model, for the search to go by. */
    struct ModelTraits
    {
        /** Resolutions, each finer than the one before, that take turns (see Search). */
        std::size_t levels{1};
        /** Nodes are joined by curves with the other side's roots and its best closed node, and motions are priced by
            their clearance; otherwise nodes are joined with the one in the same cell, before they are expanded. */
        bool drivesCurves{false};
        /** What one side has seen completely, the other cannot reach: its cells leave nothing out. */
        bool isComplete{false};
        /** Estimates count to the other side's closed node of least cost (paper, "Bidirectional Search"). */
        bool aims{false};
        /** Its heading jumps: a space of curves cannot follow its paths. */
        bool turnsOnTheSpot{false};
        /** One expansion in that many goes to the side whose roots are less confined. */
        std::uint64_t otherSidePeriod{2};
    };

    /** \brief How nodes are reached from each other: the interchangeable part of the search that knows the car.

        An object serves one search; begin() makes it ready for a query. Poses are those of the rear axle. Motions are
        given from the roots outwards on both sides: on the goal's side the car will drive them the other way. */
    class MotionModel
    {
    public:
        virtual ~MotionModel() = default;

        /** \brief Begins a query. */
        virtual void begin(const SearchContext &context) = 0;

        /** \brief Before begin() only what does not depend on parameters is right. */
        virtual ModelTraits traits() const = 0;

        /** \brief The name of the heuristic that suits the model. */
        virtual std::string heuristic() const = 0;

        /** \brief Receives every root before it is searched from. */
        virtual void addRoot(Side /*side*/, const Pose & /*pose*/)
        {
        }

        /** \brief The cell that a pose lies in, with 61 bits. Of the nodes in a cell one is kept for each level.

            \param level 0 is the coarsest */
        virtual std::uint64_t cell(const Pose &pose, std::size_t level) const = 0;

        /** \brief How far the car can move from a root, in metres summed over directions: little in a slot. */
        virtual double mobility(const Pose & /*root*/)
        {
            return 0.0;
        }

        /** \brief Mobility in metres by which the goal may exceed the start and still count as the confined end. */
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

        /** \brief Is the motion free? Asked only of those that would become a node. */
        virtual bool isFree(Side /*side*/, const Node & /*from*/, const Successor & /*successor*/)
        {
            return true;
        }

        /** \brief Receives the pieces between two nodes and the cost of the whole path. Returns whether they are taken.
         */
        using Offer = std::function<bool(const PathPiece *pieces, std::size_t count, double cost)>;

        /** \brief Offers free connections between a node of the start's side and one of the goal's, the cheapest first,
            until one is taken.

            \param sweptFrom the side near which a collision is more likely
            \param bound whole paths that cost as much are not wanted
            \return whether one was taken */
        virtual bool join(const Node &fromStart, const Node &fromGoal, Side sweptFrom, double bound,
                          const Offer &offer) = 0;

        /** \brief Moves from a node by the shortest motion that would lead to a pose without regard to obstacles, and
            ends where that does not surely keep the preferred clearance any more, or if none is preferred where it
            collides.

            \param motions one after the other, from the root outwards; overwritten. None for a model that cannot go
            where it is told to */
        virtual void moveTowards(Side /*side*/, const Pose & /*from*/, const Pose & /*to*/,
                                 std::vector<Successor> &motions)
        {
            motions.clear();
        }

        /** \brief Length of the shortest motion between two poses without regard to obstacles: a lower bound of the
            cost of any path that the model can drive. */
        virtual double distance(const Pose &from, const Pose &to) const = 0;

        /** \brief The curves by which parts of a path may be replaced; nullptr for a model whose paths stay as they
            are. */
        virtual const ReedsShepp *curves() const
        {
            return nullptr;
        }

        /** \brief Finds out beforehand what is free. \return false when \e stop said so; the next call goes on */
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

    /** \brief Do the paths of this motion model turn on the spot? Throws parking::Error for one that is not known. */
    bool turnsOnTheSpot(const std::string &motionModel);
}  // namespace parking::search
