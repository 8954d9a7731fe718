#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/reference/MakeDrivable.h"
#include "path_tracking/trajectory/SpeedProfile.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief A part of the path between two standstills: a stretch, or a part of it if the car stops to steer. */
    struct ReferenceLeg
    {
        int direction{1};                    ///< 1 forwards, -1 in reverse
        double beginLength{0.0};             ///< metres since the start of the path
        double endLength{0.0};               ///< metres since the start of the path
        std::vector<SteeringKnot> steering;  ///< at least two, first at beginLength, last at endLength

        /** \brief Length in metres. */
        double length() const
        {
            return endLength - beginLength;
        }
    };

    /** \brief A path prepared for driving: legs between standstills, each with its steering angle.

        A Path does not define how the car steers where the curvature jumps. This class adds it:
        - A leg ends at each change of direction; the car stands there.
        - Along a clothoid the steering angle follows the curvature exactly.
        - A jump of the curvature (from an arc to a line) is spread over a ramp. By symmetry the car returns to the
          heading of the path after it; halfway the heading is off by |jump| * ramp / 8. The ramp is as long as
          bodyTolerance allows for the farthest point of the body. If it required a speed below minBlendSpeed, the leg
          ends there and the car steers at standstill.
        - Turns on the spot, which are sharp corners, are cut or shunted (see makeDrivable()). The resulting path is the
          reference.*/
    class ReferencePath
    {
    public:
        /** \brief Prepares \e path. Throws parking::Error as makeDrivable() and validate() of the arguments do. */
        ReferencePath(const Path &path, const Vehicle &vehicle, const ReferenceParameters &parameters = {});

        /** \brief The legs in driving order, at least one. */
        const std::vector<ReferenceLeg> &legs() const
        {
            return legs_;
        }

        /** \brief The driven path: the given one without its corners. */
        const Path &path() const
        {
            return drivable_.path;
        }

        /** \brief The car for which the path was prepared. */
        const Vehicle &vehicle() const
        {
            return vehicle_;
        }

        /** \brief Metres driven in total. */
        double length() const
        {
            return nodes_.back().s;
        }

        /** \brief The pose at \e s metres since the start, on leg \e leg (clamped to its ends); yaw wrapped. */
        Pose pose(std::size_t leg, double s) const;

        /** \brief The steering angle in radians at \e s on leg \e leg. */
        double steering(std::size_t leg, double s) const
        {
            return steeringAt(legs_[leg].steering, s);
        }

        /** \brief The last pose of the reference. It differs from the path's by the effect of rounded corners. */
        Pose end() const
        {
            return nodes_.back().pose;
        }

        /** \brief The driven path with the numbers of its corners and shunts. */
        const DrivablePath &drivable() const
        {
            return drivable_;
        }

    private:
        /** A place on the path and the piece that leads to it from the previous node. */
        struct Node
        {
            Pose pose;
            PathPiece piece;
            double s{0.0};  ///< metres since the start
        };

        /** Range of nodes of a leg. */
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
