#include "benchmarks/paper/PaperTask.h"

#include "automatic_parking/scenario/ScenarioPlanner.h"
#include "benchmarks/system/ProcessorTime.h"
#include "ompl_improved_astar/search/MotionModel.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/manoeuvres/ReverseParking.h"
#include "state_validity/ObstacleSet.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace parking
{
    namespace
    {
        using Points = std::vector<Eigen::Vector2d>;

        constexpr double CURVE_STEP = 0.1;  // metres between points of the curve

        /** \e car, or the same with its poses at the body's middle and an equal minimum turning radius: the paper's
            equations for "the vehicle's center". */
        Vehicle plannedVehicle(const Vehicle &car, DiscPlace place)
        {
            Vehicle vehicle = car;
            if (place != DiscPlace::Middle)
                return vehicle;
            vehicle.rearOverhang = vehicle.wheelbase = 0.5 * car.length();
            vehicle.frontOverhang = 0.0;
            vehicle.maxSteeringAngle = std::atan(vehicle.wheelbase * std::tan(car.maxSteeringAngle) / car.wheelbase);
            for (Eigen::Vector2d &corner : vehicle.outline)
                corner.x() -= car.centreOffset();
            if (!vehicle.outline.empty())
                vehicle.setOutline(vehicle.outline);
            return vehicle;
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

        /** The spacing of points of a path over cells, so that one sampling rate has the same effect on both. */
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

        /** Appends points that begin at the end of \e all. */
        void append(Points &all, const Points &more)
        {
            all.insert(all.end(), more.begin() + (all.empty() ? 0 : 1), more.end());
        }

        /** Orders solved before approximate runs. Solved ones follow by a heading within a right angle, then by length;
            others by heading. */
        auto rank(const PaperRun &run)
        {
            const bool isTurned = run.arrivalTurn > 0.5 * PI;
            return std::tuple(run.curve.empty(), run.approachError, isTurned,
                              isTurned ? run.arrivalTurn : run.approachLength);
        }
    }  // namespace

    PaperTask::PaperTask(const Scenario &scenario, const PaperVariant &variant)
      : variant_(variant),
        bounds_(scenario.bounds),
        vehicle_(plannedVehicle(scenario.vehicle, variant.place)),
        start_(scenario.start),
        body_(ObstacleSet::fromScenario(scenario), vehicle_)
    {
        const double shift = variant.place == DiscPlace::Middle ? scenario.vehicle.centreOffset() : 0.0;
        start_ = advance(start_, 0.0, shift);
        if (scenario.slot)
            addManoeuvres(*scenario.slot);
        else
            for (const Pose &goal : scenario.goals)
                manoeuvres_.push_back({advance(goal, 0.0, shift), {}});
    }

    void PaperTask::addManoeuvres(ParkingSlot slot)
    {
        FootprintQueries world;
        world.isFree = [this](const Pose &pose)
        {
            return body_.isFree(pose);
        };
        world.clearance = [this](const Pose &pose)
        {
            return body_.clearance(pose);
        };
        slot.entry = SlotEntry::Reverse;  // as in the paper
        // A path out of a parallel slot ends as close to the row of cars as their outlines allow. The disc requires
        // more, and occupied cells extend beyond the cars.
        if (slot.kind == SlotKind::Parallel)
            slot.width += 2.0 * (std::max(0.0, variant_.radius - 0.5 * vehicle_.width) + body_.obstacles().cellSize());
        for (ReverseParkingResult &each : ReverseParking(vehicle_).planAll(slot, world))
            if (each.fits())
                manoeuvres_.push_back(std::move(each.path));
            else if (whyNone_.empty())
                whyNone_ = each.message;
    }

    PaperRun PaperTask::run(const PlannerParameters &parameters, double timeLimit, bool drive) const
    {
        if (!search::turnsOnTheSpot(parameters.motionModel))
            throw Error("the paper's run plans on a grid, not with motion_model " + parameters.motionModel);
        PaperRun best;
        best.status = "no_manoeuvre";
        best.reason = whyNone_;
        for (const Path &each : manoeuvres_)
        {
            PaperRun run = runTo(each, parameters, timeLimit);
            if (&each == manoeuvres_.data() || rank(run) < rank(best))
                best = std::move(run);
        }
        if (best.curve.empty())
            return best;
        best.approachCollidingShare = collidingShare(best);
        if (drive)
            best.drive = drivePaper(vehicle_, best.curve, start_, best.goal, variant_.drive,
                                    [this](const Pose &pose) { return body_.isFree(pose); });
        return best;
    }

    PaperRun PaperTask::runTo(const Path &manoeuvre, const PlannerParameters &parameters, double timeLimit) const
    {
        PaperRun run;
        const double begin = processorTime();
        const double ahead = variant_.place == DiscPlace::Ahead ? vehicle_.centreOffset() : 0.0;
        DiscWorld world(body_.obstacles(), bounds_, variant_.radius, ahead, variant_.scan);
        const double made = processorTime();
        search::PlanRequest request;
        request.starts = {start_};
        request.goals = {manoeuvre.start};
        request.car.turningRadius = vehicle_.minTurningRadius();
        request.car.bounds = bounds_;
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
        const bool isSolved = plan.outcome == search::PlanOutcome::Solved;
        if (isSolved || plan.outcome == search::PlanOutcome::Approximate)
        {
            const Path into = isSolved ? manoeuvre : Path{plan.path.end(), {}};
            run.approachLength = plan.path.length();
            run.approachError = isSolved ? 0.0 : positionDistance(plan.path.end(), manoeuvre.start);
            run.parkingStart = manoeuvre.start;
            run.goal = manoeuvre.end();
            join(plan.path, into, parameters.smoothing != "none", run);
            // The path ends with a turn on the spot to the required heading.
            run.arrivalTurn = plan.path.pieces.empty() ? 0.0 : std::abs(plan.path.pieces.back().turn);
        }
        // A search that loads eagerly checks motions after loading.
        const bool isEager = parameters.obstacleLoading == "eager";
        const double loaded = isEager ? run.counts.firstMotionAt.value_or(processorTime()) : made;
        run.loadingTime = loaded - begin;
        run.planningTime = processorTime() - loaded;
        return run;
    }

    void PaperTask::join(const Path &approach, const Path &manoeuvre, bool smooth, PaperRun &run) const
    {
        std::vector<Points> stretches{cornersOf(approach)};
        const std::size_t steps = stretches.front().size() - 1;
        const double spacing = steps > 0 ? approach.length() / static_cast<double>(steps) : CURVE_STEP;
        for (const Stretch &stretch : manoeuvre.stretches())
            stretches.push_back(pointsOf(manoeuvre.part(stretch.first, stretch.last), spacing));
        for (const Points &each : stretches)
            append(run.corners, each);
        if (variant_.acrossCusps)
            stretches = {run.corners};
        const bool isCurved = smooth && variant_.degree != POLYLINE;
        for (const Points &each : stretches)
            append(run.curve, isCurved ? splineThrough(each, variant_.degree, variant_.sampling, CURVE_STEP)
                                       : splineThrough(each, POLYLINE, 1, CURVE_STEP));
    }

    double PaperTask::collidingShare(const PaperRun &run) const
    {
        double colliding = 0.0, count = 0.0, driven = 0.0;
        for (std::size_t i = 1; i < run.curve.size() && driven < run.approachLength; ++i)
        {
            const Eigen::Vector2d step = run.curve[i] - run.curve[i - 1];
            driven += step.norm();
            count += 1.0;
            colliding += !body_.isFree({run.curve[i].x(), run.curve[i].y(), std::atan2(step.y(), step.x())});
        }
        return count > 0.0 ? colliding / count : 0.0;
    }
}  // namespace parking
