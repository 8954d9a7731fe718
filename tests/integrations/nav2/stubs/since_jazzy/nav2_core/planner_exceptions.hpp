#pragma once
// A stub of ours with the names that the plugin uses; the real header comes with ROS 2.

#include <stdexcept>

namespace nav2_core
{
    class PlannerException : public std::runtime_error
    {
    public:
        using std::runtime_error::runtime_error;
    };

    class StartOccupied : public PlannerException
    {
    public:
        using PlannerException::PlannerException;
    };

    class GoalOccupied : public PlannerException
    {
    public:
        using PlannerException::PlannerException;
    };

    class StartOutsideMapBounds : public PlannerException
    {
    public:
        using PlannerException::PlannerException;
    };

    class GoalOutsideMapBounds : public PlannerException
    {
    public:
        using PlannerException::PlannerException;
    };

    class NoValidPathCouldBeFound : public PlannerException
    {
    public:
        using PlannerException::PlannerException;
    };

    class PlannerTimedOut : public PlannerException
    {
    public:
        using PlannerException::PlannerException;
    };

    class PlannerTFError : public PlannerException
    {
    public:
        using PlannerException::PlannerException;
    };

    class PlannerCancelled : public PlannerException
    {
    public:
        using PlannerException::PlannerException;
    };

}  // namespace nav2_core
