#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2.

#include <geometry_msgs/msg/pose_stamped.hpp>
#include <mutex>
#include <string>
#include <vector>

namespace nav2_costmap_2d
{
    class Costmap2D
    {
    public:
        using mutex_t = std::recursive_mutex;

        Costmap2D(unsigned int columns, unsigned int rows, double resolution, double originX, double originY)
          : columns_(columns),
            rows_(rows),
            resolution_(resolution),
            originX_(originX),
            originY_(originY),
            costs_(columns * rows, 0)
        {
        }

        unsigned int getSizeInCellsX() const
        {
            return columns_;
        }
        unsigned int getSizeInCellsY() const
        {
            return rows_;
        }
        double getResolution() const
        {
            return resolution_;
        }
        double getOriginX() const
        {
            return originX_;
        }
        double getOriginY() const
        {
            return originY_;
        }
        unsigned char *getCharMap() const
        {
            return const_cast<unsigned char *>(costs_.data());
        }
        void setCost(unsigned int column, unsigned int row, unsigned char cost)
        {
            costs_[row * columns_ + column] = cost;
        }
        mutex_t *getMutex()
        {
            return &mutex_;
        }

    private:
        unsigned int columns_, rows_;
        double resolution_, originX_, originY_;
        std::vector<unsigned char> costs_;
        mutex_t mutex_;
    };

    class Costmap2DROS
    {
    public:
        explicit Costmap2DROS(Costmap2D &costmap) : costmap_(costmap)
        {
        }

        Costmap2D *getCostmap()
        {
            return &costmap_;
        }
        std::vector<geometry_msgs::msg::Point> getRobotFootprint() const
        {
            return footprint;
        }
        std::string getGlobalFrameID() const
        {
            return "map";
        }

        std::vector<geometry_msgs::msg::Point> footprint;

    private:
        Costmap2D &costmap_;
    };
}  // namespace nav2_costmap_2d
