#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

namespace parking::search
{
    /** \brief What a step from a cell to one of its eight neighbours costs. */
    struct StepCost
    {
        std::uint32_t straight;  ///< to one that shares a side
        std::uint32_t diagonal;  ///< to one that shares a corner
    };

    /** \brief What a cell is to a disc that is to go there. */
    enum class Ground
    {
        Cheap,  ///< it may be there at the price of the way alone
        Dear,   ///< it may be there at a higher price
        Closed  ///< it does not fit there
    };

    /** \brief What is dear about the last cells of all ways to an aim: a lower bound of what is paid for that from the
        cells round it on, and from all others.

        Where an aim is dear, all ways to it end dear. Without knowing it, a search would look at all that is no farther
        away than what this costs. */
    class DearRoundAim
    {
    public:
        /** \brief Nothing is dear, and nothing is known. */
        void forget()
        {
            isKnown_ = false;
            fromElsewhere_ = 0;
        }

        /** \brief Has find() been called since? */
        bool isKnown() const
        {
            return isKnown_;
        }

        /** \brief Finds it out by Dijkstra's algorithm from the aim, with what dear cells cost on top of their
            lengths, up to the first cell that is not dear, or has neighbours that are not looked at: from what is left
            it costs at least as much.

            \param dearer so much a step to a dear cell costs on top
            \param look tells the Ground of the cell so many columns and rows from the aim */
        template <class Look>
        void find(const StepCost &dearer, const Look &look)
        {
            isKnown_ = true;
            fromElsewhere_ = 0;
            if (dearer.straight == 0)
                return;
            constexpr std::uint32_t UNREACHED = std::numeric_limits<std::uint32_t>::max();
            from_.assign(static_cast<std::size_t>(SIDE) * SIDE, UNREACHED);
            from_[place(0, 0)] = 0;
            open_.assign(1, {0, 0, 0});
            while (!open_.empty())
            {
                std::pop_heap(open_.begin(), open_.end(), isDearer);
                const Place at = open_.back();
                open_.pop_back();
                if (at.cost > from_[place(at.columns, at.rows)])
                    continue;
                fromElsewhere_ = at.cost;
                if (std::max(std::abs(at.columns), std::abs(at.rows)) >= REACH)
                    break;
                const Ground ground = look(at.columns, at.rows);
                if (ground == Ground::Cheap)
                    break;
                if (ground == Ground::Dear)
                    goOn(at, dearer);
            }
            for (std::uint32_t &cost : from_)
                cost = std::min(cost, fromElsewhere_);
        }

        /** \brief What is paid at least from the cell so many columns and rows from the aim. */
        std::uint32_t from(std::int32_t columns, std::int32_t rows) const
        {
            if (fromElsewhere_ == 0 || std::max(std::abs(columns), std::abs(rows)) > REACH)
                return fromElsewhere_;
            return from_[place(columns, rows)];
        }

    private:
        static constexpr std::int32_t REACH = 40;  // cells to either side
        static constexpr std::int32_t SIDE = 2 * REACH + 1;

        struct Place
        {
            std::uint32_t cost;
            std::int32_t columns, rows;
        };

        static bool isDearer(const Place &a, const Place &b)
        {
            return a.cost > b.cost;
        }

        static constexpr std::size_t place(std::int32_t columns, std::int32_t rows)
        {
            return static_cast<std::size_t>((rows + REACH) * SIDE + columns + REACH);
        }

        void goOn(const Place &at, const StepCost &dearer)
        {
            for (std::int32_t rows = -1; rows <= 1; ++rows)
                for (std::int32_t columns = -1; columns <= 1; ++columns)
                {
                    const bool isDiagonal = columns != 0 && rows != 0;
                    const Place next{at.cost + (isDiagonal ? dearer.diagonal : dearer.straight), at.columns + columns,
                                     at.rows + rows};
                    std::uint32_t &known = from_[place(next.columns, next.rows)];
                    if (next.cost >= known)
                        continue;
                    known = next.cost;
                    open_.push_back(next);
                    std::push_heap(open_.begin(), open_.end(), isDearer);
                }
        }

        bool isKnown_{false};
        std::uint32_t fromElsewhere_{0};
        std::vector<std::uint32_t> from_;  // empty until something is dear
        std::vector<Place> open_;
    };
}  // namespace parking::search
