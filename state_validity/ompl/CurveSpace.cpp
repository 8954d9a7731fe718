#include "state_validity/ompl/CurveSpace.h"

#include "state_validity/ompl/OmplCompatibility.h"
#include "state_validity/ompl/OmplPose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/util/Exception.h>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        /** Length above that of every curve, which OMPL uses for "no curve". */
        constexpr double NO_CURVE = 1e100;
        constexpr double SHORTEST_PIECE = 1e-7;  // metres

        template <class Space>
        auto shortest(const Space &space, const ob::State *from, const ob::State *to)
        {
            return ompl_compatibility::shortestCurve(space, from, to, 0);
        }

        /** Adds a piece whose length is given for radius 1; \e side is 1 to the left, -1 to the right, 0 straight. */
        void add(ReedsSheppCurve &curve, double side, double length, double radius)
        {
            if (length == 0.0)
                return;
            curve.pieces[curve.count++] = {side / radius, length * radius};
        }

        /** The result of \e ask for states at two poses. */
        template <class Ask>
        auto withStates(const ob::StateSpace &space, const Pose &from, const Pose &to, const Ask &ask)
        {
            const auto release = [&space](ob::State *state)
            {
                space.freeState(state);
            };
            using Owned = std::unique_ptr<ob::State, decltype(release)>;
            const Owned first(space.allocState(), release), second(space.allocState(), release);
            setPose(first.get(), from);
            setPose(second.get(), to);
            return ask(first.get(), second.get());
        }

        /** Two states at one position with different headings. The length of their curve for radius 1 is a constant. */
        template <class Length>
        double recoverRadius(const ob::StateSpace &space, const Length &lengthForUnitRadius)
        {
            return withStates(space, {}, {0.0, 0.0, 0.5 * PI},
                              [&](const ob::State *from, const ob::State *to)
                              { return space.distance(from, to) / lengthForUnitRadius(from, to); });
        }
    }  // namespace

    CurveSpace::CurveSpace(const ob::StateSpace &space) : space_(&space)
    {
        if (const auto *reedsShepp = dynamic_cast<const ob::ReedsSheppStateSpace *>(&space))
        {
            kind_ = SpaceKind::ReedsShepp;
            turningRadius_ = recoverRadius(*reedsShepp, [reedsShepp](const ob::State *from, const ob::State *to)
                                           { return shortest(*reedsShepp, from, to).length(); });
        }
        else if (const auto *dubins = dynamic_cast<const ob::DubinsStateSpace *>(&space))
        {
            kind_ = SpaceKind::Dubins;
            symmetric_ = dubins->hasSymmetricInterpolate();
            turningRadius_ =
                recoverRadius(*dubins,
                              [dubins, this](const ob::State *from, const ob::State *to)
                              {
                                  const double there = shortest(*dubins, from, to).length();
                                  return symmetric_ ? std::min(there, shortest(*dubins, to, from).length()) : there;
                              });
        }
        else
            requirePlanarSpace(space);
        if (kind_ != SpaceKind::SE2 && !(turningRadius_ > 0.0 && std::isfinite(turningRadius_)))
            throw ompl::Exception("turning radius of space '" + space.getName() +
                                  "' must be a positive number of metres, not " + std::to_string(turningRadius_));
    }

    void CurveSpace::curve(const Pose &from, const Pose &to, ReedsSheppCurve &curve) const
    {
        withStates(*space_, from, to,
                   [&](const ob::State *first, const ob::State *second) { this->curve(first, second, curve); });
    }

    void CurveSpace::curve(const ob::State *from, const ob::State *to, ReedsSheppCurve &curve) const
    {
        curve.count = 0;
        curve.length = std::numeric_limits<double>::infinity();
        if (kind_ == SpaceKind::ReedsShepp)
        {
            using Space = ob::ReedsSheppStateSpace;
            const auto path = shortest(*static_cast<const Space *>(space_), from, to);
            if (!(path.length() < NO_CURVE))
                return;
            for (std::size_t i = 0; i < 5; ++i)
            {
                const auto kind = ompl_compatibility::pieceKind(path.type_, i);
                if (kind == Space::RS_NOP)
                    break;
                add(curve,
                    kind == Space::RS_LEFT    ? 1.0
                    : kind == Space::RS_RIGHT ? -1.0
                                              : 0.0,
                    path.length_[i], turningRadius_);
            }
            curve.length = path.length() * turningRadius_;
        }
        else if (kind_ == SpaceKind::Dubins)
        {
            using Space = ob::DubinsStateSpace;
            const Space &space = *static_cast<const Space *>(space_);
            auto path = shortest(space, from, to);
            bool reverse = false;
            if (symmetric_)
            {
                const auto back = shortest(space, to, from);
                if (back.length() < path.length())
                {
                    path = back;
                    reverse = true;
                }
            }
            if (!(path.length() < NO_CURVE))
                return;
            for (std::size_t i = 0; i < 3; ++i)
            {
                const std::size_t piece = reverse ? 2 - i : i;
                const auto kind = ompl_compatibility::pieceKind(path.type_, piece);
                add(curve,
                    kind == Space::DUBINS_LEFT    ? 1.0
                    : kind == Space::DUBINS_RIGHT ? -1.0
                                                  : 0.0,
                    reverse ? -path.length_[piece] : path.length_[piece], turningRadius_);
            }
            curve.length = path.length() * turningRadius_;
        }
        else
            throw ompl::Exception("a plain SE2 space has no curves: its states are joined by straight lines");
    }

    void CurveSpace::append(const ob::State *from, const ob::State *to, Path &path) const
    {
        ReedsSheppCurve between;
        curve(from, to, between);
        for (std::size_t i = 0; i < between.count; ++i)
            if (std::abs(between.pieces[i].length) >= SHORTEST_PIECE)
                path.append(between.pieces[i]);
    }
}  // namespace parking
