// The parameters of ImprovedAStar: setters with their ranges, getters, and their names for ParamSet.

#include "ompl_improved_astar/ImprovedAStar.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"

#include <ompl/util/Exception.h>

#include <cmath>
#include <limits>

namespace ompl::geometric
{
    namespace
    {
        using parking::MotionModel;
        using parking::search::OpenListKind;

        double checked(const char *name, double value, double least, const char *meaning,
                       double most = std::numeric_limits<double>::max())
        {
            if (!(value >= least && value <= most))
                throw Exception("ImprovedAStar",
                                std::string(name) + " must be " + meaning + ", not " + parking::formatNumber(value));
            return value;
        }

        std::string choice(const char *name, const std::string &value, const std::vector<std::string> &known)
        {
            for (const std::string &each : known)
                if (each == value)
                    return value;
            throw Exception("ImprovedAStar", parking::unknownName(std::string("value for ") + name, value, known));
        }

        const std::vector<std::string> MODELS{"car", "grid8", "grid16"};
    }  // namespace

    void ImprovedAStar::setParameters(const parking::PlannerParameters &parameters)
    {
        const parking::PlannerParameters before = parameters_;
        parameters_ = parameters;
        try
        {
            setTurningRadius(parameters.turningRadius);
            setXyResolution(parameters.xyResolution);
            setHeadingBins(parameters.headingBins);
            setSteeringAngles(parameters.steeringAngles);
            setHeuristicWeightFar(parameters.weights.far);
            setHeuristicWeightNear(parameters.weights.near);
            setNearGoalDistance(parameters.weights.nearDistance);
            setTieBreak(parameters.weights.tieBreak);
            setReversePenalty(parameters.reversePenalty);
            setGearChangePenalty(parameters.gearChangePenalty);
            setSteeringChangePenalty(parameters.steeringChangePenalty);
            setClearanceWeight(parameters.clearanceWeight);
        }
        catch (const Exception &)
        {
            parameters_ = before;
            throw;
        }
    }

    void ImprovedAStar::setMotionModel(const std::string &model)
    {
        choice("motion_model", model, MODELS);
        parameters_.motionModel = model == "car"     ? MotionModel::Car
                                  : model == "grid8" ? MotionModel::Grid8
                                                     : MotionModel::Grid16;
    }

    std::string ImprovedAStar::getMotionModel() const
    {
        return MODELS[static_cast<std::size_t>(parameters_.motionModel)];
    }

    void ImprovedAStar::setTurningRadius(double radius)
    {
        if (!(radius > 0.0) || !std::isfinite(radius))
            throw Exception("ImprovedAStar",
                            "turning_radius must be a positive number of metres, not " + parking::formatNumber(radius));
        parameters_.turningRadius = radius;
    }

    double ImprovedAStar::getTurningRadius() const
    {
        return parameters_.turningRadius;
    }

    void ImprovedAStar::setXyResolution(double resolution)
    {
        parameters_.xyResolution = checked("xy_resolution", resolution, 0.0,
                                           "a number of metres of at least 0 (0 chooses one) and at most 100", 100.0);
    }

    double ImprovedAStar::getXyResolution() const
    {
        return parameters_.xyResolution;
    }

    void ImprovedAStar::setHeadingBins(unsigned int bins)
    {
        if (bins < 8 || bins > 1440)
            throw Exception("ImprovedAStar", "heading_bins must be between 8 and 1440, not " + std::to_string(bins));
        parameters_.headingBins = bins;
    }

    unsigned int ImprovedAStar::getHeadingBins() const
    {
        return parameters_.headingBins;
    }

    void ImprovedAStar::setSteeringAngles(unsigned int count)
    {
        if (count < 3 || count > 21 || count % 2 == 0)
            throw Exception("ImprovedAStar",
                            "steering_angles must be an odd number between 3 and 21, not " + std::to_string(count));
        parameters_.steeringAngles = count;
    }

    unsigned int ImprovedAStar::getSteeringAngles() const
    {
        return parameters_.steeringAngles;
    }

    void ImprovedAStar::setHeuristicWeightFar(double weight)
    {
        parameters_.weights.far = checked("heuristic_weight_far", weight, 0.0, "a number of at least 0");
    }

    double ImprovedAStar::getHeuristicWeightFar() const
    {
        return parameters_.weights.far;
    }

    void ImprovedAStar::setHeuristicWeightNear(double weight)
    {
        parameters_.weights.near = checked("heuristic_weight_near", weight, 0.0, "a number of at least 0");
    }

