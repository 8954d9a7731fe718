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

    void OpenList::rekey(const std::function<bool(Entry &)> &key)
    {
        entries_.erase(std::remove_if(entries_.begin(), entries_.end(), [&key](Entry &entry) { return !key(entry); }),
                       entries_.end());
        arrange();
    }
}  // namespace parking::search
