// The open lists: a line each.

#include "ompl_improved_astar/search/openlists/BinaryHeap.h"
#include "ompl_improved_astar/search/openlists/LinearList.h"

namespace parking::search
{
    Registry<OpenList> &openLists()
    {
        static Registry<OpenList> registry("open_list", {
                                                            {"binary_heap", newPart<BinaryHeap>},
                                                            {"linear", newPart<LinearList>},
                                                        });
        return registry;
    }

    void OpenList::beginRekeying()
    {
        const auto begin = entries_.begin();
        entries_.erase(begin + static_cast<std::ptrdiff_t>(kept_), begin + static_cast<std::ptrdiff_t>(rekeyed_));
        rekeyed_ = kept_ = arranged_ = 0;
    }

    bool OpenList::rekey(const std::function<bool(Entry &)> &key, std::size_t most)
    {
        const std::size_t end = rekeyed_ + std::min(most, entries_.size() - rekeyed_);
        for (; rekeyed_ < end; ++rekeyed_)
            if (Entry entry = entries_[rekeyed_]; key(entry))
                entries_[kept_++] = entry;
        if (rekeyed_ < entries_.size())
            return false;
        entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(kept_), entries_.end());
        rekeyed_ = kept_;
        for (std::size_t left = most; arranged_ < kept_; --left, ++arranged_)
        {
            if (left == 0)
                return false;
            arrange(kept_ - 1 - arranged_);
        }
        beginRekeying();
        return true;
    }
}  // namespace parking::search
