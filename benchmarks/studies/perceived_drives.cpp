// Simulates drives of a car that perceives its world while obstacles appear. Writes tables of docs/results.md.

#include "automatic_parking/AutomaticParking.h"
#include "automatic_parking/perception/ExtendedObstacles.h"
#include "automatic_parking/perception/SimulatedSensor.h"
#include "benchmarks/studies/Surprise.h"
#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace po = boost::program_options;

namespace
{
    using namespace parking;
    using parking_test::PolygonOracle;
    using parking_test::Random;

    constexpr std::size_t MAX_REPLANS = 10;  // obstacles may appear on every way

    /** Values with their percentiles, by nearest rank. */
    struct Sample
    {
        std::vector<double> values;

        double rank(double share)
        {
            if (values.empty())
                return 0.0;
            std::sort(values.begin(), values.end());
            const auto n = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
            return values[std::max<std::size_t>(n, 1) - 1];
        }

        std::string inMilliseconds()
        {
            std::string text;
            for (const double share : {0.5, 0.99, 1.0})
                text += (text.empty() ? "" : " / ") + formatNumber(std::round(1e5 * rank(share)) / 100.0);
            return text;
        }
    };

    /** Whether a plan leaves the one before by more than half a metre, on the way that it has ahead. */
    bool changesMind(const Path &before, const Path &plan)
    {
        constexpr double ELSEWHERE = 0.5, STEP = 0.2;  // metres
        if (plan.pieces.empty() || before.pieces.empty())
            return false;
        const SampledPath old = before.sample(STEP), next = plan.sample(STEP);
        return std::any_of(next.begin(), next.end(),
                           [&old](const PathState &state)
                           {
                               return std::none_of(old.begin(), old.end(),
                                                   [&state](const PathState &other)
                                                   { return positionDistance(other.pose, state.pose) < ELSEWHERE; });
                           });
    }

    std::size_t changesOfMind(const std::vector<TimedPlan> &plans)
    {
        std::size_t count = 0;
        for (std::size_t i = 1; i < plans.size(); ++i)
            count += changesMind(plans[i - 1].path, plans[i].path) ? 1 : 0;
        return count;
    }

    /** The plans of a planner that plans anew at each frame of a drive, from where the car then is. */
    std::vector<TimedPlan> plansOfEachFrame(const Scenario &scenario, const ParkingResult &drive, double extension)
    {
        Scenario seen = scenario;
        seen.polygons.clear();
        seen.unknownIsOccupied = false;
        seen.grid = drive.history.map;
        ExtendedObstacles obstacles(seen, extension);
        ParkingWorld open(seen, {}, IndexedObstacles::LOCAL_REACH);
        Scenario more = seen;
        more.grid = obstacles.map();
        ParkingWorld extended(more, {}, IndexedObstacles::LOCAL_REACH);
        std::vector<TimedPlan> plans;
        std::size_t at = 0;
        for (const SeenFrame &frame : drive.history.frames)
        {
            open.update(frame.changes);
            extended.update(obstacles.update(frame.changes));
            while (at + 1 < drive.trajectory.size() && drive.trajectory[at].t < frame.time)
                ++at;
            const TrajectoryPoint &car = drive.trajectory[at];
            seen.start = {car.x, car.y, car.yaw};
            ParkingPlan plan = ParkingPlanner().plan(seen, extended);
            if (!plan.found)
                plan = ParkingPlanner().plan(seen, open);
            if (plan.found)
                plans.push_back({frame.time, plan.path});
        }
        return plans;
    }

    /** Sums over the drives of one way to react. */
    struct Row
    {
        Row(const std::string &theName, bool judges) : name(theName), isJudged(judges)
        {
        }

        std::string name;
        /** Whether it is known which boxes are avoidable. They appear at a time, when this car may be elsewhere. */
        bool isJudged;
        std::size_t drives{0}, parked{0}, avoidableHits{0}, otherHits{0}, rolling{0}, stops{0}, changes{0};
        Sample ratio, checks, plans;

