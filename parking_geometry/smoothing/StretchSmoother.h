#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/smoothing/CurvatureProgram.h"
#include "parking_geometry/smoothing/StretchPart.h"

#include <functional>
#include <vector>

namespace parking
{
    /** \brief Finds, for a part of a stretch of arcs, a path of continuous curvature with the same end poses.

        The part is cut into nodes, closer together near its joints. CurvatureProgram proposes the curvatures at the
        nodes, linear between them; the path they give is integrated exactly, each piece up to the normal of the
        reference at the next node, which leaves only a lateral and an angular error at the end. Those are removed by a
        second program and then by a small correction within what the bounds leave. A reverse stretch is handled as a
        forward one of a car turned round. Objects keep their memory between calls and are not for several threads. */
    class StretchSmoother
    {
    public:
        /** \brief For this car, whose parameters have to be valid. */
        explicit StretchSmoother(const Vehicle &vehicle);

        /** \brief Clearance in metres at a pose of the car, see FootprintQueries. */
        using Clearance = std::function<double(const Pose &)>;

        /** \brief What a transition may be like. */
        struct Limits
        {
            double sharpness{0.2};      ///< 1/m^2, change of curvature per metre that must not be exceeded
            double softSharpness{0.2};  ///< 1/m^2, change that is preferred
            double tolerance{0.05};     ///< metres, deviation that is worth steering at softSharpness
        };

        /** \brief Smooths \e part within \e limits.

            \param clearance when set, the body stays where the clearance of the poses of the arcs, and of the same
            poses moved to either side, promises that it is free
            \param result the pieces, from where the arcs begin to where they end within 1e-9 m
            \return whether there is such a path */
        bool smooth(const StretchPart &part, const Limits &limits, const Clearance &clearance,
                    std::vector<PathPiece> &result);

    private:
        struct Node
        {
            Pose pose;  ///< of the reference, in the direction of travel
            double cosine, sine;
        };

        void placeNodes(const StretchPart &part, double sharpness);
        void placeCorridors(bool reverse, const Clearance &clearance);
        bool simulate();
        bool close(double sharpness);
        bool keepsLimits(double sharpness) const;

        Vehicle vehicle_;
        double maxCurvature_;
        CurvatureProgram program_;
        CurvatureProgram::Settings settings_;
        std::vector<CurvatureProgram::Interval> intervals_;
        std::vector<Node> nodes_;
        std::vector<CurvatureProgram::Corridor> corridors_;
        std::vector<double> curvatures_, lengths_, slacks_;
        std::vector<CurvatureProgram::State> states_;
        std::vector<Eigen::Vector2d> sensitivity_;
    };
}  // namespace parking
