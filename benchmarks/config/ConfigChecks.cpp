#include "benchmarks/config/ConfigChecks.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace parking
{
    namespace
    {
        void requireWholePoses(const BenchmarkConfig &config, const PlannerSpec &spec)
        {
            for (const bool isStart : {true, false})
            {
                const std::optional<Pose> &pose = isStart ? spec.problem.start : spec.problem.goal;
                if (!pose || isFinite(*pose))
                    continue;
                const std::string name = isStart ? "start" : "goal", key = "problem." + name;
                const char *missing = !std::isfinite(pose->x) ? ".x" : !std::isfinite(pose->y) ? ".y" : ".theta";
                throw Error(config.lineOf(spec, {key + ".x", key + ".y", key + ".theta"}) + name +
                            " must be given with all of x, y and theta, and " + name + missing + " is missing");
            }
        }

        void requireVolume(const BenchmarkConfig &config, const PlannerSpec &spec)
        {
            const ProblemOptions &p = spec.problem;
            const auto require =
                [&](const char *axis, const std::optional<double> &least, const std::optional<double> &most)
            {
                const std::string low = std::string("volume.min.") + axis, high = std::string("volume.max.") + axis;
                if (least && most && !(*least < *most))
                    throw Error(config.lineOf(spec, {"problem." + high, "problem." + low}) + high +
                                " must be greater than " + low + ", " + formatNumber(*least) + ", not " +
                                formatNumber(*most));
            };
            require("x", p.minX, p.maxX);
            require("y", p.minY, p.maxY);
        }

        /** A radius that no circle has would be ignored. */
        void requireCircles(const BenchmarkConfig &config)
        {
            const std::string key = "problem.circle_radius";
            const auto isCircle = [](const PlannerSpec &spec)
            {
                return spec.problem.settings.footprint == FootprintKind::Circle;
            };
            const auto refuse = [](const std::string &line)
            {
                throw Error(line +
                            "circle_radius is the circle's, and the footprint is a rectangle; set footprint = "
                            "circle, too");
            };
            for (const PlannerSpec &spec : config.planners)
                if (spec.lines.count(key) > 0 && !isCircle(spec))
                    refuse(spec.lines.at(key));
            if (const auto common = config.problemLines.find(key);
                common != config.problemLines.end() &&
                std::none_of(config.planners.begin(), config.planners.end(), isCircle))
                refuse(common->second);
        }
    }  // namespace

    void requireFittingSettings(const BenchmarkConfig &config)
    {
        requireCircles(config);
        for (const PlannerSpec &spec : config.planners)
        {
            requireWholePoses(config, spec);
            requireVolume(config, spec);
            try
            {
                checkSettings(spec.problem.settings);
            }
            catch (const Error &error)
            {
                throw Error(config.lineOf(spec, {"problem.footprint", "problem.space"}) + error.what());
            }
        }
    }
}  // namespace parking
