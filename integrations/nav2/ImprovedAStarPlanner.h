#pragma once

#include "integrations/nav2/Nav2Compatibility.h"
#include "integrations/nav2/Nav2Settings.h"
#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Pose.h"
#include "state_validity/FootprintChecker.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace parking
{
    /** \brief The improved A* as a global planner of nav2: for cars, forwards and in reverse.

        A plan is of poses of the rear axle, and the costmap's `robot_base_frame` has to be there, too. Its obstacles
       are the lethal cells of the costmap; inflation is not looked at, since the exact footprint is swept along all
       motions. Where the car drives in reverse the poses still look where its front does.

        Parameters are those of Nav2Settings, read for each plan. Failures are nav2's own exceptions. Compiled
        against stub headers and not yet tried on a robot. */
    class ImprovedAStarPlanner : public nav2_core::GlobalPlanner
    {
    public:
        /** \brief A pose with the frame that it is given in. */
        using PoseStamped = geometry_msgs::msg::PoseStamped;

        // No function says override: which of the three createPlan() the base class has depends on the release, and
        // compilers that see it said of some warn of the others.

        /** \brief Declares the parameters. Throws parking::Error naming one whose value is not allowed. */
        void configure(const nav2_compatibility::Node::WeakPtr &parent, std::string name,
                       std::shared_ptr<tf2_ros::Buffer> tf, std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap);

        /** \brief Forgets the costmap. */
        void cleanup();

        /** \brief Nothing is to be done. */
        void activate();

        /** \brief Nothing is to be done. */
        void deactivate();

        /** \brief Humble: a plan from \e start to \e goal. Throws nav2's exceptions, see createPlan() of later ones. */
        nav_msgs::msg::Path createPlan(const PoseStamped &start, const PoseStamped &goal);

        /** \brief Jazzy: \e cancelled is asked now and then.

            Throws StartOutsideMapBounds, GoalOutsideMapBounds, StartOccupied, GoalOccupied, PlannerTFError (a pose in
            another frame than the costmap), PlannerTimedOut, PlannerCancelled and NoValidPathCouldBeFound with the
            reason. Where nav2 has only one exception (humble), that one. */
        nav_msgs::msg::Path createPlan(const PoseStamped &start, const PoseStamped &goal,
                                       std::function<bool()> cancelled);

        /** \brief Later: by way of \e viaPoints, each of which is reached as exactly as a goal. */
        nav_msgs::msg::Path createPlan(const PoseStamped &start, const PoseStamped &goal,
                                       const std::vector<PoseStamped> &viaPoints, std::function<bool()> cancelled);

    private:
        /** What is asked of all parts of a plan. */
        struct Query;

        OccupancyGrid copyOfCostmap(const Nav2Settings &settings) const;
        Path planLeg(const Query &query, const Pose &from, const Pose &to, bool isLast) const;
        Pose poseOf(const PoseStamped &stamped) const;

        nav2_compatibility::Node::WeakPtr node_;
        std::string name_;
        std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_;
    };
}  // namespace parking
