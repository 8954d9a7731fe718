#pragma once

#include <cstddef>
#include <cstdint>

// The planner for a page in a browser: plain numbers and texts in, plain numbers and texts out. One scene at a time,
// from one thread. All values are in world coordinates, metres and radians. The tests call its native build.
//
// A function that may fail returns whether it succeeded; playground_message() then returns the reason in one line.
extern "C"
{
    /** \brief The last error, or the reason for a missing path; otherwise empty. */
    const char *playground_message();

    /** \brief The table of parameters as JSON: [{name, type, value, least, most, step, zero, names, unit, meaning}].
        The type is number, count, flag or name. */
    const char *playground_parameters();

    /** \brief The known cars as JSON: [{name, wheelbase, ...}], with the keys of vehicle files. */
    const char *playground_vehicles();

    /** \brief Allocates \e count numbers, which playground_scene() reads. */
    double *playground_numbers(std::size_t count);

    /** \brief Allocates \e count cells, row by row from below: 0 free, 1 occupied, 2 unknown. */
    std::uint8_t *playground_cells(std::size_t count);

    /** \brief Reads the scene from playground_numbers():

        the car (wheelbase, front overhang, rear overhang, width, steering angle, speed, acceleration, steering rate,
        the number of corners of its outline, x and y of each, counter-clockwise);
        start x, y, yaw; then either 0, the number of goals, x, y, yaw of each, or 1 and the slot: kind (0
        perpendicular, 1 parallel, 2 angled), x, y, yaw, length, width, entry (0 reverse, 1 forward, 2 either), angle,
        side (0 right, 1 left, 2 either), depth (negative: in the middle), lateral offset; then either 0, the number of
        polygons, corners of each, x and y of all corners, or 1 and the map: columns, rows, resolution, origin x, y,
        yaw, whether unknown cells are occupied. */
    bool playground_scene(std::size_t count);

    /** \brief Resets all parameters to their defaults. */
    void playground_reset_parameters();

    /** \brief Sets a parameter from text: a number, or true or false for a flag. */
    bool playground_set_parameter(const char *name, const char *value);

    /** \brief Plans a path. \param expansions 0: no limit

        The outcome is in PLAYGROUND_SUMMARY; false only for invalid input. */
    bool playground_plan(double seconds, double expansions);

    /** \brief Plans as playground_plan(), but with the textbook's Hybrid A*, which ignores the parameters. */
    bool playground_plan_by_textbook(double seconds);

    /** \brief Records the search of the last plan. */
    bool playground_trace(double seconds, double mostNodes);

    /** \brief Samples the distance to the nearest obstacle all over the world, with at most \e mostSide points along x
        and y. */
    bool playground_field(double mostSide);

    /** \brief Optimises the fastest trajectory near the path of the last plan. */
    bool playground_trajectory(double seconds);

    /** \brief Whether the car is free of obstacles at a pose. */
    bool playground_is_free(double x, double y, double yaw);

    /** \brief Outputs of playground_output(). */
    enum PlaygroundOutput
    {
        /** Outcome (0 exact, 1 approximate, 2 infeasible, 3 timeout, 4 invalid start, 5 invalid goal, 6 escaped),
           length, cusps, clearance, cost, bound, expansions, motions generated, curves attempted, poses checked,
           milliseconds of planning, milliseconds of loading, index of the goal, whether it is for a disc, radius of the
           disc, minimum turning radius, and whether the car can drive the path: 0 yes, 1 it turns on the spot or more
           tightly than the car, 2 the car's body touches an obstacle. */
        PLAYGROUND_SUMMARY,
        PLAYGROUND_PATH,        ///< rows x, y, yaw, direction, curvature, metres driven, clearance
        PLAYGROUND_PIECES,      ///< rows curvature, length, sharpness, turn
        PLAYGROUND_TRAJECTORY,  ///< rows t, x, y, yaw, v, acceleration, steering, steering rate
        PLAYGROUND_START_TREE,  ///< rows x, y, yaw, parent, curvature, length, cost, estimate of the rest, expanded
        PLAYGROUND_GOAL_TREE,   ///< rows x, y, yaw, parent, curvature, length, cost, estimate of the rest, expanded
        PLAYGROUND_STEPS,       ///< rows expansions, nodes of the start's tree, of the goal's tree, solved
        PLAYGROUND_GOALS,       ///< rows x, y, yaw
        PLAYGROUND_SLOT,        ///< rows x, y of its corners
        PLAYGROUND_BOUNDS,      ///< minimum and maximum x and y of the world
        PLAYGROUND_FIELD  ///< columns, rows, spacing, x and y of the first point, then metres row by row from below
    };

    /** \brief The numbers of an output, valid until the next call that computes them. */
    const double *playground_output(int which);

    /** \brief The number of values of output \e which. */
    std::size_t playground_output_size(int which);
}
