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

    /** \brief An error about settings of a planner or its problem. The caller adds the place where they were set. */
    class SettingError : public Error
    {
    public:
        /** \brief \param settings their names in a .cfg file after the name of the planner: `range`,
            `problem.volume.min.x` */
        SettingError(std::vector<std::string> settings, const std::string &message)
          : Error(message),
            settings_(std::move(settings))
        {
        }

        /** \brief The settings with the error. */
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
        std::string name;     ///< name in lists; unique apart from case, underscores, hyphens and blanks
        std::string summary;  ///< one line for --help
        /** Whether the planner receives an objective and improves paths until the time limit. */
        bool optimizing{false};
        ompl::base::PlannerAllocator allocate;  ///< creates an instance; not empty in a registry
        PlannerSettings settings;               ///< parameters set on every instance before the user's
        std::string library{};                  ///< file of the planner's plug-in; empty for planners of the project
    };

    /** \brief The planners of the comparison by name.

        Names ignore case, underscores, hyphens and blanks, and read * as "star": RRTstar, rrt_star and RRT* are the
        same planner. KPIECE1 and its variants are also found without the digit, SPARStwo as spars2 and
        AnytimePathShortening as aps, as in OMPL.app's files. */
    class PlannerRegistry
    {
    public:
        /** \brief All planners of the project: its own, and those of OMPL that can plan for a car. */
        static PlannerRegistry builtIn();

        /** \brief Adds a planner, for example of a plug-in. Throws parking::Error when its name is taken, empty or
            contains characters other than letters, digits and _ . + -, or when it has no allocator. */
        void add(PlannerEntry entry);

        /** \brief The planner of this name. Throws parking::Error with the nearest and all known names for an unknown
            one. */
        const PlannerEntry &find(const std::string &name) const;

        /** \brief The planner with controls of this name, `control_` before it or not; of others the same as find(). */
        const PlannerEntry &findWithControls(const std::string &name) const;

        /** \brief Names of all planners in the order of their addition. */
        std::vector<std::string> names() const;

        /** \brief All planners in the order of their addition. */
        const std::vector<PlannerEntry> &entries() const
        {
            return entries_;
        }

    private:
        std::vector<PlannerEntry>::const_iterator lookUp(const std::string &name) const;

        std::vector<PlannerEntry> entries_;
    };

    /** \brief Sets parameters of a planner, `parameter_set` first, the others in their order.

        Switches accept true, yes and on for 1, false, no and off for 0.
        Throws SettingError naming parameter and value: with the nearest and all known names for an unknown parameter,
        with the planner's message for a value out of range. */
    void applySettings(ompl::base::Planner &planner, const PlannerSettings &settings);
}  // namespace parking
