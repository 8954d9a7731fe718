// parking_queries: writes random parking problems; equal seeds give equal problems.

#include "benchmarks/queries/Queries.h"
#include "benchmarks/system/CommandLine.h"
#include "benchmarks/system/Counted.h"
#include "benchmarks/worlds/MadeWorlds.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/Text.h"
#include "parking_geometry/text/WriteFile.h"

#include <boost/program_options/positional_options.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;
namespace po = boost::program_options;

namespace
{
    using namespace parking;
    using parking_test::Random;
    using parking_test::seedOf;

    constexpr int DONE = 0;
    constexpr double WIDEST_MARGIN = 5.0;  // metres

    struct Options
    {
        std::string output, seed{"1"}, vehicle;
        std::vector<std::string> kinds, folders;
        std::size_t worlds{2}, queries{8};
        double margin{0.0};
    };

    po::options_description describe()
    {
        po::options_description options("Options");
        auto add = options.add_options();
        add("output", oneValue("DIR"), "folder to write; it must not contain queries");
        add("seed", oneValue("TEXT"), "any word or number (default 1)");
        add("kind", manyValues("NAME"), "use only worlds of this kind; repeatable (default: every kind)");
        add("from", manyValues("DIR|FILE"),
            "use the worlds of this folder or file instead: maps or scenarios of parking_plan; repeatable");
        add("worlds", oneValue("N"), "number of worlds of each kind (default 2)");
        add("queries", oneValue("N"),
            "number of queries in each world (default 8); every second goal is pushed to an obstacle");
        add("margin", oneValue("M"), "minimum clearance in metres of start and goal on all sides (default 0)");
        add("vehicle", oneValue("NAME|FILE"),
            "the car (default: a scenario's own, TPCAP's on maps, otherwise a random one)");
        add("help", "print this text");
        return options;
    }

    std::string help()
    {
        std::ostringstream text;
        text << "usage: parking_queries --output DIR [options]\n\n"
                "Writes random parking problems: worlds with pairs of a free start and a free goal. DIR "
                "receives\n"
                "a scenario for each, and index.json with their properties. Equal seeds give equal files.\n\n"
                "Examples, run at the root of the project:\n"
                "  parking_queries --output queries --seed 7\n"
                "  parking_queries --output garages --from benchmarks/scenarios --queries 4\n\n"
             << describe() << '\n'
             << wrapped("Kinds:", parking_test::worldKinds()) << "\nStatus: 0 written, 2 invalid input or usage\n";
        return text.str();
    }

    std::vector<QueryWorld> worldsFor(const Options &options)
    {
        std::vector<QueryWorld> worlds;
        for (const std::string &folder : options.folders)
            for (QueryWorld &world : worldsOf(folder, options.vehicle))
                worlds.push_back(std::move(world));
        const std::vector<std::string> names = vehicleNames();
        for (const std::string &kind : options.kinds)
            for (std::size_t i = 1; i <= options.worlds; ++i)
            {
                const std::string name = kind + "_" + std::to_string(i), seed = options.seed + " " + name;
                const Vehicle car = !options.vehicle.empty()
                                        ? readVehicle(options.vehicle)
                                        : vehicleByName(names[seedOf(seed + " car") % names.size()]);
                worlds.push_back(queryWorld(name, parking_test::madeWorld(kind, seed), car));
            }
        std::set<std::string> known;
        for (const QueryWorld &world : worlds)
            if (!known.insert(world.name).second)
                throw Error("two worlds have the name " + inQuotes(world.name) + "; use one folder at a time");
        return worlds;
    }

    /** Files of a folder that is written completely or not at all: the destructor removes them unless keep() was
        called. */
    class NewFiles
    {
    public:
        explicit NewFiles(const std::string &folder) : folder_(folder)
        {
            makeFolder(folder_);
        }
        NewFiles(const NewFiles &) = delete;
        NewFiles &operator=(const NewFiles &) = delete;
        ~NewFiles()
        {
            std::error_code ignored;
            while (!made_.empty())  // A folder after its contents; it stays if others have added files.
            {
                fs::remove(made_.back(), ignored);
                made_.pop_back();
            }
        }

