#pragma once

#include "integrations/nav2/Nav2Compatibility.h"
#include "integrations/nav2/Nav2Settings.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Pose.h"
#include "state_validity/FootprintChecker.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace parking
{
    /** \brief The improved A* as a global planner of nav2, for cars that drive forwards and in reverse.

        A plan consists of poses of the rear axle; the costmap's `robot_base_frame` must be there, too. Obstacles are
        the lethal cells of the costmap. Inflation is ignored, since the exact footprint is swept along all motions. In
        reverse the poses keep the heading of the car.

        Parameters are those of Nav2Settings, read for each plan. Failures are nav2's own exceptions. Compiled against
        stub headers and not tested on a robot. */
    class ImprovedAStarPlanner : public nav2_core::GlobalPlanner
    {
    public:
        /** \brief A pose with its frame. */
        using PoseStamped = geometry_msgs::msg::PoseStamped;

        // No function has override: the release determines which of the three createPlan() the base class has.
        // Compilers that see override on some functions warn about the others.

        /** \brief Declares the parameters. Throws parking::Error naming one with an invalid value. */
        void configure(const nav2_compatibility::Node::WeakPtr &parent, std::string name,
                       std::shared_ptr<tf2_ros::Buffer> tf, std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap);

        /** \brief Releases the costmap. */
        void cleanup();

        /** \brief Does nothing: the planner has no state to activate. */
        void activate();

        /** \brief Does nothing: the planner has no state to deactivate. */
        void deactivate();

        /** \brief Interface of humble: a plan from \e start to \e goal. Throws nav2's exceptions, see createPlan() of
            later releases. */
        nav_msgs::msg::Path createPlan(const PoseStamped &start, const PoseStamped &goal);

        /** \brief Interface of jazzy: \e cancelled is polled during planning.

            Throws StartOutsideMapBounds, GoalOutsideMapBounds, StartOccupied, GoalOccupied, PlannerTFError (a pose in
            another frame than the costmap), PlannerTimedOut, PlannerCancelled and NoValidPathCouldBeFound with the
            reason. Humble has a single exception, which replaces them. */
        nav_msgs::msg::Path createPlan(const PoseStamped &start, const PoseStamped &goal,
                                       std::function<bool()> cancelled);

        /** \brief Interface of later releases: a plan through \e viaPoints, each reached as exactly as a goal. */
        nav_msgs::msg::Path createPlan(const PoseStamped &start, const PoseStamped &goal,
                                       const std::vector<PoseStamped> &viaPoints, std::function<bool()> cancelled);

    private:
        /** Common inputs of all parts of a plan. */
        struct Query;

        void setFootprint(Vehicle &vehicle) const;
        OccupancyGrid copyOfCostmap(const Nav2Settings &settings) const;
        Path planLeg(const Query &query, const Pose &from, const Pose &to, bool isLast) const;
        search::PlanResult planAttempt(const Query &query, const Pose &from, const std::vector<Pose> &goals,
                                       bool approximate, std::chrono::steady_clock::time_point end) const;
        Pose poseOf(const PoseStamped &stamped) const;

        nav2_compatibility::Node::WeakPtr node_;
        std::string name_;
        std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_;
    };
}  // namespace parking
