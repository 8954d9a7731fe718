#include "state_validity/world/IndexedObstacles.h"

#include <algorithm>
#include <utility>

namespace parking
{
    IndexedObstacles::IndexedObstacles(ObstacleSet obstacles, double fieldResolution, double fieldReach)
      : obstacles_(std::move(obstacles)),
        field_(obstacles_, fieldResolution, fieldReach)
    {
    }

    IndexedObstacles::IndexedObstacles(Copy /*tag*/, const IndexedObstacles &other)
      : obstacles_(other.obstacles_),
        field_(other.field_),
        version_(other.version_)
    {
    }

    std::shared_ptr<IndexedObstacles> IndexedObstacles::copy() const
    {
        return std::shared_ptr<IndexedObstacles>(new IndexedObstacles(Copy{}, *this));
    }

    std::shared_ptr<const EdgeIndex> IndexedObstacles::edges(double reach, const std::vector<BodyPiece> &pieces) const
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        indices_.erase(std::remove_if(indices_.begin(), indices_.end(),
                                      [](const std::weak_ptr<EdgeIndex> &index) { return index.expired(); }),
                       indices_.end());
        for (const std::weak_ptr<EdgeIndex> &index : indices_)
            if (std::shared_ptr<EdgeIndex> known = index.lock();
                known && pieces.empty() && !known->hasPieces() && known->reach() == reach)
                return known;
        auto made = std::make_shared<EdgeIndex>(obstacles_, reach, pieces);
        indices_.push_back(made);
        return made;
    }

    void IndexedObstacles::update(const GridUpdate &update)
    {
        const std::vector<std::size_t> changed = obstacles_.update(update);
        if (changed.empty())
            return;
        field_.update(obstacles_, changed);
        const std::lock_guard<std::mutex> lock(mutex_);
        for (const std::weak_ptr<EdgeIndex> &index : indices_)
            if (const std::shared_ptr<EdgeIndex> live = index.lock())
                live->update(changed);
        ++version_;
    }
}  // namespace parking
