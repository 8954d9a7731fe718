#include "ompl_improved_astar/search/OpenList.h"

#include <algorithm>
#include <utility>

namespace parking::search
{
    namespace
    {
        /** The best entry in logarithmic time (paper, "Binary Heap"). */
        class BinaryHeap final : public OpenList
        {
        protected:
            void pushed() override
            {
                std::push_heap(entries_.begin(), entries_.end(), order());
            }

            void moveBestToEnd() override
            {
                std::pop_heap(entries_.begin(), entries_.end(), order());
            }

            void rearrange() override
            {
                std::make_heap(entries_.begin(), entries_.end(), order());
            }
        };

        /** A scan of the whole list for the best entry, as in the plain A* of the paper's comparison. */
        class LinearList final : public OpenList
        {
        protected:
            void pushed() override
            {
            }

            void moveBestToEnd() override
            {
                std::iter_swap(std::max_element(entries_.begin(), entries_.end(), order()), entries_.end() - 1);
            }

            void rearrange() override
            {
            }
        };
    }  // namespace

    bool OpenList::rekey(const std::function<bool(Entry &)> &key, const StopFunction &stop)
    {
        constexpr std::size_t ENTRIES_BETWEEN_STOPS = 512;
        std::vector<Entry> rekeyed;
        rekeyed.reserve(entries_.size());
        for (std::size_t i = 0; i < entries_.size(); ++i)
        {
            if (i % ENTRIES_BETWEEN_STOPS == ENTRIES_BETWEEN_STOPS - 1 && stop && stop())
                return false;
            if (Entry entry = entries_[i]; key(entry))
                rekeyed.push_back(entry);
        }
        entries_ = std::move(rekeyed);
        rearrange();
        return true;
    }

    Registry<OpenList> &openLists()
    {
        static Registry<OpenList> registry("open_list", {
                                                            {"binary_heap", newPart<BinaryHeap>},
                                                            {"linear", newPart<LinearList>},
                                                        });
        return registry;
    }
}  // namespace parking::search
