#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "ompl_improved_astar/search/SearchTuning.h"
#include "ompl_improved_astar/search/planning/GapBridge.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace parking::search
{
    /** \brief Makes a drivable path cheaper by moving the poses between its pieces, above all its cusps.

        Shortening puts curves between poses of the path, so that what it leaves still goes through poses that a search
        has come to on its raster. Here each pose between two pieces is moved by a step, forwards, backwards, to the
        side or turned, and a part of the path around it replaced by two curves of bounded curvature that meet there:
        one of a given length, else that between the cusps next to the pose, else one from cusp to cusp farther away,
        since where the car has to go to and fro no curve spans several cusps. The cheapest curves that are free are
        taken, if the path becomes cheaper by them: a descent by coordinates. The path stays free and drivable and keeps
        its ends. Deterministic. */
    class PathRelaxer
    {
    public:
        /** \brief What is referred to must outlive it. \param cost by which paths become cheaper */
        PathRelaxer(MotionEnvironment &environment, const ReedsShepp &curves, const CostModel &cost,
                    const SearchTuning &tuning)
          : environment_(environment),
            curves_(curves),
            cost_(cost),
            tuning_(tuning),
            bridge_(environment, curves, cost)
        {
        }

        /** \brief How one pass moves poses. */
        struct Pass
        {
            double step;        ///< metres by which they are moved; turns are as long at full lock
            std::size_t cusps;  ///< up to so many before and behind a pose the path is replaced, where less does not
                                ///< help; with 0 only what is within relaxReach of it
        };

        /** \brief One pass along the path, which must not be empty.

            \param mostCusps the path may have then
            \return whether the path became cheaper; not so by what there is no time to price */
        bool pass(Path &path, const Pass &pass, std::size_t mostCusps, const StopFunction &stop);

        /** \brief What the last pass has made of the path, if it became cheaper, and what that costs. */
        const PricedPath &priced() const
        {
            return priced_;
        }

        /** \brief Pairs of poses between which curves were looked for in all passes so far. */
        std::uint64_t connections() const
        {
            return bridge_.connections();
        }

    private:
        /** A part of a path: metres driven to where it begins and ends. */
        struct Span
        {
            double begin, end;
        };

        std::vector<Pose> movedPoses(const Pose &pose, double step);
        /** The parts around where the path is after so many metres, up to so many cusps away from there, in the order
            in which they are tried. */
        std::vector<Span> spansAround(const Path &path, double driven, std::size_t mostCusps) const;
        /** The cheapest path that goes through one of the poses within that part. */
        std::optional<Path> leadThrough(const Span &span, const std::vector<Pose> &poses, std::size_t mostCusps,
                                        const StopFunction &stop);
        /** Replaces the path by one that costs less and goes through one of the poses within one of the parts. */
        bool move(const std::vector<Pose> &poses, const std::vector<Span> &spans, std::size_t mostCusps,
                  const StopFunction &stop);

        MotionEnvironment &environment_;
        const ReedsShepp &curves_;
        CostModel cost_;
        SearchTuning tuning_;
        GapBridge bridge_;
        PricedPath priced_;
    };
}  // namespace parking::search
