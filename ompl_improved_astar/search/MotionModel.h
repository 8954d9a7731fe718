#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/Node.h"
#include "ompl_improved_astar/search/Registry.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <cstdint>
#include <functional>
#include <limits>
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

    /** \brief What a model says about a node that is expanded. */
    struct Expansion
    {
        std::vector<Successor> successors;  ///< in the order in which they are tried
        double mobility{0.0};               ///< metres of the longest free motion, when it is known
    };

    /** \brief What is peculiar to a model, for the search to go by. */
    struct ModelTraits
    {
        /** Resolutions, each finer than the one before, that take turns (see Search). */
        std::size_t levels{1};
        /** Metres of cost that make up for a coarser or finer cell: a motion's reach. Compares the freedom of roots. */
        double reach{0.0};
        /** Nodes are joined with the other side's roots and its best closed node; otherwise with the node in the same
            cell only, before they are expanded. */
        bool joinsAfar{false};
        /** What one side has seen completely, the other cannot reach: its cells leave nothing out. */
        bool complete{false};
        /** Estimates count to the other side's closed node of least cost (paper, "Bidirectional Search"). */
        bool aims{false};
        /** isFree() is asked motion by motion and may be slow: the clock is looked at in between. */
        bool asksMotionByMotion{false};
        /** Its motions are priced by CostModel::preferredClearance. */
        bool prefersClearance{false};
        /** Its heading jumps: a space of curves cannot follow its paths. */
        bool turnsOnTheSpot{false};
        /** One expansion in so many goes to the side whose roots are less confined. */
        std::uint64_t otherSidePeriod{2};
    };

    /** \brief How nodes are reached from each other: the interchangeable part of the search that knows the car.

        An object serves one search; begin() makes it ready for a query. Poses are those of the rear axle. Motions are
        given from the roots outwards on both sides: on the goal's side the car will drive them the other way. */
    class MotionModel
    {
    public:
        virtual ~MotionModel() = default;

        /** \brief Begins a query. The environment and the parameters outlive it. */
        virtual void begin(MotionEnvironment &environment, const SearchParameters &parameters) = 0;

        /** \brief Before begin() only what does not depend on parameters is right. */
        virtual ModelTraits traits() const = 0;

        /** \brief The name of the heuristic that suits the model. */
        virtual std::string heuristic() const = 0;

        /** \brief Told of every root before it is searched from. */
        virtual void addRoot(Side /*side*/, const Pose & /*pose*/)
        {
        }

        /** \brief The cell that a pose lies in, with 61 bits. Of the nodes in a cell one is kept for each level.

            \param level 0 is the coarsest */
        virtual std::uint64_t cell(const Pose &pose, std::size_t level) const = 0;

        /** \brief How much cheaper, in metres, a node must be than the expanded one in its cell to be kept beside it;
            infinite: none is. */
        virtual double worthKeeping(std::size_t /*level*/) const
        {
            return std::numeric_limits<double>::infinity();
        }

        /** \brief How far the car can move from a root, in metres summed over directions: little in a slot. */
        virtual double mobility(const Pose & /*root*/)
        {
            return 0.0;
        }

        /** \brief The motions from a node. What is known to collide may be left out.

            \param index number of the node on its side
            \param level whose step is wanted
            \param first the node has not been expanded on a coarser level */
        virtual void expand(Side side, NodeIndex index, const Node &node, std::size_t level, bool first,
                            Expansion &expansion) = 0;

        /** \brief Is the motion free? Asked only of those that would become a node. */
        virtual bool isFree(Side /*side*/, const Node & /*from*/, const Successor & /*successor*/)
        {
            return true;
        }

        /** \brief Told of ways that join two nodes: what to drive in between, and what the whole path would cost. Says
            whether the way is taken. */
        using Offer = std::function<bool(const PathPiece *pieces, std::size_t count, double cost)>;

        /** \brief Offers free ways between a node of the start's side and one of the goal's, the cheapest first, until
            one is taken.

            \param sweptFrom the side near which a collision is more likely
            \param bound ways that make the whole path cost as much are of no use
            \return whether one was taken */
        virtual bool join(const Node &fromStart, const Node &fromGoal, Side sweptFrom, double bound,
                          const Offer &offer) = 0;

        /** \brief Moves from a node by the shortest motion that leads, or would lead, to a pose without regard to
            obstacles, and ends where that does not surely keep the preferred clearance any more, or if none is
            preferred where it is not free.

            \param motions the way, one motion after the other, from the root outwards; overwritten. None when nothing
            of it can be driven, and for a model that cannot go where it is told to. */
        virtual void moveTowards(Side /*side*/, const Pose & /*from*/, const Pose & /*to*/,
                                 std::vector<Successor> &motions)
        {
            motions.clear();
        }

        /** \brief Length of the shortest motion between two poses without regard to obstacles: a lower bound of the
            cost of any path that the model can drive. */
        virtual double distance(const Pose &from, const Pose &to) const = 0;

        /** \brief A lower bound of distance() that takes no time to tell; what it rules out is not looked at closer. */
        virtual double leastDistance(const Pose & /*from*/, const Pose & /*to*/) const
        {
            return 0.0;
        }

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
