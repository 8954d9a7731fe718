#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"

#include <algorithm>
#include <cstddef>

namespace parking::search
{
    /** \brief A world as a car sees it that must keep some clearance everywhere, instead of paying for coming nearer.

        Free is what MotionEnvironment::clearLengths() knows to be clear: in a world that knows of nothing, nothing. */
    class RoomyEnvironment final : public MotionEnvironment
    {
    public:
        /** \brief \param world must outlive this one \param clearance metres, positive */
        RoomyEnvironment(MotionEnvironment &world, double clearance) : world_(world), clearance_(clearance)
        {
        }

        bool isFree(const Pose &pose) override
        {
            return world_.keeps(pose, clearance_) && world_.isFree(pose);
        }

        bool isPassable(const Pose &pose) override
        {
            return world_.keeps(pose, clearance_) && world_.isPassable(pose);
        }

        double clearance(const Pose &pose) override
        {
            return world_.clearance(pose);
        }

        bool keeps(const Pose &pose, double clearance) override
        {
            return world_.keeps(pose, clearance);
        }

        double freeLength(const Pose &from, double curvature, double length) override
        {
            const Arc arc{curvature, length};
            double free = 0.0;
            freeLengths(from, &arc, 1, &free);
            return free;
        }

        void freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double *free) override
        {
            world_.clearLengths(from, arcs, count, clearance_, free);
        }

        void clearLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                          double *clear) override
        {
            world_.clearLengths(from, arcs, count, clearance, clear);
        }

        void freeLengthsBeyond(const Pose & /*from*/, const Arc * /*arcs*/, std::size_t count, const double *clear,
                               double *free) override
        {
            std::copy(clear, clear + count, free);
        }

        bool isMotionFree(const Pose & /*from*/, const Pose & /*to*/) override
        {
            return false;  // cars do not ask
        }

        Pose turnedRound(const Pose &pose) const override
        {
            return world_.turnedRound(pose);
        }

        Box bounds() const override
        {
            return world_.bounds();
        }

        double roomAt(double x, double y) override
        {
            return world_.roomAt(x, y) - clearance_;
        }

        double closeRoomAt(double x, double y) override
        {
            return world_.closeRoomAt(x, y) - clearance_;
        }

        bool wasInterrupted() const override
        {
            return world_.wasInterrupted();
        }

        bool headingMatters() const override
        {
            return world_.headingMatters();
        }

        bool acceptPath(const Path &path) override
        {
            return world_.acceptPath(path);
        }

    private:
        MotionEnvironment &world_;
        double clearance_;
    };
}  // namespace parking::search