        void add(const ParkingResult &result, const Scenario &scenario, const Surprise *surprise, bool avoidable,
                 double knownTime)
        {
            ++drives;
            std::optional<Touch> touch;
            if (!result.trajectory.empty())
                touch = firstTouch(result.trajectory, scenario.vehicle, PolygonOracle(scenario), 0.0);
            const bool other = touch.has_value();
            if (!touch && surprise)
                touch = firstTouch(result.trajectory, scenario.vehicle, alone(surprise->obstacle), surprise->time);
            avoidableHits += touch && (other || (isJudged && avoidable)) ? 1 : 0;
            otherHits += touch && !other && !(isJudged && avoidable) ? 1 : 0;
            rolling += !result.trajectory.empty() && result.trajectory.back().v != 0.0 ? 1 : 0;
            changes += changesOfMind(result.history.plans);
            stops += reactionFigures(result).stops;
            for (const Reaction &reaction : result.reactions)
            {
                const double checked = reaction.updateTime + reaction.checkTime;
                checks.values.push_back(checked);
                if (reaction.kind != ReactionKind::Kept && reaction.kind != ReactionKind::Stopped)
                    plans.values.push_back(checked + reaction.planningTime);
            }
            if (!result.parked() || touch)
                return;
            ++parked;
            ratio.values.push_back(result.trajectory.back().t / knownTime);
        }

        std::string text()
        {
            return "| " + name + " | " + std::to_string(drives) + " | " + std::to_string(parked) + " | " +
                   (isJudged ? std::to_string(avoidableHits) : "–") + " | " + std::to_string(otherHits) + " | " +
                   std::to_string(stops) + " | " + std::to_string(plans.values.size()) + " | " +
                   std::to_string(changes) + " | " + formatNumber(ratio.rank(0.5), 3) + " | " +
                   formatNumber(ratio.rank(0.9), 3) + " | " + checks.inMilliseconds() + " | " + plans.inMilliseconds() +
                   " |\n";
        }
    };

    /** One drive of a car with a sensor. */
    ParkingResult perceived(const Scenario &scenario, const ParkingParameters &parameters,
                            const SensorParameters &sensor, const PerceptionParameters &map, const Surprise *surprise)
    {
        std::vector<TimedObstacle> timed;
        if (surprise)
            timed.push_back({surprise->obstacle, surprise->time});
        AutomaticParking parking(parameters);
        parking.setPerception(std::make_shared<SimulatedSensor>(scenario, sensor, timed), map);
        return parking.park(scenario);
    }

    struct Study
    {
        ParkingParameters parameters;
        SensorParameters sensor;
        PerceptionParameters map;
        bool verbose{false}, anew{false};
        Row reacting{"reacts in motion", true}, stopping{"stops to plan", false};
        std::size_t withoutDrive{0}, frames{0}, changesAnew{0};

        void drive(const Scenario &scenario, std::uint64_t seed)
        {
            Random random(seed * 2654435761U + 1);
            parameters.drive.disturbances.seed = random.bits();
            const ParkingResult calm = perceived(scenario, parameters, sensor, map, nullptr);
            const bool meets = calm.parked() && random.chance(0.7);
            const auto surprise = meets ? surpriseFor(scenario, calm.trajectory, random) : std::nullopt;
            const Surprise *appears = surprise ? &*surprise : nullptr;
            Scenario informed = scenario;
            if (surprise)
                informed.polygons.push_back(surprise->obstacle);
            const ParkingResult known = AutomaticParking(parameters).park(informed);
            const double knownTime = known.parked() ? known.trajectory.back().t : 0.0;
            if (knownTime == 0.0)
            {
                ++withoutDrive;
                if (verbose)
                    std::cerr << scenario.name << ", drive " << seed << ": " << known.message << '\n';
                return;
            }
            const double reaction = parameters.drive.tracking.mpc.step + 1.0 / sensor.rate;
            const bool avoidable =
                surprise && isFree(brakingPath(calm.trajectory, scenario.vehicle, parameters.drive.disturbances,
                                               surprise->time, surprise->time + reaction),
                                   scenario.vehicle, alone(surprise->obstacle), SPARE_AT_STOP);
            const ParkingResult result = appears ? perceived(scenario, parameters, sensor, map, appears) : calm;
            ParkingParameters old = parameters;
            old.reactionTime = 0.0;
            const ParkingResult stops = perceived(scenario, old, sensor, map, appears);
            const std::size_t hits = reacting.avoidableHits;
            reacting.add(result, scenario, appears, avoidable, knownTime);
            stopping.add(stops, scenario, appears, avoidable, knownTime);
            if (anew)
            {
                const std::vector<TimedPlan> plans = plansOfEachFrame(scenario, result, map.obstacleExtension);
                frames += plans.size();
                changesAnew += changesOfMind(plans);
            }
            if (!verbose && reacting.avoidableHits == hits)
                return;
            std::cerr << scenario.name << ", drive " << seed << ": " << result.message
                      << " (stopping: " << stops.message << ", known: " << known.message << ' ' << knownTime << " s)"
                      << (avoidable ? ", avoidable" : "") << (reacting.avoidableHits > hits ? ", HIT" : "") << '\n';
            for (const std::string &event : result.events)
                std::cerr << "    " << event << '\n';
            if (surprise)
                std::cerr << "    " << surprise->time << " s: an obstacle appears " << surprise->ahead << " m ahead\n";
        }
    };

