// The core's part of DrivingCostObjective in improved_astar.ompl.
#include "ompl_improved_astar/search/planning/DrivingCost.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "python/src/Bindings.h"
#include "python/src/Footprint.h"
#include "python/src/Values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace parking::python
{
    namespace
    {
        constexpr double SHORTEST_PIECE = 1e-7;  // metres; shorter ones are rounding of a curve's formula
        constexpr double SAME = 1e-6;            // metres and radians between equal curves

        /** The pose at a fraction of a curve. */
        Pose poseAt(Pose pose, const ReedsSheppCurve &curve, double fraction)
        {
            double rest = fraction * curve.length;
            for (std::size_t i = 0; i < curve.count && rest > 0.0; ++i)
            {
                const double length = std::min(rest, std::abs(curve.pieces[i].length));
                pose = advance(pose, curve.pieces[i].curvature, std::copysign(length, curve.pieces[i].length));
                rest -= length;
            }
            return pose;
        }

        /** The same curve in reverse. */
        ReedsSheppCurve reversed(ReedsSheppCurve curve)
        {
            std::reverse(curve.pieces.begin(), curve.pieces.begin() + static_cast<std::ptrdiff_t>(curve.count));
            for (Arc &piece : curve.pieces)
                piece.length = -piece.length;
            return curve;
        }

        /** The clearances of a validity checker in Python. */
        class Clearances final : public search::MotionEnvironment
        {
        public:
            /** \param clearance returns metres for x, y, yaw; None: clearances are unknown */
            explicit Clearances(py::object clearance) : clearance_(std::move(clearance))
            {
            }

            bool keeps(const Pose &pose, double clearance) override
            {
                return py::cast<double>(clearance_(pose.x, pose.y, pose.yaw)) >= clearance;
            }
            bool knowsClearance() const override
            {
                return !clearance_.is_none();
            }
            void freeLengths(const Pose & /*from*/, const Arc * /*arcs*/, std::size_t count, double /*clearance*/,
                             double *lengths) override
            {
                std::fill_n(lengths, count, 0.0);
            }
            bool isFree(const Pose & /*pose*/) override
            {
                return true;
            }
            bool isMotionFree(const Pose & /*from*/, const Pose & /*to*/) override
            {
                return true;
            }
            double roomAt(double /*x*/, double /*y*/) override
            {
                return std::numeric_limits<double>::infinity();
            }
            Box bounds() const override
            {
                return {};
            }

        private:
            py::object clearance_;
        };

        /** Costs of motions and paths, the counterpart of parking::DrivingCostObjective in C++. */
        class DrivingCosts
        {
        public:
            using Row = std::array<double, 3>;

            /** \param space a _Space of improved_astar.ompl \param clearance a Footprint, or a function as for
                Clearances */
            DrivingCosts(py::object space, const py::object &clearance, const py::dict &weights)
              : space_(std::move(space)),
                cost_(parametersFrom(weights), py::cast<double>(space_.attr("radius"))),
                isForwardOnly_(py::cast<std::string>(space_.attr("kind")) == "dubins"),
                isSymmetric_(py::cast<bool>(space_.attr("isSymmetric")))
            {
                const auto turningRadius = py::cast<double>(space_.attr("radius"));
                if (turningRadius > 0.0)
                {
                    curves_.emplace(turningRadius, isForwardOnly_ ? CurveFamily::Dubins : CurveFamily::ReedsShepp);
                    bounding_.emplace(turningRadius,
                                      isForwardOnly_ && !isSymmetric_ ? CurveFamily::Dubins : CurveFamily::ReedsShepp);
                }
                if (py::isinstance<Footprint>(clearance))
                {
                    footprint_ = py::cast<std::shared_ptr<const Footprint>>(clearance);
                    frame_ = footprint_->frame();
                    environment_ = std::make_unique<FootprintEnvironment>(
                        footprint_->checker(), frame_.toLocal(py::cast<std::array<double, 4>>(space_.attr("bounds")())),
                        FootprintEnvironment::TOLERANCE);
                }
                else
                    environment_ = std::make_unique<Clearances>(clearance);
            }

            double along(const std::vector<Row> &rows)
            {
                std::vector<Pose> poses;
                for (const Row &row : rows)
                    poses.push_back(poseOf(row));
                const auto append = [&](std::size_t i, Path &path)
                {
                    const ReedsSheppCurve curve = curveOf(rows[i - 1], rows[i]);
                    for (std::size_t k = 0; k < curve.count; ++k)
                        if (std::abs(curve.pieces[k].length) >= SHORTEST_PIECE)
                            path.append(curve.pieces[k]);
                };
                return cost_.along(poses, append, *environment_);
            }

            double lowerBound(const Row &from, const Row &to) const
            {
                return bounding_ ? bounding_->distance(poseOf(from), poseOf(to))
                                 : positionDistance(poseOf(from), poseOf(to));
            }

            bool isSymmetric() const
            {
                return (!isForwardOnly_ || isSymmetric_) && cost_.model().reversePenalty == 0.0 &&
                       !cost_.model().prefersClearance();
            }

        private:
            Pose poseOf(const Row &row) const
            {
                return frame_.toLocal(Pose{row[0], row[1], row[2]});
            }

            /** The curve that OMPL's interpolate() follows. Several may be equally long: all that turn in one direction
                only are. */
            ReedsSheppCurve curveOf(const Row &from, const Row &to)
            {
                const Pose first = poseOf(from), last = poseOf(to);
                const auto length = py::cast<double>(space_.attr("distanceBetween")(from, to));
                curves_->candidates(first, last, candidates_, length + SAME);
                if (isForwardOnly_ && isSymmetric_)
                {
                    std::vector<ReedsSheppCurve> back;
                    curves_->candidates(last, first, back, length + SAME);
                    std::transform(back.begin(), back.end(), std::back_inserter(candidates_), reversed);
                }
                candidates_.erase(
                    std::remove_if(candidates_.begin(), candidates_.end(),
                                   [&](const ReedsSheppCurve &curve) { return curve.length < length - SAME; }),
                    candidates_.end());
                if (candidates_.empty())
                    return curves_->shortest(first, last);  // rounding of coordinates far from the origin
                for (const double fraction : {0.37, 0.71})
                    keepNearest(from, to, fraction);
                return candidates_.front();
            }

            /** Removes the candidates that differ from OMPL's curve at a fraction of it. */
            void keepNearest(const Row &from, const Row &to, double fraction)
            {
                const Pose first = poseOf(from);
                const auto isNear = [&](const Pose &pose)
                {
                    return [&, pose](const ReedsSheppCurve &curve)
                    {
                        return isSamePose(poseAt(first, curve, fraction), pose, SAME);
                    };
                };
                if (std::all_of(candidates_.begin(), candidates_.end(),
                                isNear(poseAt(first, candidates_.front(), fraction))))
                    return;
                const Pose wanted = poseOf(py::cast<Row>(space_.attr("poseBetween")(from, to, fraction)));
                const auto others = std::stable_partition(candidates_.begin(), candidates_.end(), isNear(wanted));
                if (others != candidates_.begin())
                    candidates_.erase(others, candidates_.end());
            }

            py::object space_;
            search::DrivingCost cost_;
            bool isForwardOnly_, isSymmetric_;
            std::optional<ReedsShepp> curves_, bounding_;  // none on a plain space
            std::vector<ReedsSheppCurve> candidates_;      // memory of curveOf()
            std::shared_ptr<const Footprint> footprint_;
            Frame frame_;
            std::unique_ptr<search::MotionEnvironment> environment_;
        };
    }  // namespace

    void addDrivingCosts(py::module_ &module)
    {
        py::class_<DrivingCosts>(module, "_DrivingCosts")
            .def(py::init<py::object, const py::object &, const py::dict &>())
            .def("along", &DrivingCosts::along)
            .def("lower_bound", &DrivingCosts::lowerBound)
            .def_property_readonly("is_symmetric", &DrivingCosts::isSymmetric);
    }
}  // namespace parking::python
