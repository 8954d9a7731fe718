#pragma once

#include "automatic_parking/perception/Perception.h"
#include "parking_geometry/Scenario.h"

#include <memory>

namespace parking
{
    /** \brief Layout of a perceived map. */
    struct PerceptionParameters
    {
        double cellSize{0.1};          ///< side of the map's cells in metres
        bool unseenIsOccupied{false};  ///< whether ground that has not been seen counts as an obstacle
        /** Metres. Plans expect seen obstacles to continue so far on unseen ground, if a plan exists that can do so
           (see ExtendedObstacles). Without effect if unseen ground is occupied. */
        double obstacleExtension{1.0};

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };

    /** \brief The world as a car perceives it while it moves: a scenario whose only obstacles are those of a map of
        seen cells.

        The map covers the bounds of a true scenario: cells of fixed size, in the frame of its grid if it has one. At
        the beginning all cells are unknown, except for those that the car touches at its start, which are free. Frames
        of a Perception change the map:

            PerceivedWorld seen(scenario, sensor, parameters);
            ParkingWorld world(seen.scenario(), {}, IndexedObstacles::LOCAL_REACH);
            world.update(seen.observe(time, car));  // each period
    */
    class PerceivedWorld
    {
    public:
        /** \brief A world of which only the car's own ground has been seen.

            \param truth supplies car, start, goals, slot, bounds and coordinates; its obstacles are not used
            Throws parking::Error for invalid parameters, without a perception, and for bounds of less than one or more
            than 2^31 cells. */
        PerceivedWorld(const Scenario &truth, std::shared_ptr<Perception> perception,
                       const PerceptionParameters &parameters = {});

        /** \brief The scenario as perceived so far, in the coordinates of the true one. */
        const Scenario &scenario() const
        {
            return scenario_;
        }

        /** \brief The map as perceived so far. */
        const OccupancyGrid &map() const
        {
            return *scenario_.grid;
        }

        /** \brief Takes over a sensor frame.

            Throws parking::Error, and changes nothing, if the time is not finite or runs backwards, if the pose is not
            finite, if the perception reports a cell outside of the map, and for any exception of the perception.

            \param time seconds, not before that of the previous call
            \param car pose of the car, in the coordinates of the scenario
            \return the cells whose occupancy has changed, each once, valid until the next call */
        const GridUpdate &observe(double time, const Pose &car);

    private:
        Scenario scenario_;
        std::shared_ptr<Perception> perception_;
        double time_;
        GridUpdate changes_;
    };
}  // namespace parking