    double ImprovedAStar::getHeuristicWeightNear() const
    {
        return parameters_.weights.near;
    }

    void ImprovedAStar::setNearGoalDistance(double distance)
    {
        parameters_.weights.nearDistance =
            checked("near_goal_distance", distance, 0.0, "a number of metres of at least 0");
    }

    double ImprovedAStar::getNearGoalDistance() const
    {
        return parameters_.weights.nearDistance;
    }

    void ImprovedAStar::setTieBreak(double offset)
    {
        parameters_.weights.tieBreak = checked("tie_break", offset, 0.0, "a number of at least 0");
    }

    double ImprovedAStar::getTieBreak() const
    {
        return parameters_.weights.tieBreak;
    }

    void ImprovedAStar::setOpenList(const std::string &kind)
    {
        parameters_.openList = choice("open_list", kind, {"binary_heap", "linear"}) == "linear"
                                   ? OpenListKind::Linear
                                   : OpenListKind::BinaryHeap;
    }

    std::string ImprovedAStar::getOpenList() const
    {
        return parameters_.openList == OpenListKind::Linear ? "linear" : "binary_heap";
    }

    void ImprovedAStar::setBidirectional(bool enable)
    {
        parameters_.bidirectional = enable;
    }

    bool ImprovedAStar::getBidirectional() const
    {
        return parameters_.bidirectional;
    }

    void ImprovedAStar::setSearchFrom(const std::string &side)
    {
        parameters_.searchFromGoal = choice("search_from", side, {"goal", "start"}) == "goal";
    }

    std::string ImprovedAStar::getSearchFrom() const
    {
        return parameters_.searchFromGoal ? "goal" : "start";
    }

    void ImprovedAStar::setAdaptiveResolution(bool enable)
    {
        parameters_.adaptiveResolution = enable;
    }

    bool ImprovedAStar::getAdaptiveResolution() const
    {
        return parameters_.adaptiveResolution;
    }

    void ImprovedAStar::setObstacleHeuristic(bool enable)
    {
        parameters_.obstacleHeuristic = enable;
    }

    bool ImprovedAStar::getObstacleHeuristic() const
    {
        return parameters_.obstacleHeuristic;
    }

    void ImprovedAStar::setObstacleLoading(const std::string &loading)
    {
        parameters_.eagerObstacles = choice("obstacle_loading", loading, {"lazy", "eager"}) == "eager";
    }

    std::string ImprovedAStar::getObstacleLoading() const
    {
        return parameters_.eagerObstacles ? "eager" : "lazy";
    }

    void ImprovedAStar::setSmoothing(const std::string &smoothing)
    {
        parameters_.bsplineSmoothing = choice("smoothing", smoothing, {"bspline", "none"}) == "bspline";
    }

    std::string ImprovedAStar::getSmoothing() const
    {
        return parameters_.bsplineSmoothing ? "bspline" : "none";
    }

    void ImprovedAStar::setShortening(bool enable)
    {
        parameters_.shortening = enable;
    }

    bool ImprovedAStar::getShortening() const
    {
        return parameters_.shortening;
    }

    void ImprovedAStar::setApproximate(bool enable)
    {
        parameters_.approximate = enable;
    }

    bool ImprovedAStar::getApproximate() const
    {
        return parameters_.approximate;
    }

    void ImprovedAStar::setReversePenalty(double penalty)
    {
        parameters_.reversePenalty = checked("reverse_penalty", penalty, 0.0, "a number of at least 0");
    }

    double ImprovedAStar::getReversePenalty() const
    {
        return parameters_.reversePenalty;
    }

    void ImprovedAStar::setGearChangePenalty(double penalty)
    {
        parameters_.gearChangePenalty = checked("gear_change_penalty", penalty, 0.0, "a number of at least 0");
    }

    double ImprovedAStar::getGearChangePenalty() const
    {
        return parameters_.gearChangePenalty;
    }

    void ImprovedAStar::setSteeringChangePenalty(double penalty)
    {
        parameters_.steeringChangePenalty = checked("steering_change_penalty", penalty, 0.0, "a number of at least 0");
    }

    double ImprovedAStar::getSteeringChangePenalty() const
    {
        return parameters_.steeringChangePenalty;
    }

    void ImprovedAStar::setClearanceWeight(double weight)
    {
        parameters_.clearanceWeight = checked("clearance_weight", weight, 0.0, "a number of at least 0");
    }

