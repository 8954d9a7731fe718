#include "benchmarks/formats/HopeScenes.h"

#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/MakeScenario.h"
#include "parking_geometry/referee/FreeSpace.h"
#include "parking_geometry/text/NearestName.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace parking
{
    namespace
    {
        using parking_test::Random;

        constexpr double LEAST_GAP = 0.1;      // metres: MIN_DIST_TO_OBST
        constexpr double TILT = PI / 36.0;     // radians, standard deviation of parked cars' headings,
        constexpr double MOST_TILT = PI / 12;  // and the most of it
        constexpr double CAR_CHANCE = 0.7;     // of each further place beside the slot
        constexpr double WALL_CHANCE = 0.2;    // that a wall is all there is across the aisle
        constexpr double SPREAD = 0.5;         // metres by which corners of loose obstacles are moved
        constexpr int TRIALS = 100000;

        /** What a level is made of, in metres. */
        struct Level
        {
            const char *name;
            double leastRoom, mostRoom;  ///< along a parallel slot, beyond the car's length
            double leastSide, mostSide;  ///< across a bay, beyond its width; 0: no bays
            double parallelAisle, bayAisle;
            int obstacles;
        };

        Vehicle hopeCar()
        {
            Vehicle car;
            car.name = "hope";
            car.rearOverhang = 0.93;
            car.width = 1.94;
            return car;
        }

        const std::vector<Level> &levels()
        {
            static const double LENGTH = hopeCar().length();
            static const std::vector<Level> all{{"normal", 0.25 * LENGTH, 0.25 * LENGTH + 0.5, 0.85, 1.2, 4.5, 7.0, 3},
                                                {"complex", 0.9, 0.25 * LENGTH, 0.4, 0.85, 4.0, 6.0, 5},
                                                {"extreme", 0.6, 0.9, 0.0, 0.0, 3.5, 0.0, 8}};
            return all;
        }

        /** Normally distributed (the sum of twelve even ones), cut off. */
        double normal(Random &random, double mean, double deviation, double low, double high)
        {
            double sum = -6.0;
            for (int i = 0; i < 12; ++i)
                sum += random.between(0.0, 1.0);
            return std::clamp(mean + deviation * sum, low, high);
        }

        Polygon bodyAt(const Vehicle &car, const Pose &pose)
        {
            const auto corners = car.footprint(pose);
            return {corners.begin(), corners.end()};
        }

        Polygon block(double minX, double minY, double maxX, double maxY)
        {
            return {{minX, minY}, {maxX, minY}, {maxX, maxY}, {minX, maxY}};
        }

        double top(const Polygon &polygon)
        {
            double most = polygon.front().y();
            for (const Eigen::Vector2d &corner : polygon)
                most = std::max(most, corner.y());
            return most;
        }

        /** Metres between the car at \e pose and the obstacles. */
        double gap(const Vehicle &car, const Pose &pose, const std::vector<Polygon> &obstacles)
        {
            Scenario scenario;
            scenario.vehicle = car;
            scenario.polygons = obstacles;
            scenario.bounds = {{-200.0, -200.0}, {200.0, 200.0}};
            return FreeSpace(scenario).clearance(pose, 50.0);
        }

        /** The pose at which the car faces the other way over the same ground. */
        Pose turnedRound(const Vehicle &car, const Pose &pose)
        {
            const double way = 2.0 * car.centreOffset();
            return {pose.x + way * std::cos(pose.yaw), pose.y + way * std::sin(pose.yaw), wrapAngle(pose.yaw + PI)};
        }

        /** A slot on y = 0 and what is beside it, before anything is known of its room. */
        class SlotScene
        {
        public:
            SlotScene(const Level &level, bool bay, Random &random)
              : level_(level),
                bay_(bay),
                random_(random),
                size_(bay ? car_.width : car_.length()),
                half_(bay ? 15.0 : 18.0),
                least_(bay ? level.leastSide : level.leastRoom),
                most_(bay ? level.mostSide : level.mostRoom)
            {
            }

            /** One trial; nothing where HOPE would draw again. */
            std::optional<Scenario> draw()
            {
                goal_ = standing(0.0);
                std::vector<Polygon> left, right;
                fill(left, -1.0);
                fill(right, 1.0);
                const double leftGap = gap(car_, goal_, {left.front()}), rightGap = gap(car_, goal_, {right.front()});
                if (leftGap < LEAST_GAP || rightGap < LEAST_GAP || leftGap + rightGap < least_ ||
                    leftGap + rightGap > most_)
                    return std::nullopt;
                std::vector<Polygon> obstacles{block(-half_, -1.0, half_, 0.0)};
                obstacles.insert(obstacles.end(), left.begin(), left.end());
                obstacles.insert(obstacles.end(), right.begin(), right.end());
                double edge = 0.0;
                for (const Polygon &obstacle : obstacles)
                    edge = std::max(edge, top(obstacle));
                edge += LEAST_GAP;
                const double aisle = bay_ ? level_.bayAisle : level_.parallelAisle;
                addFarSide(obstacles, edge + aisle);
                if (gap(car_, goal_, obstacles) <= 0.0)
                    return std::nullopt;
                Scenario scenario;
                scenario.vehicle = car_;
                scenario.polygons = std::move(obstacles);
                scenario.start = startIn(scenario.polygons, edge, aisle);
                // Parallel: the car is not asked to turn round.
                scenario.goals = {!bay_ && std::cos(scenario.start.yaw) < 0.0 ? turnedRound(car_, goal_) : goal_};
                return scenario;
            }

        private:
            /** A parked car round \e x, its end or side 0.1 to 0.9 m from the kerb. */
            Pose standing(double x)
            {
                Pose pose{x, 0.0, (bay_ ? 0.5 * PI : 0.0) + normal(random_, 0.0, TILT, -MOST_TILT, MOST_TILT)};
                double low = 0.0;
                for (const Eigen::Vector2d &corner : bodyAt(car_, pose))
                    low = std::min(low, corner.y());
                pose.y = normal(random_, 0.5, 0.2, LEAST_GAP, 0.9) - low;
                return pose;
            }

            /** What stands on one side: a row of cars, or a block. */
            void fill(std::vector<Polygon> &obstacles, double side)
            {
                const double nearest = random_.between(0.2 * least_, 0.8 * most_);
                if (random_.chance(0.5))
                {
                    const Polygon body = bodyAt(car_, goal_);
                    double end = 0.0;
                    for (const Eigen::Vector2d &corner : body)
                        end = std::max(end, side * corner.x());
                    const double depth = top(body) + random_.between(-0.3, 0.3);
                    // Its front leans by up to 15 degrees either way.
                    const double lean = std::tan(normal(random_, 0.0, TILT, -MOST_TILT, MOST_TILT)) * depth;
                    const double x0 = side * (end + nearest), x1 = side * (end + nearest + std::abs(lean));
                    obstacles.push_back({{lean > 0.0 ? x0 : x1, 0.0},
                                         {lean > 0.0 ? x1 : x0, depth},
                                         {side * half_, depth},
                                         {side * half_, 0.0}});
                    return;
                }
                double x = side * (size_ + nearest);
                obstacles.push_back(bodyAt(car_, standing(x)));
                for (int i = 0; i < (bay_ ? 3 : 2); ++i)
                {
                    x += side * (size_ + LEAST_GAP + random_.between(0.2 * least_, 0.8 * most_));
                    if (random_.chance(CAR_CHANCE))
                        obstacles.push_back(bodyAt(car_, standing(x)));
                }
            }

            void addFarSide(std::vector<Polygon> &obstacles, double y)
            {
                if (random_.chance(WALL_CHANCE))
                {
                    obstacles.push_back(block(-half_, y + LEAST_GAP, half_, y + LEAST_GAP + 0.1));
                    return;
                }
                for (int i = 0; i < level_.obstacles; ++i)
                {
                    Polygon loose = bodyAt(car_, {random_.between(2.0 - half_, half_ - 2.0),
                                                  random_.between(y + 2.0, y + 6.0), random_.between(-PI, PI)});
                    bool beyond = true;
                    for (Eigen::Vector2d &corner : loose)
                    {
                        corner += Eigen::Vector2d(random_.between(0.0, SPREAD), random_.between(0.0, SPREAD));
                        beyond = beyond && corner.y() > y && corner.y() < y + 8.0;
                    }
                    if (beyond)
                        obstacles.push_back(std::move(loose));
                }
            }

            Pose startIn(const std::vector<Polygon> &obstacles, double edge, double aisle)
            {
                std::vector<Polygon> all = obstacles;
                all.push_back(bodyAt(car_, goal_));
                for (int trial = 0; trial < TRIALS; ++trial)
                {
                    const Pose pose{random_.between(-0.5 * half_, 0.5 * half_),
                                    random_.between(edge + 1.0, edge + aisle - 1.0),
                                    wrapAngle(normal(random_, 0.0, PI / 6.0, -0.5 * PI, 0.5 * PI) +
                                              (random_.chance(0.5) ? PI : 0.0))};
                    if (gap(car_, pose, all) > 0.0)
                        return pose;
                }
                throw Error("HOPE: no room for a start was found");
            }

            const Vehicle car_ = hopeCar();
            const Level &level_;
            bool bay_;
            Random &random_;
            double size_, half_, least_, most_;
            Pose goal_;
        };

        Scenario lot(Random &random)
        {
            // Four double rows of fifty bays a side, between aisles of 7 m.
            constexpr double WIDTH = 2.8, DEPTH = 6.5, AISLE = 7.0;
            constexpr int BAYS = 50, ROWS = 8;
            const Vehicle car = hopeCar();
            const auto standing = [&](int row, int bay)
            {
                const double up = row % 2 == 0 ? -1.0 : 1.0;  // to its aisle
                const double middle = AISLE + (row / 2) * (2.0 * DEPTH + AISLE) + (row % 2 == 0 ? 0.5 : 1.5) * DEPTH;
                const double yaw = up * 0.5 * PI + normal(random, 0.0, 0.02, -0.06, 0.06);
                const double x = (bay + 0.5) * WIDTH + normal(random, 0.0, 0.08, -0.2, 0.2);
                return Pose{x - car.centreOffset() * std::cos(yaw), middle - car.centreOffset() * std::sin(yaw), yaw};
            };
            Scenario scenario;
            scenario.vehicle = car;
            const int goalRow = random.below(ROWS), goalBay = random.below(BAYS);
            const Pose goal = standing(goalRow, goalBay);
            scenario.goals = {random.chance(0.5) ? goal : turnedRound(car, goal)};
            for (int row = 0; row < ROWS; ++row)
                for (int bay = 0; bay < BAYS; ++bay)
                    if ((row != goalRow || bay != goalBay) && random.chance(CAR_CHANCE))
                        scenario.polygons.push_back(bodyAt(car, standing(row, bay)));
            const double height = 4.0 * (2.0 * DEPTH + AISLE) + AISLE;
            for (const Polygon &wall :
                 {block(-1.0, -1.0, BAYS * WIDTH + 1.0, 0.0), block(-1.0, height, BAYS * WIDTH + 1.0, height + 1.0)})
                scenario.polygons.push_back(wall);
            for (int trial = 0; trial < TRIALS; ++trial)
            {
                const int aisle = random.below(5);
                const Pose start{goal.x + random.between(-30.0, 30.0),
                                 aisle * (2.0 * DEPTH + AISLE) + random.between(2.0, AISLE - 2.0),
                                 normal(random, 0.0, 0.1, -0.3, 0.3) + (random.chance(0.5) ? PI : 0.0)};
                if (std::abs(start.y - goal.y) <= 30.0 && gap(car, start, scenario.polygons) > 0.3)
                {
                    scenario.start = {start.x, start.y, wrapAngle(start.yaw)};
                    return scenario;
                }
            }
            throw Error("HOPE: no room for a start was found");
        }
    }  // namespace

    std::vector<std::string> hopeLevels()
    {
        std::vector<std::string> names;
        for (const Level &level : levels())
            names.emplace_back(level.name);
        names.emplace_back("dlp");
        return names;
    }

    Scenario hopeScene(const std::string &level, std::uint64_t seed)
    {
        Random random(seed);
        std::optional<Scenario> scenario;
        if (level == "dlp")
            scenario = lot(random);
        for (const Level &each : levels())
            if (level == each.name)
            {
                const bool bay = each.mostSide > 0.0 && random.chance(0.5);
                SlotScene scene(each, bay, random);
                for (int trial = 0; trial < TRIALS && !scenario; ++trial)
                    scenario = scene.draw();
            }
        if (!scenario)
            throw Error(unknownName("level of HOPE", level, hopeLevels()));
        scenario->name = "hope_" + level + "_" + std::to_string(seed);
        return makeScenario(std::move(*scenario), scenario->name);
    }
}  // namespace parking
