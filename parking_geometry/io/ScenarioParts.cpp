#include "parking_geometry/io/ScenarioParts.h"

#include <filesystem>

namespace parking
{
    std::string scenarioName(const std::string &file)
    {
        return std::filesystem::path(file).stem().string();
    }
}  // namespace parking
