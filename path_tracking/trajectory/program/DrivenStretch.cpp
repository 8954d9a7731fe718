#include "path_tracking/trajectory/program/DrivenStretch.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace parking
{
    namespace
    {
        constexpr double GRID = 0.05;  // metres between two points, about
        constexpr double BEND = 6.0;   // metres over which a stretch is bent to another end
        constexpr double LEVER = 1.5;  // metres that a radian counts for when poses are compared
        constexpr std::size_t FEWEST_POINTS = 3;

        using Points = std::vector<GuessPoint>;

        double distance(const Pose &a, const Pose &b)
        {
            return positionDistance(a, b) + LEVER * std::abs(a.yaw - b.yaw);
        }

        double lengthOf(const Points &points)
        {
            double length = 0.0;
            for (std::size_t i = 1; i < points.size(); ++i)
                length += positionDistance(points[i - 1].pose, points[i].pose);
            return length;
        }

        Pose mean(const Pose &a, const Pose &b)
        {
            return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.yaw + b.yaw)};
        }

        /** Of those that leave a stretch between \e first and \e last, the point nearest to \e pose. */
        std::size_t nearest(const Points &points, std::size_t first, std::size_t last, const Pose &pose)
        {
            const auto least = std::min_element(points.begin() + static_cast<std::ptrdiff_t>(first),
                                                points.begin() + static_cast<std::ptrdiff_t>(last),
                                                [&pose](const GuessPoint &a, const GuessPoint &b)
                                                { return distance(a.pose, pose) < distance(b.pose, pose); });
            return static_cast<std::size_t>(least - points.begin());
        }

        /** Cuts the end off where that is nearest to \e pose. */
        void cutTowards(Points &points, const Pose &pose)
        {
            if (points.size() > FEWEST_POINTS)
                points.resize(nearest(points, FEWEST_POINTS - 1, points.size(), pose) + 1);
        }

        /** Shifts the last metres so that they end at \e pose. */
        void bendTowards(Points &points, const Pose &pose)
        {
            const Pose end = points.back().pose;
            const double bend = std::min(BEND, lengthOf(points));
            double left = 0.0;
            for (std::size_t i = points.size(); i-- > 0;)
            {
                Pose &at = points[i].pose;
                const double u = bend > 0.0 ? std::max(0.0, 1.0 - left / bend) : 1.0;
                const double part = i + 1 == points.size() ? 1.0 : u * u * (3.0 - 2.0 * u);
                if (i > 0)
                    left += positionDistance(points[i - 1].pose, at);
                at = {at.x + part * (pose.x - end.x), at.y + part * (pose.y - end.y),
                      at.yaw + part * (pose.yaw - end.yaw)};
            }
        }

        Points reversed(Points points)
        {
            std::reverse(points.begin(), points.end());
            return points;
        }
    }  // namespace

    std::vector<DrivenStretch> stretchesOf(const MotionProblem &problem)
    {
        std::vector<DrivenStretch> stretches;
        for (std::size_t k = 0; k < problem.directions.size(); ++k)
        {
            if (problem.directions[k] == 0)
                continue;
            const NodeVector &from = problem.nodes[k], &to = problem.nodes[k + 1];
            const auto at = [&](double part)
            {
                return GuessPoint{0.0, problem.poseAt(k, part), 0.0,
                                  from[NODE_STEERING] + part * (to[NODE_STEERING] - from[NODE_STEERING])};
            };
            if (k == 0 || problem.directions[k - 1] == 0)
                stretches.push_back({problem.directions[k], {at(0.0)}, 0.0});
            const double way = from[NODE_DURATION] * 0.5 * (from[NODE_SPEED] + to[NODE_SPEED]);
            const double parts = std::max(1.0, std::ceil(way / GRID));
            for (double p = 1.0; p <= parts; p += 1.0)
                stretches.back().points.push_back(at(p / parts));
            stretches.back().length += way;
        }
        return stretches;
    }

    std::vector<DrivenStretch> withoutStretch(const std::vector<DrivenStretch> &stretches, std::size_t index)
    {
        if (stretches.size() < 2)
            return {};
        std::vector<DrivenStretch> rest = stretches;
        const auto removed = rest.begin() + static_cast<std::ptrdiff_t>(index);
        const Points &points = stretches[index].points;
        if (index == 0)
        {
            Points backwards = reversed(std::next(removed)->points);
            cutTowards(backwards, points.front().pose);
            bendTowards(backwards, points.front().pose);
            std::next(removed)->points = reversed(std::move(backwards));
            rest.erase(removed);
        }
        else if (index + 1 == stretches.size())
        {
            Points &before = std::prev(removed)->points;
            cutTowards(before, points.back().pose);
            bendTowards(before, points.back().pose);
            rest.pop_back();
        }
        else
        {
            const Pose middle = points[points.size() / 2].pose;
            Points &before = std::prev(removed)->points;
            Points behind = reversed(std::next(removed)->points);
            cutTowards(before, middle);
            cutTowards(behind, middle);
            const Pose meeting = mean(before.back().pose, behind.back().pose);
            bendTowards(before, meeting);
            bendTowards(behind, meeting);
            before.insert(before.end(), behind.rbegin() + 1, behind.rend());
            rest.erase(removed, removed + 2);
        }
        for (DrivenStretch &stretch : rest)
            stretch.length = lengthOf(stretch.points);
        return rest;
    }

    std::vector<StretchGuess> guessesAlong(const std::vector<DrivenStretch> &stretches, const Vehicle &vehicle)
    {
        std::vector<StretchGuess> guesses;
        guesses.reserve(stretches.size());
        for (const DrivenStretch &stretch : stretches)
            guesses.emplace_back(stretch.direction, stretch.points, vehicle);
        return guesses;
    }
}  // namespace parking
