#pragma once

#include "parking_geometry/Error.h"

#include <ompl/base/Planner.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace parking
{
    /** \brief Parameters of a planner in the order given, as name and value. */
    using PlannerSettings = std::vector<std::pair<std::string, std::string>>;

    /** \brief An error about settings of a planner or its problem: whoever knows where these were set can say so. */
    class SettingError : public Error
    {
    public:
        /** \brief \param settings their names, as in a .cfg file behind that of the planner: `range`,
            `problem.volume.min.x` */
        SettingError(std::vector<std::string> settings, const std::string &message)
          : Error(message),
            settings_(std::move(settings))
        {
        }

        /** \brief The settings that it is about. */
        const std::vector<std::string> &settings() const
        {
            return settings_;
        }

    private:
        std::vector<std::string> settings_;
    };

    /** \brief A planner of the comparison. */
    struct PlannerEntry
    {
        std::string name;     ///< as it is listed; unique but for case, underscores, hyphens and blanks
        std::string summary;  ///< one line for --help
        /** Is the planner handed path length as its objective, and goes on improving until the time is up? */
        bool optimizing{false};
        ompl::base::PlannerAllocator allocate;  ///< makes a new instance; never empty in a registry
        PlannerSettings settings;               ///< set on every instance before the user's
        std::string library{};  ///< the file of the plug-in that it is from; empty for planners of the project
    };

    /** \brief The planners of the comparison by name.

        Case, underscores, hyphens and blanks do not matter in names, and * reads as "star": RRTstar, rrt_star and RRT*
        are the same planner. KPIECE1, BKPIECE1 and LBKPIECE1 go without their digit, too, as in OMPL.app's files. */
    class PlannerRegistry
    {
    public:
        /** \brief All planners that come with the project: our own, and those of OMPL that can plan for a car. */
        static PlannerRegistry builtIn();

        /** \brief Adds a planner, for example one of a plug-in. Throws parking::Error when its name is taken, empty, or
            has other characters than letters, digits and _ . + -, or when it has no allocator. */
        void add(PlannerEntry entry);

        /** \brief Throws parking::Error with the nearest and all known names for one that is not known. */
        const PlannerEntry &find(const std::string &name) const;

        /** \brief Of all planners, in the order in which they were added. */
        std::vector<std::string> names() const;

        /** \brief All planners, in the order in which they were added. */
        const std::vector<PlannerEntry> &entries() const
        {
            return entries_;
        }

    private:
        std::vector<PlannerEntry>::const_iterator lookUp(const std::string &name) const;

        std::vector<PlannerEntry> entries_;
    };

    /** \brief Sets parameters of a planner, `parameter_set` first, the others in their order.

        Words stand for numbers where a parameter is a switch: true, yes and on for 1, false, no and off for 0.
        Throws SettingError naming the parameter and the value: with the nearest and all known names for one that is
        not known, with what the planner says for a value out of range. */
    void applySettings(ompl::base::Planner &planner, const PlannerSettings &settings);
}  // namespace parking
