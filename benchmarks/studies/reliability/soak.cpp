// Plans in random worlds for hours, on several threads: does memory grow, does anything take long, is anything wrong?

#include "benchmarks/studies/reliability/SoakWorker.h"
#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

#include <ompl/util/Console.h>

namespace
{
    using namespace parking;
    namespace po = boost::program_options;
    using Clock = std::chrono::steady_clock;

    /** MB of memory that this process has in use; 0 where nobody says. */
    double memoryInUse()
    {
        std::ifstream stream("/proc/self/statm");
        double all = 0.0, resident = 0.0;
        stream >> all >> resident;
        return stream ? resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6 : 0.0;
    }

    double seconds(Clock::time_point begin)
    {
        return std::chrono::duration<double>(Clock::now() - begin).count();
    }

    std::string line(const SoakFigures &figures, double time, double memory)
    {
        char text[400];
        std::snprintf(
            text, sizeof text,
            "%7.0f s  %10llu queries (%.1f %% solved), %llu worlds, replanned %llu, repeated %llu, put to the oracle "
            "%llu, "
            "others %llu (%llu refused) | "
            "%.2f ms median, %.1f ms 99 %%, %.1f ms 99.9 %% | %.0f MB | %llu disagreements",
            time, static_cast<unsigned long long>(figures.queries),
            100.0 * static_cast<double>(figures.solved) / std::max(1.0, static_cast<double>(figures.queries)),
            static_cast<unsigned long long>(figures.worlds), static_cast<unsigned long long>(figures.replanned),
            static_cast<unsigned long long>(figures.repeated), static_cast<unsigned long long>(figures.seenByOracle),
            static_cast<unsigned long long>(figures.byOthers), static_cast<unsigned long long>(figures.refusedOfOthers),
            1e3 * figures.planning.quantile(0.5), 1e3 * figures.planning.quantile(0.99),
            1e3 * figures.planning.quantile(0.999), memory, static_cast<unsigned long long>(figures.disagreed));
        return text;
    }

    int run(const std::vector<std::string> &arguments)
    {
        po::options_description options("Options");
        auto add = options.add_options();
        add("minutes", oneValue("N"), "for so long (default 60)");
        add("queries", oneValue("N"), "or until so many were asked");
        add("threads", oneValue("N"), "(default: one per core)");
        add("seed", oneValue("N"), "of the worlds (default 1)");
        add("small", "small worlds and nothing but plan(): as many queries as can be");
        add("growth", oneValue("MB"), "memory that may be taken after the first tenth of the time (default 200)");
        add("every", oneValue("S"), "seconds between two lines (default 60)");
        add("help", "this text");
        const CommandLine given(arguments, options, {});
        if (given.given("help"))
        {
            std::cout
                << "usage: soak [options]\n\nPlans in random worlds and has every answer judged by the referee.\n\n"
                << options << "\nStatus: 0 all is well, 1 an answer is wrong or memory has grown, 2 wrong usage\n";
            return 0;
        }
        ompl::msg::noOutputHandler();
        SoakSettings settings;
        settings.small = given.given("small");
        settings.perWorld = settings.small ? 200 : 40;
        settings.most = given.whole("queries", 1, std::numeric_limits<std::uint32_t>::max()).value_or(0);
        const double limit = 60.0 * given.positive("minutes").value_or(settings.most > 0 ? 1e9 : 60.0);
        const double mayGrow = given.positive("growth").value_or(200.0);
        const double every = given.positive("every").value_or(60.0);
        const std::size_t threads =
            given.whole("threads", 1, 1024).value_or(std::max(1U, std::thread::hardware_concurrency()));
        const std::uint64_t seed = given.whole("seed", 1, 1000000000).value_or(1);

        std::atomic<std::uint64_t> queries{0};
        std::atomic<bool> stop{false};
        std::vector<std::unique_ptr<SoakWorker>> workers;
        for (std::size_t i = 0; i < threads; ++i)
            workers.push_back(std::make_unique<SoakWorker>(settings, 1000 * seed + i, queries));
        const Clock::time_point begin = Clock::now();
        std::vector<std::thread> running;
        running.reserve(threads);
        for (const std::unique_ptr<SoakWorker> &worker : workers)
            running.emplace_back([&worker, &stop] { worker->work(stop); });

        const auto all = [&workers]
        {
            SoakFigures sum;
            for (const std::unique_ptr<SoakWorker> &worker : workers)
                sum += worker->figures();
            return sum;
        };
        double settled = 0.0, most = 0.0, said = 0.0;
        for (double now = 0.0; now < limit && (settings.most == 0 || queries < settings.most); now = seconds(begin))
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            const double memory = memoryInUse();
            most = std::max(most, memory);
            const bool begins = settings.most > 0 ? queries < settings.most / 10 : now < 0.1 * limit;
            if (begins)
                settled = std::max(settled, memory);
            if (now - said >= every)
            {
                said = now;
                std::cerr << line(all(), now, memory) << std::endl;
            }
        }
        stop = true;
        for (std::thread &each : running)
            each.join();
        const SoakFigures figures = all();
        std::cout << line(figures, seconds(begin), memoryInUse()) << "\n";
        std::printf("memory: %.0f MB at most in the first tenth, %.0f MB at most in all; %zu threads\n", settled, most,
                    threads);
        for (const std::string &each : figures.disagreements)
            std::cout << each << "\n";
        const bool grown = most > settled + mayGrow;
        if (grown)
            std::cout << "memory has grown by more than " << mayGrow << " MB\n";
        return figures.disagreed > 0 || grown ? 1 : 0;
    }
}  // namespace

int main(int argc, char **argv)
{
    return parking::runProgram("soak", argc, argv, run);
}
