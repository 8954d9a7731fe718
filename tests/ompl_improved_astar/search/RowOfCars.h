#pragma once

#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <Eigen/Core>

namespace parking_test
{
    /** \brief The size of a row of parked cars between two aisles. */
    struct Row
    {
        double half{40.0};  ///< metres: of its length, with the passage at its end
        double depth{4.0};  ///< metres: from its middle to the aisle
        double aisle{5.5};  ///< metres: its width
        double lane{3.0};   // metres from the row: where the car stands in the aisle
        double gap{2.05};   // metres between the cars

        /** \brief Of the row and its aisles. */
        Eigen::Vector2d halfWorld() const
        {
            return {half, depth + aisle};
        }
    };

    /** \brief The gaps are wide enough for the car, the aisles too narrow to turn into one of them: the disc's way
       leads through the gaps, the car has to go round the end of the row. It faces that end at the start, and away from
       it at the goal. */
    inline CarProblem rowOfCars(const Row &row, double startX = -10.0)
    {
        const Eigen::Vector2d half = row.halfWorld();
        const double lane = row.depth + row.lane;
        CarProblem problem{DiscCarWorld({-half, half}), {{startX, -lane, 0.0}}, {{-10.0, lane, parking::PI}}};
        for (double x = -half.x(); x < half.x() - 7.0; x += 1.95 + row.gap)
            problem.world.boxes.push_back({{x, -row.depth}, {x + 1.95, row.depth}});
        return problem;
    }
}  // namespace parking_test
