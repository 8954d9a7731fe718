#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/Search.h"
#include "ompl_improved_astar/search/SearchParameters.h"

#include <cstdint>
#include <memory>

namespace parking::search
{
    /** \brief More expansions than there ever are. */
    constexpr std::uint64_t ENDLESS = std::uint64_t{1} << 62;

    /** \brief The same parameters for a search beside a way that is known: that there is none need not be proven, nor
        are all obstacles loaded beforehand. */
    inline SearchParameters besideKnownWay(SearchParameters parameters)
    {
        parameters.eagerObstacles = false;
        parameters.tuning.enclosureAfter = ENDLESS;
        return parameters;
    }

    /** \brief A search beside that for the first path, which may begin anew again and again in one query.

        Counts what all of them did. It takes memory from the first time on that one begins, and keeps it from query to
        query. */
    class SideSearch
    {
    public:
        /** \brief Begins a new query: none is under way, and none was. */
        void forget()
        {
            isUnderWay_ = false;
            ended_ = {};
        }

        /** \brief Ends the search under way, if there is one, and begins another. */
        Search &begin(MotionEnvironment &environment, const SearchParameters &parameters)
        {
            end();
            if (!search_)
                search_ = std::make_unique<Search>();
            search_->begin(environment, parameters);
            isUnderWay_ = true;
            return *search_;
        }

        /** \brief Ends the search under way, if there is one. What it has found may still be asked for. */
        void end()
        {
            if (isUnderWay_)
                ended_ += search_->statistics();
            isUnderWay_ = false;
        }

        /** \brief Has one begun that has not ended? */
        bool isUnderWay() const
        {
            return isUnderWay_;
        }

        /** \brief The one that began last; there must have been one. */
        Search &search()
        {
            return *search_;
        }

        /** \brief The same, to be looked at. */
        const Search &search() const
        {
            return *search_;
        }

        /** \brief Nodes expanded in this query: statistics().expanded. */
        std::uint64_t expanded() const
        {
            return ended_.expanded + (isUnderWay_ ? search_->expanded() : 0);
        }

        /** \brief What all of them did in this query. */
        SearchStatistics statistics() const
        {
            SearchStatistics sum = ended_;
            if (isUnderWay_)
                sum += search_->statistics();
            return sum;
        }

    private:
        std::unique_ptr<Search> search_;
        bool isUnderWay_{false};
        SearchStatistics ended_;
    };
}  // namespace parking::search
