#pragma once

#include "parking_geometry/OrientedBox.h"
#include "state_validity/ObstacleSet.h"
#include "state_validity/sweeps/SweepFront.h"
#include "state_validity/sweeps/SweptBox.h"

#include <atomic>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace parking
{
    /** \brief The edges of all obstacles, found quickly near a point, and how far an oriented box is from them.

        The world is cut into square cells, and edges at the borders between cells; edges of a cell that lie together
        form blocks of eight with a box round them, so that most blocks are passed over whole. Smaller squares, the
        buckets, have lists of the blocks within \e reach of any of their points, so one list answers a query whole.
        Blocks and lists are made lazily: their cost grows with the area that is searched, not with the
        map. Safe for const calls from several threads. */
    class EdgeIndex
    {
    public:
        /** \brief \param reach metres, positive: how far from the queried point edges matter. */
        EdgeIndex(const std::vector<Edge> &edges, const Box &bounds, double reach);
        ~EdgeIndex();
        EdgeIndex(const EdgeIndex &) = delete;
        EdgeIndex &operator=(const EdgeIndex &) = delete;

        /** \brief How far from a queried point edges matter, in metres. */
        double reach() const
        {
            return reach_;
        }

        /** \brief The smallest separation of the box and the edges within reach of its centre.

            Per piece of an edge this is the largest gap along the axes of the box and the edge's normal (separating
           axes): positive when apart, and then never more than their distance (equal to it unless corner faces corner);
           negative when they cross, by how much they would have to be moved along the best of those axes. Infinite
           without edges.

            \param ignored separations of at least this need not be told apart: when all are, the result is some number
            that is at least this */
        double separation(const OrientedBox &box, double ignored = std::numeric_limits<double>::infinity()) const;

        /** \brief Is separation() at least \e least? */
        bool isSeparate(const OrientedBox &box, double least) const;

        /** \brief Whether the smallest separation is above \e band (1), below minus \e band (-1), or between (0). */
        int side(const OrientedBox &box, double band) const;

        /** \brief The exact distance between the box's outline or interior and the nearest edge; 0 when they cross.
            Infinite when no edge is within reach. */
        double distance(const OrientedBox &box) const;

        /** \brief The distance to the nearest of all edges, however far: looks farther and farther out, and gathers no
            list. */
        double distanceToAll(const OrientedBox &box) const;

        /** \brief distance() for the point (x, y). */
        double distance(double x, double y) const;

        /** \brief Metres along an arc until the box first touches an edge; infinite when it does not.

            \param sweep the motion; its half lengths take the place of those of \e box
            \param middleCosine, middleSine of half the angle turned through, not negative
            Edges farther than reach() from the centre of \e box may be missed: the sweep must not get there. The box
            must not touch an edge at the beginning. */
        double firstContact(const OrientedBox &box, const BoxSweep &sweep, double middleCosine,
                            double middleSine) const;

    private:
        struct Block;
        struct BlockInBox;
        struct Cell;
        using List = std::vector<BlockInBox>;

        template <class T, class Make>
        static const T &once(std::atomic<T *> &place, const Make &make);
        const List &near(double x, double y) const;
        std::unique_ptr<List> gather(std::size_t column, std::size_t row) const;
        std::unique_ptr<Cell> cut(std::size_t column, std::size_t row) const;

        double reach_;
        double bucketSize_, inverseBucketSize_;
        Eigen::Vector2d origin_;
        std::size_t columns_, rows_;
        /** Edges by the cells that their boxes overlap, in one array: cell k has ofCells_[first_[k]...]. They are
           copies, side by side: what cuts a cell would otherwise wait for memory all over the map. */
        std::size_t cellColumns_, cellRows_;
        double cellSize_;
        std::vector<std::size_t> first_;
        std::vector<Edge> ofCells_;
        mutable std::vector<std::atomic<Cell *>> cells_;
        mutable std::vector<std::atomic<List *>> buckets_;
    };
}  // namespace parking
