#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace parking_test
{
    /** \brief The problems in a folder that have a solution, by the extension of their files and in order; none when
        there is no such folder. Maps that lie beside them are left out. */
    inline std::vector<std::string> solvableProblems(const std::string &folder, const std::string &extension)
    {
        std::vector<std::string> files;
        if (std::filesystem::is_directory(folder))
            for (const auto &entry : std::filesystem::directory_iterator(folder))
                if (const std::string stem = entry.path().stem().string(); entry.path().extension() == extension &&
                                                                           stem.find("_map") == std::string::npos &&
                                                                           stem != "unreachable")
                    files.push_back(entry.path().string());
        std::sort(files.begin(), files.end());
        return files;
    }
}  // namespace parking_test
