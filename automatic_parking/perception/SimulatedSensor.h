#pragma once

#include "automatic_parking/perception/Perception.h"
#include "parking_geometry/Polygon.h"
#include "parking_geometry/Scenario.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <vector>

namespace parking
{
    /** \brief Parameters of a simulated range sensor. */
    struct SensorParameters
    {
        double range{20.0};            ///< largest distance that the sensor sees, metres
        double fieldOfView{2.0 * PI};  ///< angle of the seen sector in radians, symmetric about the sensor's heading
        Pose mount{1.4, 0.0, 0.0};     ///< pose of the sensor relative to the rear axle's midpoint
        double rate{20.0};             ///< frames per second
        double rangeNoise{0.0};        ///< standard deviation of measured distances, metres
        std::uint64_t seed{1};         ///< of the noise

        /** \brief Throws parking::Error naming the first field out of its range. */
        void validate() const;
    };

    /** \brief An obstacle that exists during a part of the drive. */
    struct TimedObstacle
    {
        Polygon outline;                                             ///< in the coordinates of the scenario, metres
        double appears{0.0};                                         ///< seconds
        double disappears{std::numeric_limits<double>::infinity()};  ///< seconds; it exists before this time
    };

    /** \brief A range sensor that sees a true world by ray casting.

        From the sensor, rays cross the cells of the map until they meet an obstacle or the end of the range. The gap
        between two rays is at most the side of a cell. The cells that a ray crosses are seen: occupied if an obstacle
        touches them, otherwise free. Cells behind obstacles stay as they are. So the occupied cells cover every
        obstacle where it has been seen, and a free cell contains no part of an obstacle.

        Noise changes the measured distance at which a ray ends. A ray that ends too early adds an occupied cell in
       front of the obstacle, one that ends too late a cell behind it. Later frames correct the former. Noise never
       makes a cell free that an obstacle touches.

        Equal inputs give equal frames. */
    class SimulatedSensor : public Perception
    {
    public:
        /** \brief A sensor in the world of \e truth.

            \param truth polygons or grid; of unknown cells, unknownIsOccupied decides
            \param timed further obstacles
            Throws parking::Error for invalid parameters, obstacles and times. */
        explicit SimulatedSensor(const Scenario &truth, const SensorParameters &parameters = {},
                                 const std::vector<TimedObstacle> &timed = {});
        ~SimulatedSensor() override;

        /** \brief The first call sees, and then the first one in each period of the sensor.

            Throws parking::Error if the geometry of \e map differs from that of the first call. */
        GridUpdate observe(double time, const Pose &car, const OccupancyGrid &map) override;

    private:
        class Raster;

        struct Timed
        {
            TimedObstacle obstacle;
            std::vector<Polygon> solids;
            bool exists;  // in the raster
        };

        void prepare(double time, const OccupancyGrid &map);
        double noise();

        SensorParameters parameters_;
        std::vector<Polygon> solids_;  // of the scenario
        std::vector<Timed> timed_;
        std::unique_ptr<Raster> raster_;
        std::mt19937_64 random_;
        std::optional<double> firstTime_;
        double period_{-1.0};  // number of the period of the last frame
    };
}  // namespace parking
