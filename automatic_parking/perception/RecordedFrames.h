#pragma once

#include "automatic_parking/perception/Perception.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief An occupancy map of one moment, for example from readSurroundOcc(). */
    struct RecordedFrame
    {
        double time{0.0};  ///< seconds
        OccupancyGrid
            grid;  ///< cells, unknown where nothing has been seen; its origin in the coordinates of the scenario
    };

    /** \brief Frames of a recording in a row.

        A cell of the map becomes occupied if it overlaps an occupied cell of the frame. It becomes free if it overlaps
        free cells only. Otherwise it stays as it is. For a rotated frame the box about the map's cell counts. */
    class RecordedFrames : public Perception
    {
    public:
        /** \brief Throws parking::Error if a time is not finite, the times do not increase, or a grid has no cells. */
        explicit RecordedFrames(std::vector<RecordedFrame> frames);

        /** \brief The changes by all frames up to \e time that no earlier call has returned. */
        GridUpdate observe(double time, const Pose &car, const OccupancyGrid &map) override;

    private:
        std::vector<RecordedFrame> frames_;
        std::size_t next_{0};
    };
}  // namespace parking
