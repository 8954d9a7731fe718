#pragma once

#include "parking_geometry/Error.h"

#include <string>
#include <utility>
#include <vector>

namespace parking
{
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
}  // namespace parking