    int run(const std::vector<std::string> &arguments)
    {
        po::options_description options("Options");
        auto add = options.add_options();
        add("drives", oneValue("N"), "number of drives (default 100)");
        add("first", oneValue("N"), "number of the first drive, which is its seed (default 0)");
        add("range", oneValue("M"), "range of the sensor in metres (default 20)");
        add("rate", oneValue("HZ"), "frames per second (default 20)");
        add("cell", oneValue("M"), "side of the map's cells in metres (default 0.1)");
        add("closed", "treat ground that has not been seen as an obstacle when planning");
        add("anew", "plan anew at each frame, too, and count how often such plans change");
        add("verbose", "print the events of each drive");
        add("help", "print this text");
        po::options_description all;
        all.add(options).add_options()("scenario", po::value<std::vector<std::string>>());
        const CommandLine line(arguments, all, po::positional_options_description().add("scenario", -1));
        if (line.given("help"))
        {
            std::cout << "usage: perceived_drives SCENARIO... [options]\n\n"
                         "Simulates drives in which the car knows what its sensor has seen, and obstacles appear.\n\n"
                         "Examples, run at the root of the project:\n"
                         "  perceived_drives benchmarks/scenarios/parallel.yaml --drives 20\n"
                         "  perceived_drives benchmarks/scenarios/perpendicular.yaml --drives 1 --first 7 --verbose\n\n"
                      << options;
            return 0;
        }
        if (!line.given("scenario"))
            throw Error("no scenario given (see --help)");
        std::vector<Scenario> scenarios;
        for (const std::string &file : line.texts("scenario"))
        {
            scenarios.push_back(readScenario(file));
            if (scenarios.back().grid)
                throw Error("scenario " + scenarios.back().name + ": obstacles appear in worlds of polygons only");
        }
        Study study;
        study.parameters.maxReplans = MAX_REPLANS;
        study.sensor.range = line.positive("range").value_or(study.sensor.range);
        study.sensor.rate = line.positive("rate").value_or(study.sensor.rate);
        study.map.cellSize = line.positive("cell").value_or(study.map.cellSize);
        study.map.unseenIsOccupied = line.given("closed");
        study.anew = line.given("anew");
        study.verbose = line.given("verbose");
        const std::size_t drives = line.whole("drives", 1, 1000000).value_or(100);
        const std::size_t first = line.whole("first", 0, 1000000000).value_or(0);
        for (std::size_t i = first; i < first + drives; ++i)
            study.drive(scenarios[i % scenarios.size()], i);
        std::cout
            << "| car | drives | parked | avoidable hits | other hits | stops | new motions | changes of mind | time, "
               "median | 90 % | "
               "check, ms | with a new motion, ms |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
            << study.reacting.text() << study.stopping.text()
            << "\nWithout a drive, even in the known world: " << study.withoutDrive << '\n';
        if (study.anew)
            std::cout << "Plans at each frame: " << study.frames << ", changes of mind: " << study.changesAnew << '\n';
        return study.reacting.avoidableHits == 0 && study.reacting.rolling == 0 ? 0 : 1;
    }
}  // namespace

int main(int argc, char **argv)
{
    return parking::runProgram("perceived_drives", argc, argv, run);
}
