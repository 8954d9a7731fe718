#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/sweeps/Escape.h"

#include <optional>
#include <vector>

namespace parking::search
{
    /** \brief A motion at an end of a path that the search does not choose: an escape, a straight, or none. */
    struct EndMotion
    {
        Pose pose;                     ///< the requested start or goal
        Pose root;                     ///< the pose at which the search starts or ends
        Arc arc;                       ///< from the start to the root, or from the root to the goal; length 0: none
        std::optional<Escape> escape;  ///< set if the motion is an escape
    };

    /** \brief The requested starts or goals of a query and their end motions. */
    class PathEnds
    {
    public:
        /** \brief Discards all ends. */
        void clear()
        {
            motions_.clear();
        }

        /** \brief Adds the end of an escape as a start. */
        void add(const Escape &escape);

        /** \brief Adds a free pose, with straights of up to \e straight metres before or behind it.

            A straight that an obstacle cuts ends \e clearance metres before it. If the straights ahead and behind
            differ, only the longer one is kept.
            \param isGoal whether paths end at the pose; otherwise they start there
            \param forwardOnly whether the car cannot reverse
            \return the poses that the search must reach */
        std::vector<Pose> add(const Pose &pose, double straight, double clearance, bool isGoal, bool forwardOnly,
                              MotionEnvironment &environment);

        /** \brief All end motions in the order of their addition. */
        const std::vector<EndMotion> &motions() const
        {
            return motions_;
        }

        /** \brief The end motion whose root is nearest to \e pose; nullptr without ends. */
        const EndMotion *at(const Pose &pose) const;

        /** \brief Length in metres of the shortest end motion; 0 without ends. */
        double minLength() const;

    private:
        std::vector<EndMotion> motions_;
    };
}  // namespace parking::search
