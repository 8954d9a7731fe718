#include "automatic_parking/drawing/DriveFigure.h"

#include "parking_geometry/drawing/SvgScenario.h"

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

        /** When the car drives in reverse. */
        std::vector<SvgBand> reverseBands(const Trajectory &driven)
        {
            std::vector<SvgBand> bands;
            bool open = false;
            for (const TrajectoryPoint &point : driven)
            {
                const bool reverse = point.v < -STANDING;
                if (reverse && !open)
                    bands.push_back({point.t, point.t, svg_colour::REVERSE});
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
            plot.xLabel = "time, s";
            plot.yLabel = unit;
            plot.bands = reverseBands(driven);
            plot.limits = {-factor * limit, factor * limit};
            plot.yRange = {-ROOM * factor * limit, ROOM * factor * limit};
            plot.height = 170.0;
            plot.series.push_back(seriesOf(driven, field, factor));
            plot.series.back().colour = svg_colour::DRIVEN;
            if (planned.empty())
                return plot;
            plot.series.back().label = "driven";
            plot.series.push_back(seriesOf(planned, field, factor));
            plot.series.back().label = "planned";
            plot.series.back().dashed = true;
            return plot;
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

    SvgFigure driveFigure(const Scenario &scenario, const Path &planned, const Trajectory &driven,
                          const std::string &title, const std::string &subtitle)
    {
        SvgFigure figure(title, subtitle);
        const SampledPath states = planned.pieces.empty() ? SampledPath{} : planned.sample(DRAWN_STEP);
        SampledPath seen = states;
        std::vector<Pose> track;
        for (const TrajectoryPoint &point : driven)
        {
            track.push_back({point.x, point.y, point.yaw});
            seen.push_back({track.back(), 0.0, 0.0, 1});
        }
        SvgMap map(viewAround(scenario, seen));
        drawScenario(map, scenario);
        if (!planned.pieces.empty())
            drawPath(map, states, scenario.vehicle);
        if (track.size() > 1)
            drawTrack(map, track, svg_colour::DRIVEN, "driven");
        figure.setMap(map);
        if (driven.size() > 1)
            for (const SvgPlot &plot : drivePlots(driven, scenario.vehicle))
                figure.addPlot(plot);
        return figure;
    }
}  // namespace parking
