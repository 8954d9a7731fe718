// The core's part of improved_astar.ompl: a query of the planner. OMPL's own objects are accessible only in that
// module, which the core calls.
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/GridSmoothing.h"
#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "ompl_improved_astar/search/planning/PathStates.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Error.h"
#include "python/src/Bindings.h"
#include "python/src/Footprint.h"
#include "python/src/Handles.h"
#include "python/src/Values.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace parking::python
{
    namespace
    {
        py::array_t<double> rowsOf(const std::vector<Pose> &poses)
        {
            py::array_t<double> rows({static_cast<py::ssize_t>(poses.size()), py::ssize_t{3}});
            double *to = rows.mutable_data();
            for (const Pose &pose : poses)
                for (const double value : {pose.x, pose.y, pose.yaw})
                    *to++ = value;
            return rows;
        }

        /** Calls Python while C++ runs without the GIL. An exception is stored and ends the work like a time limit. */
        class Calls
        {
        public:
            /** Starts polling \e condition and signals every 2 ms. */
            void begin(py::object condition)
            {
                condition_ = std::move(condition);
                isOver_ = false;
                next_ = {};
            }

            /** Stops polling and rethrows a stored exception. Requires the GIL. */
            void end()
            {
                condition_ = py::object();
                if (raised_)
                    std::rethrow_exception(std::exchange(raised_, nullptr));
            }

            /** Whether the time limit is met or an exception is stored. */
            bool isOver()
            {
                const auto now = std::chrono::steady_clock::now();
                if (!isOver_ && condition_ && now >= next_)
                {
                    isOver_ = ask(
                        [this]
                        {
                            if (PyErr_CheckSignals() != 0)
                                throw py::error_already_set();
                            return py::cast<bool>(condition_());
                        },
                        true);
                    next_ = now + std::chrono::milliseconds(2);
                }
                return isOver_;
            }

            bool wasOver() const
            {
                return isOver_;
            }

            void setOver()
            {
                isOver_ = true;
            }

            /** Returns the result of \e call, or \e otherwise if it raises. */
            template <class Call, class Answer>
            Answer ask(const Call &call, Answer otherwise)
            {
                const py::gil_scoped_acquire acquire;
                try
                {
                    return call();
                }
                catch (...)
                {
                    raised_ = std::current_exception();
                    isOver_ = true;
                    return otherwise;
                }
            }

        private:
            py::object condition_;
            std::exception_ptr raised_;
            bool isOver_{false};
            std::chrono::steady_clock::time_point next_;
        };

        /** Motion environment on top of OMPL's objects in Python. */
        class PythonEnvironment final : public search::MotionEnvironment
        {
        public:
            /** \param world a _World of improved_astar.ompl \param lines if not null, proves straight motions in place
                of world */
            PythonEnvironment(Calls &calls, py::object world, const Frame &frame, const Box &bounds, double step,
                              const Footprint *lines)
              : calls_(calls),
                world_(std::move(world)),
                frame_(frame),
                bounds_(bounds),
                step_(step),
                lines_(lines)
            {
            }

            /** Returns the poses of a path as the planner returns it. */
            std::function<std::vector<Pose>(const Path &)> posesOf;

            bool isFree(const Pose &pose) override
            {
                return freeCounts({pose}, {1}).front() == 1;
            }

            void freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                             double *lengths) override
            {
                std::fill_n(lengths, count, 0.0);
                if (clearance > 0.0)
                    return;
                std::vector<Pose> poses;
                std::vector<std::size_t> parts;
                for (std::size_t i = 0; i < count; ++i)
                {
                    const double number = std::max(1.0, std::ceil(std::abs(arcs[i].length) / step_));
                    for (double part = 1.0; part <= number; part += 1.0)
                        poses.push_back(advance(from, arcs[i].curvature, arcs[i].length * part / number));
                    parts.push_back(static_cast<std::size_t>(number));
                }
                const std::vector<std::size_t> free = freeCounts(poses, parts);
                for (std::size_t i = 0; i < count; ++i)
                {
                    const double whole = std::abs(arcs[i].length);
                    lengths[i] = free[i] < parts[i]
                                     ? whole * static_cast<double>(free[i]) / static_cast<double>(parts[i])
                                     : whole;
                }
            }

            bool isMotionFree(const Pose &from, const Pose &to) override
            {
                return freeMotions({from, to}, false) == 1;
            }

            bool acceptPath(const Path &path) override
            {
                const std::vector<Pose> poses = posesOf(path);
                return freeMotions(poses, false) + 1 == poses.size();
            }

            /** Number of free motions between poses, from the first on. \param always also after the time limit */
            std::size_t freeMotions(const std::vector<Pose> &poses, bool always)
            {
                std::size_t free = 0;
                if (lines_ != nullptr)
                {
                    while (free + 1 < poses.size() && (always || !calls_.isOver()) &&
                           bounds_.contains(poses[free + 1].x, poses[free + 1].y) &&
                           lines_->checker().isFree(poses[free + 1]) &&
                           lines_->isLineFree(poses[free], poses[free + 1]))
                        ++free;
                    return free;
                }
                if (!always && calls_.isOver())
                    return 0;
                return calls_.ask(
                    [&]
                    {
                        const py::object answer = world_.attr("freeMotions")(rowsOf(worldPoses(poses)), always);
                        if (answer.is_none())
                            calls_.setOver();
                        return answer.is_none() ? free : py::cast<std::size_t>(answer);
                    },
                    free);
            }

            double roomAt(double /*x*/, double /*y*/) override
            {
                return std::numeric_limits<double>::infinity();
            }

            bool knowsClearance() const override
            {
                return false;
            }

            Box bounds() const override
            {
                return bounds_;
            }

            bool wasInterrupted() const override
            {
                return calls_.wasOver();
            }

        private:
            std::vector<Pose> worldPoses(std::vector<Pose> poses) const
            {
                for (Pose &pose : poses)
                    pose = frame_.toWorld(pose);
                return poses;
            }

            /** Number of free poses at the beginning of each part of \e poses; parts holds the sizes of the parts. */
            std::vector<std::size_t> freeCounts(const std::vector<Pose> &poses, const std::vector<std::size_t> &parts)
            {
                const std::vector<std::size_t> none(parts.size(), 0);
                if (calls_.isOver())
                    return none;
                return calls_.ask(
                    [&]
                    {
                        const py::object answer = world_.attr("freeCounts")(rowsOf(worldPoses(poses)), parts);
                        if (answer.is_none())
                            calls_.setOver();
                        return answer.is_none() ? none : py::cast<std::vector<std::size_t>>(answer);
                    },
                    none);
            }

            Calls &calls_;
            py::object world_;
            const Frame &frame_;
            Box bounds_;
            double step_;
            const Footprint *lines_;
        };

        /** A query of the planner, the counterpart of ompl::geometric::ImprovedAStar in C++. */
        class OmplQuery
        {
        public:
            OmplQuery(const py::object &world, const std::shared_ptr<const Footprint> &footprint,
                      const std::string &space, double turningRadius, const std::array<double, 4> &bounds,
                      double segmentLength, bool isSwept, bool hasOwnLines, const py::dict &parameters,
                      const py::dict &own)
              : footprint_(footprint),
                parameters_(parametersFrom(parameters)),
                own_(own.is(parameters) ? parameters_ : parametersFrom(own)),
                world_(world),
                isPlain_(space == "se2"),
                turnsOnTheSpot_(search::turnsOnTheSpot(parameters_.motionModel)),
                radius_(isPlain_ ? parameters_.turningRadius : turningRadius)
            {
                if (!isPlain_ && turnsOnTheSpot_)
                    throw Error("motion_model " + parameters_.motionModel +
                                " needs a plain SE2StateSpace: a Reeds-Shepp or Dubins space would turn its path into "
                                "loops. Use motion_model car there");
                if (footprint_)
                    frame_ = footprint_->frame();
                const Box box = frame_.toLocal(bounds);
                spacing_ = stateSpacing(isPlain_, radius_, turnsOnTheSpot_);
                if (space == "reeds_shepp")
                    spacing_.curveLength = [this](const Pose &from, const Pose &to)
                    {
                        const Pose a = frame_.toWorld(from), b = frame_.toWorld(to);
                        return calls_.ask(
                            [&] { return py::cast<double>(world_.attr("distance")(a.x, a.y, a.yaw, b.x, b.y, b.yaw)); },
                            0.0);
                    };
                asPython_ = std::make_unique<PythonEnvironment>(calls_, world, frame_, box,
                                                                std::min(CHECK_STEP * radius_, segmentLength),
                                                                hasOwnLines ? footprint_.get() : nullptr);
                asPython_->posesOf = [this](const Path &path)
                {
                    std::vector<Pose> poses = pathStates(path, spacing_);
                    // Parts of paths end elsewhere.
                    if (isAtGoal(poses.back(), goals_, radius_))
                        endAtGoal(poses, goals_, spacing_, turnsOnTheSpot_);
                    return poses;
                };
                environment_ = asPython_.get();
                if (footprint_ && !turnsOnTheSpot_)
                {
                    car_ = search::carInSpace(footprint_->checker().vehicle(), 0.0, box);
                    swept_ = std::make_unique<FootprintEnvironment>(footprint_->checker(), box,
                                                                    FootprintEnvironment::TOLERANCE,
                                                                    isSwept ? nullptr : asPython_.get());
                    environment_ = swept_.get();
                }
                car_.bounds = box;
                car_.turningRadius = radius_;
                car_.forwardOnly = space == "dubins";
                planner_.begin(*environment_, parameters_, car_);
            }

            void addStart(double x, double y, double yaw)
            {
                starts_.push_back({x, y, yaw});
                planner_.addStart(frame_.toLocal(Pose{x, y, yaw}));
                calls_.end();
            }

            bool addGoal(double x, double y, double yaw)
            {
                const Pose goal{x, y, yaw};
                if (!knownGoals_.insert({x, y, yaw}).second)
                    return false;
                worldGoals_.push_back(goal);
                goals_.push_back(frame_.toLocal(goal));
                planner_.addGoal(goals_.back());
                calls_.end();
                return true;
            }

            /** \param judge receives the rows of a path and returns 0 to reject it, 1 to accept it, 2 to accept it and
                stop; with None, length and clearance decide \return solved, exhausted or stopped */
            std::string solve(const py::object &condition, const py::object &judge)
            {
                using Outcome = search::PathPlanner::Outcome;
                Outcome outcome = Outcome::Stopped;
                calls_.begin(condition);
                {
                    const py::gil_scoped_release release;
                    const auto stop = [this]
                    {
                        return calls_.isOver();
                    };
                    const auto improved = [&](const Path &path, double /*cost*/)
                    {
                        return takeImprovement(path, judge);
                    };
                    outcome = planner_.solve(stop, improved);
                    if (outcome == Outcome::Solved && !parameters_.anytime)
                        offerPathOfOwnWeights(stop, improved);
                }
                calls_.end();
                return outcome == Outcome::Solved ? "solved" : outcome == Outcome::Exhausted ? "exhausted" : "stopped";
            }

            /** Finds a path towards a goal that it does not reach; false without one. */
            bool approximate(double x, double y, double yaw, const py::object &condition)
            {
                bool found = false;
                calls_.begin(condition);
                {
                    const py::gil_scoped_release release;
                    Path nearest;
                    found = planner_.approximate(
                        frame_.toLocal(Pose{x, y, yaw}), [this] { return calls_.isOver(); }, nearest);
                    if (found)
                    {
                        states_ = pathStates(smoothed(nearest), spacing_);
                        // The path ends where the motion validator rejects it. After the stop a slow checker is not
                        // called.
                        if (!turnsOnTheSpot_ && (swept_ || !calls_.isOver()))
                            states_.resize(asPython_->freeMotions(states_, swept_ != nullptr) + 1);
                    }
                }
                calls_.end();
                return found;
            }

            bool hasSolution() const
            {
                return hasSolution_;
            }

            /** Rows of the best path or of the approximate one. */
            py::array_t<double> states(bool isExact)
            {
                std::vector<Pose> poses = isExact ? solution_ : states_;
                if (isExact)
                    endAtGoal(poses, goals_, spacing_, turnsOnTheSpot_);
                const Pose first = poses.front(), last = poses.back();
                for (Pose &pose : poses)
                    pose = frame_.toWorld(pose);
                // The ends are the given poses, since adding the offset again may round.
                for (const Pose &start : starts_)
                    if (isSamePose(frame_.toLocal(start), first, 0.0))
                        poses.front() = start;
                for (const Pose &goal : worldGoals_)
                    if (isExact && isSamePose(frame_.toLocal(goal), last, 0.0))
                        poses.back() = goal;
                return rowsOf(poses);
            }

            /** Rows curvature, length, sharpness, turn of the best path. */
            py::array_t<double> pieces() const
            {
                py::array_t<double> rows({static_cast<py::ssize_t>(path_.pieces.size()), py::ssize_t{4}});
                double *to = rows.mutable_data();
                for (const PathPiece &piece : path_.pieces)
                    for (const double value : {piece.curvature, piece.length, piece.sharpness, piece.turn})
                        *to++ = value;
                return rows;
            }

            /** Reason why there is no solution, if known. */
            std::string reason(bool isExhausted)
            {
                if (isExhausted)
                    return search::reasonOf(planner_.search().exhaustion(), car_);
                return planner_.search().isFull() ? search::outOfMemory(parameters_) : std::string();
            }

            std::uint64_t expanded() const
            {
                return planner_.expanded();
            }

            /** Poses of a frontier's nodes and, for each, the index of its parent or -1. */
            py::tuple frontier(bool ofGoal) const
            {
                std::vector<Pose> poses;
                std::vector<std::int64_t> parents;
                const search::Side side = ofGoal ? search::Side::Goal : search::Side::Start;
                const auto &nodes = planner_.search().frontier(side).nodes();
                for (std::size_t i = 0; i < nodes.size(); ++i)
                {
                    poses.push_back(frame_.toWorld(nodes[i].pose));
                    parents.push_back(nodes[i].parent == search::NO_NODE ? -1 : std::int64_t{nodes[i].parent});
                }
                return py::make_tuple(rowsOf(poses), parents);
            }

        private:
            Path smoothed(const Path &path)
            {
                Path result = path;
                if (turnsOnTheSpot_ && parameters_.smoothing == "bspline")
                    search::smoothGridPath(result, *asPython_, car_.turningRadius, [this] { return calls_.isOver(); });
                return result;
            }

            /** The path by the weights of an objective must not cost more than that by the planner's own, and may do so
                in another local optimum. */
            void offerPathOfOwnWeights(const search::StopFunction &stop, const search::ImprovementFunction &improved)
            {
                if (parameters_ == own_ || isCompared_ || isSatisfied_)
                    return;
                isCompared_ = true;
                search::PathPlanner own;
                own.begin(*environment_, own_, car_);
                for (const Pose &start : starts_)
                    own.addStart(frame_.toLocal(start));
                for (const Pose &goal : goals_)
                    own.addGoal(goal);
                own.solve(stop, {});
                if (own.hasSolution())
                    planner_.offer(own.bestPath(), stop, improved);
            }

            /** Length by OMPL's distance in a plain SE2 space. */
            static double lengthOf(const std::vector<Pose> &poses)
            {
                double length = 0.0;
                for (std::size_t i = 1; i < poses.size(); ++i)
                    length += positionDistance(poses[i - 1], poses[i]) +
                              0.5 * std::abs(wrapAngle(poses[i].yaw - poses[i - 1].yaw));
                return length;
            }

            bool takeImprovement(const Path &found, const py::object &judge)
            {
                const Path path = smoothed(found);
                const std::vector<Pose> states = pathStates(path, spacing_);
                int verdict = 0;
                const double cost = (isPlain_ ? lengthOf(states) : path.length()) + planner_.proximityOfBest();
                if (judge.is_none())
                    verdict = cost < cost_ ? 1 : 0;
                else
                {
                    std::vector<Pose> poses = states;
                    for (Pose &pose : poses)
                        pose = frame_.toWorld(pose);
                    verdict = calls_.ask([&] { return py::cast<int>(judge(rowsOf(poses))); }, 0);
                }
                if (verdict == 0 && hasSolution_)
                    return false;
                hasSolution_ = true;
                path_ = path;
                solution_ = states;
                cost_ = cost;
                isSatisfied_ = verdict == 2;
                return isSatisfied_;
            }

            std::shared_ptr<const Footprint> footprint_;
            PlannerParameters parameters_, own_;  // of the search, and without an objective
            py::object world_;
            bool isPlain_, turnsOnTheSpot_;
            double radius_;
            Frame frame_;
            Calls calls_;
            StateSpacing spacing_;
            search::CarInSpace car_;
            std::unique_ptr<PythonEnvironment> asPython_;
            std::unique_ptr<FootprintEnvironment> swept_;
            search::MotionEnvironment *environment_{nullptr};  // one of these
            search::PathPlanner planner_;
            std::vector<Pose> starts_, worldGoals_, goals_;
            std::set<std::array<double, 3>> knownGoals_;
            bool hasSolution_{false}, isSatisfied_{false}, isCompared_{false};
            Path path_;
            double cost_{std::numeric_limits<double>::infinity()};
            std::vector<Pose> solution_, states_;
        };

        /** All parameters after setting one of them from text, as OMPL's ParamSet does. */
        py::dict withParameter(const py::dict &current, const std::string &name, const std::string &value)
        {
            PlannerParameters parameters = parametersFrom(current);
            parameterNamed(name).setText(parameters, value);
            if (name == "parameter_set")
                parameters = parameterSet(parameters.parameterSet, parameters);
            checkParameters(parameters);
            return toPython(parameters);
        }
    }  // namespace

    void addOmplPlanning(py::module_ &module)
    {
        py::class_<Footprint, std::shared_ptr<Footprint>>(module, "_Footprint")
            .def(py::init<const py::object &>())
            .def("is_free", &Footprint::isFree)
            .def("clearance", &Footprint::clearance)
            .def("is_line_free",
                 [](const Footprint &self, double x, double y, double yaw, double toX, double toY, double toYaw) {
                     return self.isLineFree(self.frame().toLocal(Pose{x, y, yaw}),
                                            self.frame().toLocal(Pose{toX, toY, toYaw}));
                 })
            .def("is_curve_free", &Footprint::isCurveFree);
        py::class_<OmplQuery>(module, "_OmplQuery")
            .def(py::init(
                [](const py::object &world, const std::shared_ptr<Footprint> &footprint, const std::string &space,
                   double turningRadius, const std::array<double, 4> &bounds, double segmentLength, bool isSwept,
                   bool hasOwnLines, const py::dict &parameters, const py::dict &own)
                {
                    return std::make_unique<OmplQuery>(world, footprint, space, turningRadius, bounds, segmentLength,
                                                       isSwept, hasOwnLines, parameters, own);
                }))
            .def("add_start", &OmplQuery::addStart)
            .def("add_goal", &OmplQuery::addGoal)
            .def("solve", &OmplQuery::solve)
            .def("approximate", &OmplQuery::approximate)
            .def("states", &OmplQuery::states)
            .def("reason", &OmplQuery::reason)
            .def("frontier", &OmplQuery::frontier)
            .def_property_readonly("pieces", &OmplQuery::pieces)
            .def_property_readonly("expanded", &OmplQuery::expanded)
            .def_property_readonly("has_solution", &OmplQuery::hasSolution);
        module.def("_with_parameters", [](const py::dict &values) { return toPython(parametersFrom(values)); });
        module.def("_with_parameter", &withParameter);
    }
}  // namespace parking::python
