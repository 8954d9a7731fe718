#pragma once

#include <string>

namespace parking
{
    /** \brief Makes FOLDER/report.html from the database in the folder, by the script that comes with the project.

        \return the report's file; empty, with a line on standard error, where python3 or its packages that the script
        needs are not installed. Throws parking::Error with the script's last line when it fails. */
    std::string makeReport(const std::string &folder);
}  // namespace parking
