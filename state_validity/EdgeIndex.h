#pragma once

#include "parking_geometry/OrientedBox.h"
#include "state_validity/Body.h"
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
    /** \brief A spatial index of the edges of all obstacles, with distances between them and an oriented box.

        If the index has pieces of a body, they replace the box: it only bounds them. Their separation from an edge is
        the smallest of all pieces.

        The index divides the world into square cells and cuts edges at the borders. Adjacent edges of a cell form
        blocks of eight with a bounding box, so a query skips most blocks. Smaller squares, the buckets, list all blocks
        within \e reach of any of their points, so a query requires only one list.

        The index computes blocks and lists lazily. Their cost grows with the searched area, not with the map. In a grid
        world it reads the outlines of cells only then, so changed cells just require that the blocks around them are
        dropped. Const calls from several threads are safe. */
    class EdgeIndex
    {
    public:
        /** \brief An index of \e edges.

            \param bounds area of the world
            \param reach largest distance in metres from the query point to a relevant edge, positive
            \param pieces the body in the frame of the box of all queries, which must contain it; none for the box
            itself */
        EdgeIndex(const std::vector<Edge> &edges, const Box &bounds, double reach, std::vector<BodyPiece> pieces = {});

        /** \brief An index of the edges of \e obstacles, which must outlive it. */
        EdgeIndex(const ObstacleSet &obstacles, double reach, std::vector<BodyPiece> pieces = {});

        ~EdgeIndex();
        EdgeIndex(const EdgeIndex &) = delete;
        EdgeIndex &operator=(const EdgeIndex &) = delete;

        /** \brief Takes over changed cells of a grid world. No other thread may use the index at the same time.

            \param changed the result of ObstacleSet::update() */
        void update(const std::vector<std::size_t> &changed);

        /** \brief Largest distance in metres from the query point to a relevant edge. */
        double reach() const
        {
            return reach_;
        }

        /** \brief Whether pieces of a body replace the box. */
        bool hasPieces() const
        {
            return !pieces_.empty();
        }

        /** \brief Smallest separation in metres of the box and the edges within reach of its centre; infinite without
            edges.

            For a piece of an edge, the separation is the largest gap along the axes of the box and the edge's normal
            (separating axes). A positive value is a lower bound of the distance, and equal to it unless corner faces
            corner. A negative value is the displacement along the best axis that would separate the two.

            \param ignored if all separations are at least this value, the result is any value of at least \e ignored */
        double separation(const OrientedBox &box, double ignored = std::numeric_limits<double>::infinity()) const;

        /** \brief Whether separation() is at least \e minSeparation. */
        bool isSeparate(const OrientedBox &box, double minSeparation) const;

        /** \brief Sign of the separation: 1 if it is above \e band, -1 if it is below minus \e band, otherwise 0. */
        int side(const OrientedBox &box, double band) const;

        /** \brief Exact distance in metres between the solid box and the nearest edge; 0 if they touch, infinite if no
            edge is within reach. */
        double distance(const OrientedBox &box) const;

        /** \brief Exact distance in metres between the solid box and the nearest edge at any distance. Searches rings
            of growing size and builds no list. */
        double distanceToAll(const OrientedBox &box) const;

        /** \brief Exact distance in metres from the point (x, y) to the nearest edge; infinite if no edge is within
            reach. */
        double distance(double x, double y) const;

        /** \brief Metres along an arc until the box first touches an edge; infinite if it touches none.

            \param sweep the motion; its half lengths replace those of \e box. Pieces are enlarged by the difference
            of the half lengths.
            \param middleCosine, middleSine cosine and sine of half the angle of the turn, not negative

            The sweep must stay within reach() of the centre of \e box because edges farther away may be missed. The box
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
        double separationOf(const Block &block, const OrientedBox &box, double ignored) const;
        double distanceOf(const OrientedBox &box, const Edge &edge, const Eigen::Vector2d &normal) const;
        double firstContactOfPieces(const OrientedBox &box, const BoxSweep &sweep, double middleCosine,
                                    double middleSine) const;
        double nearest(const List &list, const OrientedBox &box, double smallest) const;
        const List &near(double x, double y) const;
        const Cell &cellAt(std::size_t column, std::size_t row) const;
        std::unique_ptr<List> gather(std::size_t column, std::size_t row) const;
        std::unique_ptr<Cell> cut(std::size_t column, std::size_t row) const;

        const ObstacleSet *grid_{nullptr};  // whose cells are the obstacles, or null
        double reach_;
        std::vector<BodyPiece> pieces_;
        double bucketSize_, inverseBucketSize_;
        Eigen::Vector2d origin_;
        std::size_t columns_, rows_;
        /** Edges of polygons by the cells that their bounding boxes overlap, in one array: those of cell k begin at
            ofCells_[first_[k]]. Contiguous copies avoid cache misses when a cell is cut. */
        std::size_t cellColumns_, cellRows_;
        double cellSize_;
        std::vector<std::size_t> first_;
        std::vector<Edge> ofCells_;
        mutable std::vector<std::atomic<Cell *>> cells_;
        mutable std::vector<std::atomic<List *>> buckets_;
    };
}  // namespace parking
