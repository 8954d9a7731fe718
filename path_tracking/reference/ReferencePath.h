#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/reference/PathSections.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief How a path is made drivable before it is timed. */
    struct ReferenceParameters
    {
        /** Metres that any point of the body may leave the path when the steering wheel is turned in motion where the
            curvature jumps. */
        double bodyTolerance{0.01};
        /** m/s; where turning the wheel within bodyTolerance would need a lower speed, the car stops to steer. */
        double minBlendSpeed{0.1};
        /** Metres; a jump of curvature is never spread over more than this. */
        double maxBlendLength{1.0};
        /** Metres that the rear axle may leave a path at a sharp corner by cutting it; a sharper one is turned at with
            shunts. */
        double maxCornerCut{1.0};
        /** Metres that the rear axle may leave a path with sharp corners at all; beyond it the path is refused. */
        double maxCornerDeviation{3.5};
        /** m/s at which the car shall be able to turn its wheels round the corners of such a path. */
        double cornerSpeed{0.5};

        /** \brief Throws parking::Error naming the first field that is not a positive finite number. */
        void validate() const;
    };

    /** \brief Why a leg ends. */
    enum class LegEnd
    {
        Cusp,      ///< the direction changes
        Steering,  ///< the curvature jumps by more than can be steered in motion
        Goal       ///< the path ends
    };

    /** \brief The steering angle at a place of a leg; linear in the driven length between two of them. */
    struct SteeringKnot
    {
        double s;      ///< metres since the begin of the path
        double angle;  ///< radians
    };

    /** \brief A stretch between two standstills. */
    struct ReferenceLeg
    {
        int direction{1};
        LegEnd end{LegEnd::Goal};
        double beginLength{0.0};             ///< metres since the begin of the path
        double endLength{0.0};               ///< metres since the begin of the path
        std::size_t firstNode{0};            ///< index of the node where it begins
        std::size_t lastNode{0};             ///< index of the node where it ends
        std::vector<SteeringKnot> steering;  ///< at least two, first at beginLength, last at endLength

        double length() const
        {
            return endLength - beginLength;
        }
    };

    /** \brief Where a pose is beside a leg. */
    struct PathProjection
    {
        double s{0.0};         ///< metres since the begin of the path, of the nearest place
        double lateral{0.0};   ///< metres that the pose is to the left of that place, seen along the car
        double yaw{0.0};       ///< heading there minus the path's, radians
        double beyond{0.0};    ///< metres that the pose is past that place along the leg; not 0 only at its ends
        double distance{0.0};  ///< metres between pose and place; more than |lateral| beyond an end of the leg
    };

    /** \brief A path made ready for being driven: legs between standstills, each with its steering angle.

        What is done to the path that a planner delivers:
        - It ends where the direction changes; the car stands there.
        - Samples of a continuous curvature are steps of constant curvature. The steering angle is interpolated between
          the middles of the steps, so that a clothoid gets its ramp back.
        - A true jump of the curvature (from an arc to a line) is spread over a ramp round the jump. By symmetry the car
          returns to the path's heading behind it; in the middle its heading is off by |jump| * ramp / 8. The ramp is as
          long as bodyTolerance allows for the body's farthest point. If it needed a speed below minBlendSpeed, the leg
          ends there instead and the car steers at standstill.
        - Sharp corners are cut or turned at (see makeDrivable()); the path's stand-in is the reference then.

        Poses between two nodes lie on their arc. */
    class ReferencePath
    {
    public:
        /** \brief Prepares \e path.

            Throws parking::Error as splitPath() and validate() of the arguments do, and when the corners of the path
            cannot be driven within maxCornerDeviation. */
        ReferencePath(const SampledPath &path, const Vehicle &vehicle, const ReferenceParameters &parameters = {});

        const std::vector<ReferenceLeg> &legs() const
        {
            return legs_;
        }

        const std::vector<PathNode> &nodes() const
        {
            return nodes_;
        }

        const Vehicle &vehicle() const
        {
            return vehicle_;
        }

        /** \brief Metres driven. */
        double length() const
        {
            return lengths_.back();
        }

        /** \brief The pose at \e s metres since the begin, on leg \e leg (cut to its ends); yaw wrapped. */
        Pose pose(std::size_t leg, double s) const;

        /** \brief The steering angle at \e s on leg \e leg. */
        double steering(std::size_t leg, double s) const;

        /** \brief Change of the steering angle per metre at \e s on leg \e leg (right of a knot). */
        double steeringSlope(std::size_t leg, double s) const;

        /** \brief The place of leg \e leg nearest to \e pose.

            \param from,to metres since the begin: only places between are looked at */
        PathProjection project(std::size_t leg, const Pose &pose, double from, double to) const;

        /** \brief The last pose of the reference. It is the path's, up to what rounding corners left. */
        Pose end() const
        {
            return nodes_.back().pose;
        }

        /** \brief Sharp corners of the given path. */
        std::size_t corners() const
        {
            return corners_;
        }

        /** \brief Of those, how many the car shunts at. */
        std::size_t cornerTurns() const
        {
            return cornerTurns_;
        }

        /** \brief Metres that the reference leaves the given path at most (0 without corners). */
        double cornerDeviation() const
        {
            return cornerDeviation_;
        }

    private:
        void addSection(int direction, const std::vector<PathNode> &nodes, const ReferenceParameters &parameters);

        Vehicle vehicle_;
        std::vector<PathNode> nodes_;
        std::vector<double> lengths_;  // per node, metres since the begin
        std::vector<ReferenceLeg> legs_;
        std::size_t corners_{0};
        std::size_t cornerTurns_{0};
        double cornerDeviation_{0.0};
    };
}  // namespace parking
