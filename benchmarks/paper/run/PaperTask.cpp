#include "benchmarks/paper/run/PaperTask.h"

#include "automatic_parking/scenario/ScenarioPlanner.h"
#include "benchmarks/system/ProcessorTime.h"
#include "ompl_improved_astar/search/MotionModel.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "state_validity/ObstacleSet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace parking
{
    namespace
    {
        using Points = std::vector<Eigen::Vector2d>;

        constexpr double CURVE_STEP = 0.1;  // metres between points of what is driven

        /** The car with its poses at the body's middle and the same smallest turn: what the paper's equations make of
            "the vehicle's center". */
        Vehicle middleVehicle(const Vehicle &vehicle)
        {
            Vehicle middle = vehicle;
            middle.rearOverhang = 0.5 * vehicle.length();
            middle.wheelbase = 0.5 * vehicle.length();
            middle.frontOverhang = 0.0;
            middle.maxSteeringAngle =
                std::atan(middle.wheelbase * std::tan(vehicle.maxSteeringAngle) / vehicle.wheelbase);
            return middle;
        }

        Vehicle plannedVehicle(const Vehicle &vehicle, DiscPlace place)
        {
            return place == DiscPlace::Middle ? middleVehicle(vehicle) : vehicle;
        }

        const ParkingSlot &slotOf(const Scenario &scenario)
        {
            if (!scenario.slot)
                throw Error(scenario.name + ": has no slot, and the paper's run ends in one");
            return *scenario.slot;
        }

        Points cornersOf(const Path &path)
        {
            Points points{{path.start.x, path.start.y}};
            Pose pose = path.start;
            for (const PathPiece &piece : path.pieces)
            {
                pose = advance(pose, piece);
                if (piece.driven() > 0.0)
                    points.emplace_back(pose.x, pose.y);
            }
            return points;
        }

        /** As far apart as the points of a way over cells, so that one sampling rate means the same on both. */
        Points pointsOf(const Path &path, double spacing)
        {
            Points points;
            const double length = path.length(), parts = std::max(1.0, std::ceil(length / spacing));
            for (double part = 0.0; part <= parts; part += 1.0)
            {
                const Pose pose = part < parts ? path.at(length * part / parts) : path.end();
                points.emplace_back(pose.x, pose.y);
            }
            return points;
        }
    }  // namespace

    DiscPlace discPlaceByName(const std::string &name)
    {
        if (name == "middle")
            return DiscPlace::Middle;
        if (name == "ahead")
            return DiscPlace::Ahead;
        if (name == "rear_axle")
            return DiscPlace::RearAxle;
        throw Error(unknownName("place of the disc", name, {"middle", "ahead", "rear_axle"}));
    }

    DiscLookup discLookupByName(const std::string &name)
    {
        if (name == "scan")
            return DiscLookup::Scan;
        if (name == "field")
            return DiscLookup::Field;
        throw Error(unknownName("lookup", name, {"scan", "field"}));
    }

    PaperTask::PaperTask(const Scenario &scenario, const PaperVariant &variant)
      : scenario_(scenario),
        variant_(variant),
        vehicle_(plannedVehicle(scenario.vehicle, variant.place)),
        start_(variant.place == DiscPlace::Middle ? advance(scenario.start, 0.0, scenario.vehicle.centreOffset())
                                                  : scenario.start),
        body_(ObstacleSet::fromScenario(scenario), vehicle_)
    {
        const ParkingSlot &slot = slotOf(scenario);
        FootprintQueries world;
        world.isFree = [this](const Pose &pose)
        {
            return body_.isFree(pose);
        };
        world.clearance = [this](const Pose &pose)
        {
            return body_.clearance(pose);
        };
        // The paper reverses in, whatever the slot allows.
        ParkingSlot reversed = slot;
        reversed.entry = SlotEntry::Reverse;
        // A sweep out of a parallel slot ends as near to the row of cars as their outlines allow. The disc needs more,
        // and the cells of a map reach beyond the cars in them.
        if (slot.kind == SlotKind::Parallel)
            reversed.width +=
                2.0 * (std::max(0.0, variant.radius - 0.5 * vehicle_.width) + body_.obstacles().cellSize());
        for (ReverseParkingResult &each : ReverseParking(vehicle_).planAll(reversed, world))
            if (each.fits())
                manoeuvres_.push_back(std::move(each));
            else if (whyNone_.empty())
                whyNone_ = each.message;
        if (!manoeuvres_.empty())
            whyNone_.clear();
    }

    PaperRun PaperTask::run(const PlannerParameters &parameters, double timeLimit, bool drive) const
    {
        if (!search::turnsOnTheSpot(parameters.motionModel))
            throw Error("the paper's run plans on a grid, not with motion_model " + parameters.motionModel);
        PaperRun best;
        if (manoeuvres_.empty())
        {
            best.status = "no_manoeuvre";
            best.reason = whyNone_;
            return best;
        }
        // The shortest way that gets there with about the right heading; without one, that which is least off.
        const auto isBetter = [](const PaperRun &a, const PaperRun &b)
        {
            const bool fits = a.arrivalTurn <= 0.5 * PI, otherFits = b.arrivalTurn <= 0.5 * PI;
            if (fits != otherFits)
                return fits;
            return fits ? a.approachLength < b.approachLength : a.arrivalTurn < b.arrivalTurn;
        };
        for (const ReverseParkingResult &each : manoeuvres_)
        {
            PaperRun run = runTo(each, parameters, timeLimit);
            if (best.status.empty() || isBetter(run, best))
                best = std::move(run);
        }
        if (!best.curve.empty() && drive)
        {
            best.driven = true;
            best.drive = drivePaper(vehicle_, best.curve, start_, best.goal, variant_.drive,
                                    [this](const Pose &pose) { return body_.isFree(pose); });
        }
        return best;
    }

    PaperRun PaperTask::runTo(const ReverseParkingResult &manoeuvre, const PlannerParameters &parameters,
                              double timeLimit) const
    {
        PaperRun run;
        const double begin = processorTime();
        const double ahead = variant_.place == DiscPlace::Ahead ? vehicle_.centreOffset() : 0.0;
        DiscWorld world(body_.obstacles(), scenario_.bounds, variant_.radius, ahead, variant_.lookup);
        const double made = processorTime();
        search::PlanRequest request;
        request.starts = {start_};
        request.goals = {manoeuvre.path.start};
        request.car.turningRadius = vehicle_.minTurningRadius();
        request.car.bounds = scenario_.bounds;
        request.parameters = parameters;
        request.stop = [end = begin + timeLimit]
        {
            return processorTime() > end;
        };
        const search::PlanResult plan = search::plan(world, request);
        run.status = statusName(plan.outcome);
        run.reason = plan.reason;
        run.statistics = plan.statistics;
        run.counts = world.counts();
        if (plan.outcome == search::PlanOutcome::Solved)
        {
            run.approachLength = plan.path.length();
            run.parkingStart = manoeuvre.path.start;
            run.goal = manoeuvre.goal;
            join(plan.path, manoeuvre.path, parameters.smoothing != "none", run);
            run.arrivalTurn = 0.0;
            // The way ends with a turn on the spot to the heading that is wanted there.
            if (!plan.path.pieces.empty())
                run.arrivalTurn = std::abs(plan.path.pieces.back().turn);
        }
        // A search that loads eagerly asks about motions when it has loaded.
        const bool isEager = parameters.obstacleLoading == "eager";
        const double loaded = isEager ? run.counts.firstMotionAt.value_or(processorTime()) : made;
        run.loadingTime = loaded - begin;
        run.planningTime = processorTime() - loaded;
        return run;
    }

    void PaperTask::join(const Path &approach, const Path &manoeuvre, bool smooth, PaperRun &run) const
    {
        const Points way = cornersOf(approach);
        const double spacing = way.size() > 1 ? approach.length() / static_cast<double>(way.size() - 1) : CURVE_STEP;
        // Stretches of the whole, each from cusp to cusp; the manoeuvre begins where A*'s way ends.
        std::vector<Points> stretches{way};
        for (const Stretch &stretch : manoeuvre.stretches())
            stretches.push_back(pointsOf(manoeuvre.part(stretch.first, stretch.last), spacing));
        for (const Points &each : stretches)
            run.corners.insert(run.corners.end(), each.begin() + (run.corners.empty() ? 0 : 1), each.end());
        const SplineKind kind = smooth ? variant_.spline : SplineKind::None;
        if (variant_.acrossCusps)
            stretches = {run.corners};
        for (const Points &each : stretches)
        {
            const Points curve = splineThrough(each, kind, variant_.sampling, CURVE_STEP);
            run.curve.insert(run.curve.end(), curve.begin() + (run.curve.empty() ? 0 : 1), curve.end());
        }
    }
}  // namespace parking
