#include "benchmarks/paper/run/PaperRunJson.h"

#include <cmath>

namespace parking
{
    namespace
    {
        using nlohmann::json;

        constexpr double DEGREES = 180.0 / PI;
        constexpr double MS = 1e3;
        constexpr double CUSP = 0.75 * PI;  // radians; who turns more comes back

        /** To a tenth of a millimetre and the like: figures for people and plots. */
        double rounded(double value)
        {
            return std::round(value * 1e4) / 1e4;
        }

        json pointsJson(const std::vector<Eigen::Vector2d> &points)
        {
            json list = json::array();
            for (const Eigen::Vector2d &point : points)
                list.push_back({rounded(point.x()), rounded(point.y())});
            return list;
        }

        /** Of the way to the manoeuvre: how much of it would the body, heading where it goes, stand in an obstacle? */
        double collidingShare(const PaperTask &task, const PaperRun &run)
        {
            std::size_t colliding = 0, looked = 0;
            double driven = 0.0;
            for (std::size_t i = 1; i < run.curve.size() && driven < run.approachLength; ++i)
            {
                const Eigen::Vector2d way = run.curve[i] - run.curve[i - 1];
                driven += way.norm();
                ++looked;
                colliding += !task.isBodyFree({run.curve[i].x(), run.curve[i].y(), std::atan2(way.y(), way.x())});
            }
            return looked > 0 ? static_cast<double>(colliding) / static_cast<double>(looked) : 0.0;
        }

        json driveJson(const PaperDriveResult &drive, bool lines)
        {
            json text{{"stands", drive.stands},
                      {"travel_time_s", rounded(drive.travelTime)},
                      {"mean_abs_acceleration", drive.meanAcceleration},
                      {"mean_abs_steering_deg", drive.meanSteering * DEGREES},
                      {"final_position_error_m", rounded(drive.positionError)},
                      {"final_yaw_error_deg", rounded(drive.headingError * DEGREES)},
                      {"max_deviation_m", rounded(drive.greatestDeviation)},
                      {"colliding_share", drive.collidingShare},
                      {"solver_failures", drive.failures}};
            if (!lines)
                return text;
            text["states"] = json::array();
            for (const PaperDriveState &state : drive.states)
                text["states"].push_back({rounded(state.time), rounded(state.pose.x), rounded(state.pose.y),
                                          rounded(state.pose.yaw), rounded(state.speed), rounded(state.acceleration),
                                          rounded(state.steering)});
            return text;
        }
    }  // namespace

    json paperRunJson(const std::string &scenario, const std::string &algorithm, const PaperTask &task,
                      const PaperRun &run, bool lines)
    {
        json text{{"scenario", scenario},
                  {"algorithm", algorithm},
                  {"status", run.status},
                  {"reason", run.reason},
                  {"manoeuvres", task.manoeuvres().size()},
                  {"map_loading_time_ms", MS * run.loadingTime},
                  {"planning_time_ms", MS * run.planningTime},
                  {"expanded", run.statistics.expanded},
                  {"open_list_operations", run.statistics.openListOperations},
                  {"open_list_comparisons", run.statistics.openListComparisons},
                  {"positions_checked", run.counts.positions},
                  {"cells_looked_at", run.counts.cells}};
        if (!run.curve.empty())
        {
            text["approach_m"] = rounded(run.approachLength);
            text["arrival_turn_deg"] = rounded(run.arrivalTurn * DEGREES);
            text["length_m"] = rounded(lengthOf(run.curve));
            text["turning_deg"] = rounded(turningOf(run.curve, CUSP) * DEGREES);
            text["approach_colliding_share"] = collidingShare(task, run);
            text["goal"] = {rounded(run.goal.x), rounded(run.goal.y), rounded(run.goal.yaw)};
            text["parking_start"] = {rounded(run.parkingStart.x), rounded(run.parkingStart.y),
                                     rounded(run.parkingStart.yaw)};
            if (lines)
            {
                text["corners"] = pointsJson(run.corners);
                text["curve"] = pointsJson(run.curve);
            }
        }
        if (run.driven)
            text["drive"] = driveJson(run.drive, lines);
        return text;
    }
}  // namespace parking
