#include "benchmarks/summary/ReportScript.h"

#include "benchmarks/system/Subprocess.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <filesystem>
#include <system_error>

namespace fs = std::filesystem;

namespace parking
{
    namespace
    {
        /** Beside the installed program, or in the sources that it was built from. */
        std::string findScript()
        {
            std::error_code ignored;
            const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
            for (const fs::path &script :
                 {program.parent_path() / PARKING_REPORT_FROM_PROGRAM, fs::path(PARKING_REPORT_IN_SOURCE)})
                if (fs::is_regular_file(script, ignored))
                    return script.lexically_normal().string();
            return "";
        }
    }  // namespace

    std::string makeReport(const std::string &folder, const std::vector<std::string> &runs)
    {
        const std::string script = findScript();
        if (script.empty() || !isProgram("python3"))
            return "";
        std::vector<std::string> command{"python3", script, folder};
        for (const std::string &file : runs)
            command.insert(command.end(), {"--runs", file});
        const ProcessResult result = runProcess(command);
        const std::string report = (fs::path(folder) / "report.html").string();
        if (result.status != 0)
            throw Error(report + ": cannot be made: " + lastLine(result.errors));
        return report;
    }
}  // namespace parking
