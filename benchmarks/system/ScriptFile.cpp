#include "benchmarks/system/ScriptFile.h"

#include <filesystem>
#include <system_error>

namespace fs = std::filesystem;

namespace parking
{
    std::string findScript(const std::string &name)
    {
        std::error_code ignored;
        const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
        for (const fs::path &folder :
             {program.parent_path() / PARKING_SCRIPTS_FROM_PROGRAM, fs::path(PARKING_SCRIPTS_IN_SOURCE)})
            if (fs::is_regular_file(folder / name, ignored))
                return (folder / name).lexically_normal().string();
        return "";
    }
}  // namespace parking
