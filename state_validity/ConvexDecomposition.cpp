#include "state_validity/ConvexDecomposition.h"

#include "parking_geometry/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace parking
{
    namespace
    {
        using Corners = std::vector<std::size_t>;

        bool isConvex(const Polygon &points, const Corners &corners)
        {
            for (std::size_t i = 0; i < corners.size(); ++i)
                if (turn(points[corners[i]], points[corners[(i + 1) % corners.size()]],
                         points[corners[(i + 2) % corners.size()]]) < 0.0)
                    return false;
            // A spiral has only left turns too, but a convex outline makes exactly one full turn.
            double total = 0.0;
            for (std::size_t i = 0; i < corners.size(); ++i)
            {
                const Eigen::Vector2d in = points[corners[(i + 1) % corners.size()]] - points[corners[i]];
                const Eigen::Vector2d out =
                    points[corners[(i + 2) % corners.size()]] - points[corners[(i + 1) % corners.size()]];
                total += std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
            }
            return total < 7.0;
        }

        std::vector<Corners> clipEars(const Polygon &points)
        {
            Corners left(points.size());
            for (std::size_t i = 0; i < left.size(); ++i)
                left[i] = i;
            std::vector<Corners> triangles;
            while (left.size() > 3)
            {
                const std::size_t count = left.size();
                std::size_t best = count;
                double bestQuality = -1.0;
                for (std::size_t i = 0; i < count; ++i)
                {
                    const Eigen::Vector2d &a = points[left[(i + count - 1) % count]], &b = points[left[i]],
                                          &c = points[left[(i + 1) % count]];
                    const double area = turn(a, b, c);
                    if (area < 0.0)
                        continue;
                    bool empty = true;
                    for (std::size_t k = 0; k + 3 < count && empty; ++k)
                    {
                        const Eigen::Vector2d &p = points[left[(i + 2 + k) % count]];
                        // Only reflex or straight corners can lie in the ear. Corners that coincide with one of the ear
                        // (a polygon touching itself) are ignored.
                        if (p == a || p == b || p == c)
                            continue;
                        empty = !(turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0);
                    }
                    if (!empty)
                        continue;
                    // The ear with the best aspect ratio first, because slivers are unfavourable convex bodies.
                    const double maxSide =
                        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
                    const double quality = maxSide > 0.0 ? area / maxSide : 0.0;
                    if (quality > bestQuality)
                    {
                        bestQuality = quality;
                        best = i;
                    }
                }
                // A simple polygon always has an ear, but rounding may hide it if corners almost coincide. A triangle
                // of negligible area is cut off in this case.
                if (best == count)
                {
                    double smallest = std::numeric_limits<double>::infinity();
                    for (std::size_t i = 0; i < count; ++i)
                    {
                        const double area = std::abs(turn(points[left[(i + count - 1) % count]], points[left[i]],
                                                          points[left[(i + 1) % count]]));
                        if (area < smallest)
                        {
                            smallest = area;
                            best = i;
                        }
                    }
                    bestQuality = 0.0;
                }
                if (bestQuality > 0.0)
                    triangles.push_back({left[(best + count - 1) % count], left[best], left[(best + 1) % count]});
                left.erase(left.begin() + static_cast<long>(best));
            }
            if (left.size() == 3 && turn(points[left[0]], points[left[1]], points[left[2]]) > 0.0)
                triangles.push_back(left);
            return triangles;
        }

        /** The outline of two pieces joined across a diagonal, which leads from \e from to \e to in the first piece. */
        Corners join(const Corners &first, const Corners &second, std::size_t from, std::size_t to)
        {
            Corners joined;
            auto at = std::find(first.begin(), first.end(), to);
            for (std::size_t i = 0; i < first.size(); ++i)
            {
                joined.push_back(*at);
                if (++at == first.end())
                    at = first.begin();
            }
            // `joined` runs from `to` round to `from`; the rest of the second piece lies between `from` and `to`.
            at = std::find(second.begin(), second.end(), from);
            for (std::size_t i = 0; i + 2 < second.size(); ++i)
            {
                if (++at == second.end())
                    at = second.begin();
                joined.push_back(*at);
            }
            return joined;
        }
    }  // namespace

    std::vector<Polygon> convexPieces(const Polygon &polygon)
    {
        if (crossesItself(polygon))
            throw Error("the outline of an obstacle polygon crosses itself; it must be a simple polygon");
        Corners all(polygon.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = i;
        std::vector<Corners> pieces;
        if (isConvex(polygon, all))
            pieces.push_back(all);
        else
            pieces = clipEars(polygon);

        // Each diagonal appears in two pieces, once in each direction.
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> owner;
        const auto claim = [&](std::size_t piece)
        {
            const Corners &corners = pieces[piece];
            for (std::size_t i = 0; i < corners.size(); ++i)
                owner[{corners[i], corners[(i + 1) % corners.size()]}] = piece;
        };
        for (std::size_t i = 0; i < pieces.size(); ++i)
            claim(i);
        bool changed = pieces.size() > 1;
        while (changed)
        {
            changed = false;
            for (std::size_t i = 0; i < pieces.size() && !changed; ++i)
                for (std::size_t k = 0; k < pieces[i].size() && !changed; ++k)
                {
                    const std::size_t from = pieces[i][k], to = pieces[i][(k + 1) % pieces[i].size()];
                    const auto other = owner.find({to, from});
                    if (other == owner.end() || other->second == i)
                        continue;
                    const std::size_t second = other->second;
                    Corners joined = join(pieces[i], pieces[second], from, to);
                    if (!isConvex(polygon, joined))
                        continue;
                    pieces[i] = std::move(joined);
                    pieces[second].clear();
                    owner.erase({from, to});
                    owner.erase({to, from});
                    claim(i);
                    changed = true;
                }
        }
        std::vector<Polygon> result;
        for (const Corners &corners : pieces)
        {
            if (corners.size() < 3)
                continue;
            Polygon piece;
            for (const std::size_t corner : corners)
                piece.push_back(polygon[corner]);
            if (signedArea(piece) > 0.0)
                result.push_back(std::move(piece));
        }
        return result;
    }
}  // namespace parking