        void write(const fs::path &name, const std::string &content)
        {
            const fs::path file = folder_ / name;
            makeFolder(file.parent_path());
            if (std::error_code ignored; fs::exists(file, ignored))
                throw Error(inQuotes(file.string()) +
                            " exists already: choose another folder, or worlds of other names");
            writeFileAtomically(file.string(), content);
            made_.push_back(file);
        }

        void keep()
        {
            made_.clear();
        }

    private:
        void makeFolder(const fs::path &folder)
        {
            std::vector<fs::path> missing;
            std::error_code failed;
            for (fs::path each = folder; !each.empty() && !fs::exists(each, failed); each = each.parent_path())
                missing.insert(missing.begin(), each);
            fs::create_directories(folder, failed);
            if (failed)
                throw Error(inQuotes(folder.string()) + ": cannot be created: " + failed.message());
            made_.insert(made_.end(), missing.begin(), missing.end());
        }

        fs::path folder_;
        std::vector<fs::path> made_;  // in order of creation
    };

    int writeQueries(const std::vector<std::string> &arguments)
    {
        const CommandLine line(arguments, describe(), po::positional_options_description());
        if (line.given("help"))
        {
            std::cout << help();
            return DONE;
        }
        Options options;
        if (!line.given("output"))
            throw Error("no --output DIR given (see --help)");
        options.output = *line.outputFile("output");
        options.seed = line.text("seed").value_or(options.seed);
        options.vehicle = line.name("vehicle").value_or("");
        options.folders = line.texts("from");
        options.kinds = line.texts("kind");
        if (options.kinds.empty() && options.folders.empty())
            options.kinds = parking_test::worldKinds();
        options.worlds = line.whole("worlds", 1, 10000).value_or(options.worlds);
        options.queries = line.whole("queries", 1, 100000).value_or(options.queries);
        options.margin = line.between("margin", 0.0, WIDEST_MARGIN, "m").value_or(options.margin);
        const fs::path folder(options.output);
        std::error_code failed;
        if (fs::exists(folder / "index.json", failed))
            throw Error(inQuotes(options.output) + " contains queries already; choose another folder, or remove it");
        const std::vector<QueryWorld> worlds = worldsFor(options);
        for (const QueryWorld &world : worlds)
            for (const std::string &warning : world.scenario.warnings)
                std::cerr << "parking_queries: " << warning << std::endl;
        NewFiles files(options.output);
        nlohmann::json index{{"format", 1}, {"seed", options.seed}, {"margin", options.margin}};
        index["queries"] = nlohmann::json::array();
        for (const QueryWorld &world : worlds)
        {
            const fs::path map = fs::path("maps") / (world.name + ".yaml");
            if (world.scenario.grid)
            {
                files.write(fs::path("maps") / (world.name + ".pgm"), mapImage(*world.scenario.grid));
                files.write(map, mapYaml(*world.scenario.grid, world.name + ".pgm"));
            }
            Random random(seedOf(options.seed + " " + world.name + " queries"));
            for (std::size_t i = 0; i < options.queries; ++i)
            {
                const std::optional<Query> query = drawQuery(world, random, options.margin, i % 2 == 1);
                if (!query)
                    throw Error("world " + inQuotes(world.name) + ": no free pose found for the car with " +
                                formatNumber(options.margin) + " m on all sides");
                const std::string name = world.name + "_" + std::to_string(i + 1);
                files.write(name + ".yaml", queryText(world, *query, map.string()));
                index["queries"].push_back({{"name", name},
                                            {"world", world.name},
                                            {"vehicle", world.scenario.vehicle.name},
                                            {"start", {query->start.x, query->start.y, query->start.yaw}},
                                            {"goal", {query->goal.x, query->goal.y, query->goal.yaw}},
                                            {"goal_at_obstacle", query->goalAtObstacle}});
            }
        }
        files.write("index.json", index.dump(1) + "\n");
        files.keep();
        std::cout << counted(index["queries"].size(), "query", "queries") << " in " << counted(worlds.size(), "world")
                  << ": " << options.output << "\n";
        return DONE;
    }
}  // namespace

int main(int argc, char **argv)
{
    return parking::runProgram("parking_queries", argc, argv, writeQueries);
}
