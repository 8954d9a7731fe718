#pragma once

#include <string>
#include <vector>

namespace parking
{
    /** \brief Has the script that comes with the project make FOLDER/report.html of a comparison's results.

        \param runs files of runs that the results were made of
        \return the report's file; empty when there is no such script or no python3. Throws parking::Error with the
        script's last line when it fails. */
    std::string makeReport(const std::string &folder, const std::vector<std::string> &runs);
}  // namespace parking