    double ImprovedAStar::getClearanceWeight() const
    {
        return parameters_.clearanceWeight;
    }

    void ImprovedAStar::setAnalyticExpansion(bool enable)
    {
        parameters_.analyticExpansion = enable;
    }

    bool ImprovedAStar::getAnalyticExpansion() const
    {
        return parameters_.analyticExpansion;
    }

    void ImprovedAStar::setAnytime(bool enable)
    {
        parameters_.anytime = enable;
    }

    bool ImprovedAStar::getAnytime() const
    {
        return parameters_.anytime;
    }

    void ImprovedAStar::setParameterSet(const std::string &name)
    {
        try
        {
            parameters_ = parking::parameterSet(name, parameters_);
        }
        catch (const parking::Error &error)
        {
            throw Exception("ImprovedAStar", error.what());
        }
        parameterSet_ = name;
    }

    std::string ImprovedAStar::getParameterSet() const
    {
        return parameterSet_;
    }

    void ImprovedAStar::declareParameters()
    {
        using P = ImprovedAStar;
        // First of all, so that a file of parameters can start from a set and change some of it.
        std::string sets;
        for (const std::string &name : parking::parameterSetNames())
            sets += (sets.empty() ? "" : ",") + name;
        declareParam<std::string>("parameter_set", this, &P::setParameterSet, &P::getParameterSet, sets);
        declareParam<bool>("adaptive_resolution", this, &P::setAdaptiveResolution, &P::getAdaptiveResolution, "0,1");
        declareParam<bool>("analytic_expansion", this, &P::setAnalyticExpansion, &P::getAnalyticExpansion, "0,1");
        declareParam<bool>("anytime", this, &P::setAnytime, &P::getAnytime, "0,1");
        declareParam<bool>("approximate", this, &P::setApproximate, &P::getApproximate, "0,1");
        declareParam<bool>("bidirectional", this, &P::setBidirectional, &P::getBidirectional, "0,1");
        declareParam<double>("clearance_weight", this, &P::setClearanceWeight, &P::getClearanceWeight, "0.:.1:10.");
        declareParam<double>("gear_change_penalty", this, &P::setGearChangePenalty, &P::getGearChangePenalty,
                             "0.:.1:10.");
        declareParam<unsigned int>("heading_bins", this, &P::setHeadingBins, &P::getHeadingBins, "8:8:1440");
        declareParam<double>("heuristic_weight_far", this, &P::setHeuristicWeightFar, &P::getHeuristicWeightFar,
                             "0.:.1:10.");
        declareParam<double>("heuristic_weight_near", this, &P::setHeuristicWeightNear, &P::getHeuristicWeightNear,
                             "0.:.1:10.");
        declareParam<std::string>("motion_model", this, &P::setMotionModel, &P::getMotionModel, "car,grid8,grid16");
        declareParam<double>("near_goal_distance", this, &P::setNearGoalDistance, &P::getNearGoalDistance,
                             "0.:1.:100.");
        declareParam<bool>("obstacle_heuristic", this, &P::setObstacleHeuristic, &P::getObstacleHeuristic, "0,1");
        declareParam<std::string>("obstacle_loading", this, &P::setObstacleLoading, &P::getObstacleLoading,
                                  "lazy,eager");
        declareParam<std::string>("open_list", this, &P::setOpenList, &P::getOpenList, "binary_heap,linear");
        declareParam<double>("reverse_penalty", this, &P::setReversePenalty, &P::getReversePenalty, "0.:.1:10.");
        declareParam<std::string>("search_from", this, &P::setSearchFrom, &P::getSearchFrom, "goal,start");
        declareParam<bool>("shortening", this, &P::setShortening, &P::getShortening, "0,1");
        declareParam<std::string>("smoothing", this, &P::setSmoothing, &P::getSmoothing, "bspline,none");
        declareParam<unsigned int>("steering_angles", this, &P::setSteeringAngles, &P::getSteeringAngles, "3:2:21");
        declareParam<double>("steering_change_penalty", this, &P::setSteeringChangePenalty,
                             &P::getSteeringChangePenalty, "0.:.1:10.");
        declareParam<double>("tie_break", this, &P::setTieBreak, &P::getTieBreak, "0.:.001:.1");
        declareParam<double>("turning_radius", this, &P::setTurningRadius, &P::getTurningRadius, "0.1:.1:100.");
        declareParam<double>("xy_resolution", this, &P::setXyResolution, &P::getXyResolution, "0.:.05:5.");
    }
}  // namespace ompl::geometric
