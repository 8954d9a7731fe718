#include "benchmarks/summary/ReportScript.h"

#include "benchmarks/system/Isolation.h"
#include "benchmarks/system/ScriptFile.h"
#include "parking_geometry/Error.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>

#include <unistd.h>

namespace fs = std::filesystem;

namespace parking
{
    std::string makeReport(const std::string &folder)
    {
        constexpr int PACKAGES_MISSING = 3;
        const std::string report = (fs::path(folder) / "report.html").string();
        const auto withoutReport = [&report](const std::string &reason)
        {
            std::cerr << "parking_benchmark: " << report << ": is not written: " << reason << std::endl;
            return std::string();
        };
        const std::string script = findScript("report/make_report");
        if (script.empty())
            return withoutReport("the script make_report is not installed");
        constexpr double PATIENT = std::numeric_limits<double>::infinity();
        const std::atomic<bool> neverStops{false};
        // A process that ends with this one: it must not write while its successor writes the same file.
        const IsolatedResult result = runIsolated(
            [&](const std::function<void()> & /*halfDone*/) -> std::string
            {
                execlp("python3", "python3", script.c_str(), folder.c_str(), nullptr);
                throw Error("python3 is not installed");
            },
            {PATIENT, PATIENT, 0.0}, neverStops);
        if (result.end == IsolatedResult::End::Exception)
            return withoutReport(result.text);
        if (result.status == PACKAGES_MISSING)
            return withoutReport(result.errors);
        if (result.status != 0)
            throw Error(report + ": cannot be created: " + (result.errors.empty() ? result.text : result.errors));
        return report;
    }
}  // namespace parking
