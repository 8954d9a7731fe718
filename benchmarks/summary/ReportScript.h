#pragma once

#include <string>

namespace parking
{
    /** \brief Writes FOLDER/report.html from the database in the folder, by the script make_report.

        \return the report's file; empty, with a line on standard error, if python3 or packages of the script are
        missing. Throws parking::Error with the script's last line when it fails. */
    std::string makeReport(const std::string &folder);
}  // namespace parking
