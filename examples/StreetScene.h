#pragma once

#include "automatic_parking/ParkingPlanner.h"
#include "parking_geometry/ParkingSlot.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/drawing/SvgFigure.h"
#include "parking_geometry/drawing/SvgScenario.h"
#include "parking_geometry/text/Text.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace parking_examples
{
    /** \brief A length as text, rounded to centimetres. */
    inline std::string inMetres(double length)
    {
        return parking::formatNumber(std::round(100.0 * length) / 100.0) + " m";
    }

    /** \brief A slot between parked cars, kerbs and walls, and the figure of a car that parks there. */
    class StreetScene
    {
    public:
        /** \brief An empty world of 40 m by 40 m about the origin. The car parks from \e start in \e slot. */
        StreetScene(const parking::Vehicle &car, const parking::ParkingSlot &slot, const parking::Pose &start)
        {
            scenario_.vehicle = car;
            scenario_.start = start;
            scenario_.goals = slot.goals(car);
            scenario_.slot = slot;
            scenario_.bounds = {{-20.0, -20.0}, {20.0, 20.0}};
        }

        /** \brief Adds a parked car as an obstacle at the goal pose of \e slot. */
        void addParkedCar(const parking::ParkingSlot &slot, const std::string &name)
        {
            const parking::Vehicle car = parking::vehicleByName(name);
            parked_.emplace_back(slot.goals(car).front(), car);
            const auto corners = car.footprint(parked_.back().first);
            scenario_.polygons.emplace_back(corners.begin(), corners.end());
        }

        /** \brief Adds a kerb or a wall between two opposite corners. */
        void addWall(double minX, double minY, double maxX, double maxY)
        {
            scenario_.polygons.push_back({{minX, minY}, {maxX, minY}, {maxX, maxY}, {minX, maxY}});
        }

        /** \brief The planning problem. */
        const parking::Scenario &problem() const
        {
            return scenario_;
        }

        /** \brief Draws a map with the car along its path and a plot of its curvature. */
        void draw(const parking::ParkingPlan &plan, const std::string &title, const std::string &subtitle,
                  const std::string &file) const
        {
            // Small steps, because the curvature changes linearly between the states.
            const parking::SampledPath path = plan.smooth.path.sample(0.02);
            parking::SvgMap map(parking::viewAround(scenario_, path, 2.0));
            parking::drawScenario(map, scenario_);
            for (const auto &[pose, car] : parked_)
                parking::drawCar(map, pose, car, parking::svg_colour::OBSTACLE_EDGE, "parked car");
            parking::drawPath(map, path, scenario_.vehicle);
            parking::SvgFigure figure(title, subtitle);
            figure.setMap(map);
            figure.addPlot(parking::curvaturePlot(path, scenario_.vehicle));
            figure.write(file);
        }

    private:
        parking::Scenario scenario_;
        std::vector<std::pair<parking::Pose, parking::Vehicle>> parked_;
    };
}  // namespace parking_examples
