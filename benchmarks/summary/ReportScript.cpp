#include "benchmarks/summary/ReportScript.h"

#include "benchmarks/system/Subprocess.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <filesystem>
#include <iostream>
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

    std::string makeReport(const std::string &folder)
    {
        constexpr int PACKAGES_MISSING = 3;
        const std::string report = (fs::path(folder) / "report.html").string();
        const auto withoutReport = [&report](const std::string &reason)
        {
            std::cerr << "parking_benchmark: " << report << ": is not made: " << reason << std::endl;
            return std::string();
        };
        const std::string script = findScript();
        if (script.empty())
            return withoutReport("the script make_report is not installed");
        if (!isProgram("python3"))
            return withoutReport("python3 is not installed");
        const ProcessResult result = runProcess({"python3", script, folder});
        if (result.status == PACKAGES_MISSING)
            return withoutReport(lastLine(result.errors));
        if (result.status != 0)
            throw Error(report + ": cannot be made: " + lastLine(result.errors));
        return report;
    }
}  // namespace parking
