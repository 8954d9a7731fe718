// Drives that meet trouble: many, each with its seed. The table of docs/reliability.md comes from here.

#include "benchmarks/studies/DriveStudy.h"
#include "benchmarks/studies/reliability/TroubledDrives.h"
#include "parking_geometry/text/Text.h"

#include <array>
#include <iostream>
#include <string>
#include <vector>

namespace
{
    using namespace parking;

    struct Row
    {
        std::size_t drives{0}, parked{0}, stoppedFree{0}, appeared{0}, avoidable{0}, avoidableHit{0}, inevitableHit{0},
            otherHit{0}, otherInevitable{0}, rolling{0}, broken{0};
        double impact{0.0}, fastest{0.0};
        double time{0.0};  // seconds, of those that parked

        void add(const TroubledDrive &drive)
        {
            const bool hit = drive.hitAppeared || drive.hitOther;
            ++drives;
            parked += drive.status == ParkingStatus::Parked && !hit ? 1 : 0;
            time += drive.status == ParkingStatus::Parked && !hit ? drive.duration : 0.0;
            stoppedFree += drive.status != ParkingStatus::Parked && !hit && drive.stands ? 1 : 0;
            appeared += drive.appeared ? 1 : 0;
            avoidable += drive.appeared && drive.avoidable ? 1 : 0;
            avoidableHit += drive.hitAppeared && drive.avoidable ? 1 : 0;
            inevitableHit += drive.hitAppeared && !drive.avoidable ? 1 : 0;
            otherHit += drive.hitOther && drive.otherAvoidable ? 1 : 0;
            otherInevitable += drive.hitOther && !drive.otherAvoidable ? 1 : 0;
            rolling += drive.stands ? 0 : 1;
            broken += drive.brokenLimit.empty() ? 0 : 1;
            if (drive.hitAppeared && !drive.avoidable)
                impact = std::max(impact, drive.impactSpeed);
            fastest = std::max(fastest, drive.fastest);
        }

        /** Is all that is promised kept? */
        bool good() const
        {
            return avoidableHit == 0 && otherHit == 0 && rolling == 0 && broken == 0;
        }
    };

    std::string tableOf(const std::array<Row, TROUBLES> &rows)
    {
        MarkdownTable table({"trouble", "drives", "parked", "stopped, touching nothing", "an obstacle appeared",
                             "could be avoided", "and was hit", "could not", "and was hit", "at most, m/s",
                             "anything else was hit", "likewise, not avoidable", "rolls at the end",
                             "commands beyond a limit", "s to park, in the mean"});
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            const Row &row = rows[i];
            std::vector<std::string> cells{toString(static_cast<Trouble>(i))};
            for (const std::size_t count : {row.drives, row.parked, row.stoppedFree, row.appeared, row.avoidable,
                                            row.avoidableHit, row.appeared - row.avoidable, row.inevitableHit})
                cells.push_back(std::to_string(count));
            cells.push_back(formatNumber(row.impact, 1));
            for (const std::size_t count : {row.otherHit, row.otherInevitable, row.rolling, row.broken})
                cells.push_back(std::to_string(count));
            cells.push_back(row.parked > 0 ? formatNumber(row.time / static_cast<double>(row.parked), 1) : "");
            table.add(cells);
        }
        return table.text();
    }

    int run(const std::vector<std::string> &arguments)
    {
        DriveStudy study("troubled_drives", "Parks in every scenario by turns, with trouble of every kind by turns.");
        auto add = study.options().add_options();
        add("drives", oneValue("N"), "how many in all (default 1000)");
        add("first", oneValue("N"), "the first of them, which is its seed (default 0)");
        add("verbose", "a line for each drive");
        add("events", "what happened on each drive that is told of");
        const std::optional<CommandLine> line = study.read(arguments);
        if (!line)
            return 0;
        const std::vector<Scenario> scenarios = DriveStudy::scenarios(*line);
        const ParkingParameters parameters = DriveStudy::parameters(*line);
        const std::size_t drives = line->whole("drives", 1, 1000000).value_or(1000);
        const std::size_t first = line->whole("first", 0, 1000000000).value_or(0);
        std::array<Row, TROUBLES> rows;
        for (std::size_t i = first; i < first + drives; ++i)
        {
            const Scenario &scenario = scenarios[(i / TROUBLES) % scenarios.size()];
            const TroubledDrive drive = driveInTrouble(scenario, static_cast<Trouble>(i % TROUBLES), i, parameters);
            Row one;
            one.add(drive);
            rows[i % TROUBLES].add(drive);
            if (line->given("verbose") || !one.good())
                std::cerr << scenario.name << ", " << toString(drive.trouble) << ", drive " << i << ": "
                          << toString(drive.status) << (drive.hitAppeared ? ", hit what appeared" : "")
                          << (drive.appeared && !drive.avoidable ? " (not avoidable)" : "")
                          << (drive.hitOther ? ", hit something else" : "")
                          << (drive.hitOther && !drive.otherAvoidable ? " (not avoidable)" : "")
                          << (drive.stands ? "" : ", rolls") << ", " << formatNumber(drive.impactSpeed) << " m/s "
                          << drive.brokenLimit << " (" << drive.message << ")" << std::endl;
            if ((line->given("verbose") || !one.good()) && line->given("events"))
                for (const std::string &event : drive.events)
                    std::cerr << "    " << event << std::endl;
        }
        std::cout << tableOf(rows);
        return std::all_of(rows.begin(), rows.end(), [](const Row &row) { return row.good(); }) ? 0 : 1;
    }
}  // namespace

int main(int argc, char **argv)
{
    return parking::runProgram("troubled_drives", argc, argv, run);
}
