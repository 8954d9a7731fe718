#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/reference/MakeDrivable.h"
#include "path_tracking/trajectory/SpeedProfile.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief A part of the path between two standstills: a stretch, or part of one where the car stops to steer. */
    struct ReferenceLeg
    {
        int direction{1};                    ///< 1 forwards, -1 in reverse
        double beginLength{0.0};             ///< metres since the begin of the path
        double endLength{0.0};               ///< metres since the begin of the path
        std::vector<SteeringKnot> steering;  ///< at least two, first at beginLength, last at endLength

        /** \brief Metres driven on it. */
        double length() const
        {
            return endLength - beginLength;
        }
    };

    /** \brief A path made ready for being driven: legs between standstills, each with its steering angle.

        What a Path does not say is how the wheels turn where its curvature jumps; that is added here:
        - A leg ends where the direction changes; the car stands there.
        - Along a clothoid the steering angle follows the curvature exactly.
        - A jump of the curvature (from an arc to a line) is spread over a ramp round the jump. By symmetry the car
          returns to the path's heading behind it; in the middle its heading is off by |jump| * ramp / 8. The ramp is as
          long as bodyTolerance allows for the body's farthest point. If it needed a speed below minBlendSpeed, the leg
          ends there instead and the car steers at standstill.
        - Turns on the spot, which are sharp corners, are cut or shunted at (see makeDrivable()); the path without them
          is the reference then. */
    class ReferencePath
    {
    public:
        /** \brief Prepares \e path.

            Throws parking::Error as makeDrivable() and validate() of the arguments do. */
        ReferencePath(const Path &path, const Vehicle &vehicle, const ReferenceParameters &parameters = {});

        /** \brief In the order of driving, at least one. */
        const std::vector<ReferenceLeg> &legs() const
        {
            return legs_;
        }

        /** \brief The path that is driven: the given one without its corners. */
        const Path &path() const
        {
            return drivable_.path;
        }

        /** \brief The car that the path was prepared for. */
        const Vehicle &vehicle() const
        {
            return vehicle_;
        }

        /** \brief Metres driven. */
        double length() const
        {
            return nodes_.back().s;
        }

        /** \brief The pose at \e s metres since the begin, on leg \e leg (cut to its ends); yaw wrapped. */
        Pose pose(std::size_t leg, double s) const;

        /** \brief The steering angle at \e s on leg \e leg. */
        double steering(std::size_t leg, double s) const
        {
            return steeringAt(legs_[leg].steering, s);
        }

        /** \brief The last pose of the reference. It is the path's, up to what rounding corners left. */
        Pose end() const
        {
            return nodes_.back().pose;
        }

        /** \brief The same, and what became of the corners of the given path. */
        const DrivablePath &drivable() const
        {
            return drivable_;
        }

    private:
        /** A place on the path and the piece that leads to it from the node before. */
        struct Node
        {
            Pose pose;
            PathPiece piece;
            double s{0.0};  ///< metres since the begin
        };

        /** Nodes of a leg. */
        struct NodeRange
        {
            std::size_t first;
            std::size_t last;
        };

        struct Run;

        std::vector<Run> addNodes(const Pose &begin, const Stretch &stretch);
        void addLegs(const std::vector<Run> &runs, std::size_t firstNode, int direction,
                     const ReferenceParameters &parameters);

        Vehicle vehicle_;
        DrivablePath drivable_;
        std::vector<Node> nodes_;
        std::vector<ReferenceLeg> legs_;
        std::vector<NodeRange> legNodes_;  // per leg
    };
}  // namespace parking
