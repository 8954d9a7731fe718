#include "automatic_parking/drawing/DriveFigure.h"

#include "parking_geometry/drawing/SvgScenario.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace parking
{
    namespace
    {
        constexpr double DEGREES = 180.0 / PI;
        constexpr double STANDING = 1e-3;   // m/s
        constexpr double ROOM = 1.15;       // of a plot beyond the car's limits
        constexpr double DRAWN_STEP = 0.1;  // metres between the states of a drawn path

        /** Time spans in reverse. */
        std::vector<SvgBand> reverseBands(const Trajectory &driven)
        {
            std::vector<SvgBand> bands;
            bool open = false;
            for (const TrajectoryPoint &point : driven)
            {
                const bool reverse = point.v < -STANDING;
                if (reverse && !open)
                    bands.push_back({point.t, point.t, svg_colour::REVERSE, "reverse"});
                if (open)
                    bands.back().end = point.t;
                open = reverse;
            }
            return bands;
        }

        SvgSeries seriesOf(const Trajectory &trajectory, double TrajectoryPoint::*field, double factor)
        {
            SvgSeries series;
            for (const TrajectoryPoint &point : trajectory)
            {
                series.x.push_back(point.t);
                series.y.push_back(factor * point.*field);
            }
            return series;
        }

        SvgPlot plotOf(const Trajectory &driven, const Trajectory &planned, const char *title, const char *unit,
                       double TrajectoryPoint::*field, double factor, double limit)
        {
            SvgPlot plot;
            plot.title = title;
            plot.xLabel = "time (s)";
            plot.yLabel = unit;
            plot.bands = reverseBands(driven.empty() ? planned : driven);
            plot.limits = {-factor * limit, factor * limit};
            plot.limitsLabel = "limit of the car";
            plot.yRange = {-ROOM * factor * limit, ROOM * factor * limit};
            plot.height = 170.0;
            const auto add = [&](const Trajectory &trajectory, const char *label, const char *colour)
            {
                if (trajectory.empty())
                    return;
                plot.series.push_back(seriesOf(trajectory, field, factor));
                plot.series.back().label = label;
                plot.series.back().colour = colour;
                plot.series.back().dashed = &trajectory != &driven && !driven.empty();
            };
            add(driven, "driven", svg_colour::DRIVEN);
            add(planned, "planned", svg_colour::PLANNED);
            return plot;
        }

        std::vector<Pose> posesOf(const SampledPath &states)
        {
            std::vector<Pose> poses;
            for (const PathState &state : states)
                poses.push_back(state.pose);
            return poses;
        }

        /** States with directions; a standing car keeps its previous direction. */
        SampledPath statesOf(const Trajectory &trajectory)
        {
            SampledPath states;
            const auto moves = [](const TrajectoryPoint &point)
            {
                return std::abs(point.v) > STANDING;
            };
            const auto first = std::find_if(trajectory.begin(), trajectory.end(), moves);
            int direction = first != trajectory.end() && first->v < 0.0 ? -1 : 1;
            double driven = 0.0;
            for (const TrajectoryPoint &point : trajectory)
            {
                if (moves(point))
                    direction = point.v < 0.0 ? -1 : 1;
                if (!states.empty())
                    driven += std::hypot(point.x - states.back().pose.x, point.y - states.back().pose.y);
                states.push_back({{point.x, point.y, point.yaw}, driven, 0.0, direction});
            }
            return states;
        }
    }  // namespace

    std::vector<SvgPlot> drivePlots(const Trajectory &driven, const Vehicle &vehicle, const Trajectory &planned)
    {
        return {plotOf(driven, planned, "Speed", "m/s", &TrajectoryPoint::v, 1.0, vehicle.maxSpeed),
                plotOf(driven, planned, "Acceleration", "m/s\xC2\xB2", &TrajectoryPoint::acceleration, 1.0,
                       vehicle.maxAcceleration),
                plotOf(driven, planned, "Steering angle", "degrees", &TrajectoryPoint::steering, DEGREES,
                       vehicle.maxSteeringAngle)};
    }

    SvgMap driveMap(const Scenario &scenario, const SampledPath &path, const Trajectory &planned,
                    const Trajectory &driven)
    {
        struct Track
        {
            SampledPath states;
            const char *name;           // of the path along which the car is drawn
            const char *beside, *dash;  // of an additional path
        };
        std::vector<Track> tracks{{path, "path", "planned path", "1 4"},
                                  {statesOf(planned), "trajectory", "planned trajectory", "5 3"},
                                  {statesOf(driven), "drive", "", ""}};
        tracks.erase(
            std::remove_if(tracks.begin(), tracks.end(), [](const Track &track) { return track.states.size() < 2; }),
            tracks.end());
        SampledPath seen;
        for (const Track &track : tracks)
            seen.insert(seen.end(), track.states.begin(), track.states.end());
        SvgMap map(viewAround(scenario, seen));
        drawScenario(map, scenario);
        if (tracks.empty())
            return map;
        drawPath(map, tracks.back().states, scenario.vehicle, tracks.back().name);
        tracks.pop_back();
        for (const Track &track : tracks)
            drawTrack(map, posesOf(track.states), svg_colour::PLANNED, track.beside, track.dash);
        return map;
    }

    SvgFigure driveFigure(const Scenario &scenario, const Path &planned, const Trajectory &driven,
                          const std::string &title, const std::string &subtitle)
    {
        SvgFigure figure(title, subtitle);
        figure.setMap(
            driveMap(scenario, planned.pieces.empty() ? SampledPath{} : planned.sample(DRAWN_STEP), {}, driven));
        if (driven.size() > 1)
            for (const SvgPlot &plot : drivePlots(driven, scenario.vehicle))
                figure.addPlot(plot);
        return figure;
    }
}  // namespace parking
