#pragma once

#include <cstddef>
#include <cstdint>

// The core for a page in a browser: plain numbers and texts in, plain numbers and texts out. One scene at a time, from
// one thread. Everything is in world coordinates, metres and radians. Compiled natively it is what the tests call.
//
// A function that may fail returns whether it did not; playground_message() then says why, in one line.
extern "C"
{
    /** \brief What went wrong last, or why there is no path; empty when nothing did. */
    const char *playground_message();

    /** \brief The table of parameters as JSON: [{name, type, value, least, most, step, zero, names, unit, meaning}].
        What type is: number, count, flag or name. */
    const char *playground_parameters();

    /** \brief The known cars as JSON: [{name, wheelbase, ...}], in the words of vehicle files. */
    const char *playground_vehicles();

    /** \brief Room for so many numbers, which playground_scene() reads. */
    double *playground_numbers(std::size_t count);

    /** \brief Room for so many cells, row by row from below: 0 free, 1 occupied, 2 unknown. */
    std::uint8_t *playground_cells(std::size_t count);

    /** \brief Takes the scene that was written into playground_numbers():

        the car (wheelbase, front overhang, rear overhang, width, steering angle, speed, acceleration, steering rate);
        start x, y, yaw; then either 0, the number of goals, x, y, yaw of each, or 1 and the slot: kind (0
       perpendicular, 1 parallel, 2 angled), x, y, yaw, length, width, entry (0 reverse, 1 forward, 2 either), angle,
       side (0 right, 1 left, 2 either), depth (negative: in the middle), lateral offset; then either 0, the number of
       polygons, corners of each, x and y of all corners, or 1 and the map: columns, rows, resolution, origin x, y, yaw,
       whether unknown cells are occupied. */
    bool playground_scene(std::size_t count);

    /** \brief All parameters get their defaults. */
    void playground_reset_parameters();

    /** \brief Sets a parameter; numbers are written as such, flags as true or false. */
    bool playground_set_parameter(const char *name, const char *value);

    /** \brief Plans. \param expansions 0: no limit

        The outcome is in SUMMARY; false only when the question makes no sense. */
    bool playground_plan(double seconds, double expansions);

    /** \brief Writes down how the search of the last plan went. */
    bool playground_trace(double seconds, double mostNodes);

    /** \brief Makes the quickest trajectory near the path of the last plan. */
    bool playground_trajectory(double seconds);

    /** \brief Is the car free of obstacles at a pose? */
    bool playground_is_free(double x, double y, double yaw);

    /** \brief What playground_output() gives. */
    enum PlaygroundOutput
    {
        /** Outcome (0 exact, 1 approximate, 2 infeasible, 3 timeout, 4 invalid start, 5 invalid goal), length, cusps,
            clearance, cost, bound, expansions, motions generated, curves tried, poses checked, milliseconds of
            planning, milliseconds of loading, index of the goal, whether it is for a disc, radius of that, smallest
            turning radius. */
        PLAYGROUND_SUMMARY,
        PLAYGROUND_PATH,        ///< rows x, y, yaw, direction, curvature, metres driven, clearance
        PLAYGROUND_PIECES,      ///< rows curvature, length, sharpness, turn
        PLAYGROUND_TRAJECTORY,  ///< rows t, x, y, yaw, v, acceleration, steering, steering rate
        PLAYGROUND_START_TREE,  ///< rows x, y, yaw, parent, curvature, length, cost, estimate of the rest, expanded
        PLAYGROUND_GOAL_TREE,   ///< likewise
        PLAYGROUND_STEPS,       ///< rows expansions, nodes of the start's tree, of the goal's tree, solved
        PLAYGROUND_GOALS,       ///< rows x, y, yaw
        PLAYGROUND_SLOT,        ///< rows x, y of its corners
        PLAYGROUND_BOUNDS       ///< x, y least and most of the world
    };

    /** \brief The numbers of an output, until the next call that makes them anew. */
    const double *playground_output(int which);

    /** \brief How many numbers playground_output() has for \e which. */
    std::size_t playground_output_size(int which);
}
