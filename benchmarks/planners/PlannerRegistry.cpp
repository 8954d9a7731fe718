#include "benchmarks/planners/PlannerRegistry.h"

#include "benchmarks/planners/KinodynamicPlanner.h"
#include "benchmarks/planners/ReedsSheppPlanner.h"
#include "benchmarks/planners/TextbookHybridAStar.h"
#include "ompl_improved_astar/ImprovedAStar.h"
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/ompl/OmplPose.h"

#include <ompl/control/planners/est/EST.h>
#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/pdst/PDST.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>
#include <ompl/control/planners/syclop/GridDecomposition.h>
#include <ompl/control/planners/syclop/SyclopEST.h>
#include <ompl/control/planners/syclop/SyclopRRT.h>
#include <ompl/geometric/planners/AnytimePathShortening.h>
#include <ompl/geometric/planners/cforest/CForest.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/est/ProjEST.h>
#include <ompl/geometric/planners/fmt/BFMT.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/BKPIECE1.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/kpiece/LBKPIECE1.h>
#include <ompl/geometric/planners/pdst/PDST.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/prm/SPARS.h>
#include <ompl/geometric/planners/prm/SPARStwo.h>
#include <ompl/geometric/planners/rlrt/BiRLRT.h>
#include <ompl/geometric/planners/rlrt/RLRT.h>
#include <ompl/geometric/planners/rrt/BiTRRT.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/LBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyRRT.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/SORRTstar.h>
#include <ompl/geometric/planners/rrt/TRRT.h>
#include <ompl/geometric/planners/sbl/SBL.h>
#include <ompl/geometric/planners/sst/SST.h>
#include <ompl/geometric/planners/stride/STRIDE.h>
#include <ompl/util/Exception.h>

// Newer than some of the supported versions of OMPL.
#if __has_include(<ompl/geometric/planners/informedtrees/EITstar.h>)
#include <ompl/geometric/planners/informedtrees/EITstar.h>
#define PARKING_HAVE_EITSTAR
#endif
#if __has_include(<ompl/geometric/planners/rrt/AORRTC.h>)
#include <ompl/geometric/planners/rrt/AORRTC.h>
#define PARKING_HAVE_AORRTC
#endif
#if __has_include(<ompl/geometric/planners/lazyinformedtrees/BLITstar.h>)
#include <ompl/geometric/planners/lazyinformedtrees/BLITstar.h>
#define PARKING_HAVE_BLITSTAR
#endif

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

namespace oc = ompl::control;
namespace og = ompl::geometric;

namespace parking
{
    namespace
    {
        constexpr const char *CONTROL = "control_";  ///< begins the names of planners with controls

        /** The significant part of a name: lower-case letters and digits, * as "star". */
        std::string keyOf(const std::string &name)
        {
            std::string key;
            for (const char c : lowerCase(name))
            {
                if (c == '*')
                    key += "star";
                else if (c != '_' && c != '-' && c != ' ')
                    key += c;
            }
            // Names in OMPL.app's files.
            constexpr const char *KPIECE = "kpiece";
            if (key.size() >= 6 && key.compare(key.size() - 6, 6, KPIECE) == 0)
                return key + "1";
            return key == "spars2" ? "sparstwo" : key == "aps" ? "anytimepathshortening" : key;
        }

        template <class Planner>
        PlannerEntry entry(const std::string &name, const std::string &summary, bool optimizing = false,
                           PlannerSettings settings = {})
        {
            return {name, summary, optimizing,
                    [](const ompl::base::SpaceInformationPtr &si) { return std::make_shared<Planner>(si); },
                    std::move(settings)};
        }

        /** A planner of OMPL's control space. */
        PlannerEntry controlEntry(const std::string &name, const std::string &summary,
                                  const KinodynamicPlanner::Maker &make)
        {
            return {CONTROL + name,
                    summary,
                    false,
                    [=](const ompl::base::SpaceInformationPtr &si)
                    { return std::make_shared<KinodynamicPlanner>(si, CONTROL + name, make); },
                    {}};
        }

        template <class Planner>
        ompl::base::PlannerPtr make(const oc::SpaceInformationPtr &si)
        {
            return std::make_shared<Planner>(si);
        }

        /** Squares of the plane, which a Syclop planner searches for a lead. */
        class Squares : public oc::GridDecomposition
        {
        public:
            explicit Squares(const ompl::base::SpaceInformation &si)
              : oc::GridDecomposition(LENGTH, 2, si.getStateSpace()->as<ompl::base::SE2StateSpace>()->getBounds())
            {
            }

            void project(const ompl::base::State *state, std::vector<double> &position) const override
            {
                const Pose pose = poseOf(state);
                position = {pose.x, pose.y};
            }

            void sampleFullState(const ompl::base::StateSamplerPtr &sampler, const std::vector<double> &position,
                                 ompl::base::State *state) const override
            {
                sampler->sampleUniform(state);
                setPose(state, {position[0], position[1], poseOf(state).yaw});
            }

        private:
            static constexpr int LENGTH = 32;  // of OMPL.app
        };

        template <class Planner>
        ompl::base::PlannerPtr makeSyclop(const oc::SpaceInformationPtr &si)
        {
            return std::make_shared<Planner>(si, std::make_shared<Squares>(*si));
        }

#ifdef PARKING_HAVE_AORRTC
        /** AORRTC of OMPL 2.0.2 crashes when cleared or destroyed before setup. It passes no solutions to its
           objective: their time is unknown. */
        class Aorrtc : public og::AORRTC
        {
        public:
            explicit Aorrtc(const ompl::base::SpaceInformationPtr &si) : og::AORRTC(si)
            {
                aox_planner = std::make_shared<og::AOXRRTConnect>(si);
            }

            using og::AORRTC::solve;

            ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &ptc) override
            {
                std::size_t known = 0;
                const auto reportSolution = [&]
                {
                    if (pdef_->getSolutionCount() == known || !pdef_->hasExactSolution())
                        return;
                    known = pdef_->getSolutionCount();
                    if (const auto objective = pdef_->getOptimizationObjective())
                        objective->isSatisfied(pdef_->getSolutionPath()->cost(objective));
                };
                return og::AORRTC::solve(ompl::base::PlannerTerminationCondition(
                    [&]
                    {
                        reportSolution();
                        return ptc();
                    }));
            }
        };
#endif

        template <class... Types>
        bool isOneOf(const ompl::base::GenericParam &parameter)
        {
            return (... || (dynamic_cast<const ompl::base::SpecificParam<Types> *>(&parameter) != nullptr));
        }

        constexpr double GREATEST_INT = std::numeric_limits<short>::max();  // enough for any parameter with a sign

        std::size_t greatest(const ompl::base::GenericParam &parameter)
        {
            if (isOneOf<unsigned short>(parameter))
                return std::numeric_limits<unsigned short>::max();
            return isOneOf<unsigned int>(parameter) ? std::numeric_limits<unsigned int>::max()
                                                    : std::numeric_limits<std::size_t>::max();
        }

        /** The text to set \e parameter to, or an empty one when \e value has another type.

            OMPL accepts values that merely begin like a number, and reads -1 as the largest unsigned number. */
        std::string checkedValue(const ompl::base::GenericParam &parameter, const std::string &value)
        {
            if (isOneOf<bool>(parameter))
            {
                const std::string word = lowerCase(value);
                if (word == "1" || word == "true" || word == "yes" || word == "on")
                    return "1";
                return word == "0" || word == "false" || word == "no" || word == "off" ? "0" : "";
            }
            double number = 0.0;
            if (isOneOf<float, double, long double>(parameter))
                return parseNumber(value, number) ? value : "";
            // A number too large for the type would be stored as another one.
            if (isOneOf<unsigned int, unsigned long, unsigned long long, unsigned short>(parameter))
            {
                std::size_t count = 0;
                return parseCount(value, count) && count <= greatest(parameter) ? value : "";
            }
            if (isOneOf<int, long, long long, short>(parameter))
                return parseNumber(value, number) && number == std::trunc(number) && std::abs(number) <= GREATEST_INT
                           ? value
                           : "";
            return value;
        }

        void applySetting(ompl::base::Planner &planner, const std::string &name, const std::string &value)
        {
            ompl::base::ParamSet &parameters = planner.params();
            if (!parameters.hasParam(name))
            {
                if (dynamic_cast<const og::ImprovedAStar *>(&planner) != nullptr)
                    checkNotRemoved(name);
                std::map<std::string, std::string> all;
                parameters.getParams(all);
                std::vector<std::string> names;
                for (const auto &each : all)
                    names.push_back(each.first);
                if (names.empty())
                    throw Error("planner " + planner.getName() + " has no parameters: cannot set " + inQuotes(name));
                throw Error(unknownName("parameter of " + planner.getName(), name, names));
            }
            const std::string wanted =
                "parameter " + name + " of " + planner.getName() + " cannot be " + inQuotes(value);
            const std::string range = parameters[name].getRangeSuggestion();
            try
            {
                const std::string checked = checkedValue(parameters[name], value);
                if (checked.empty() || !parameters.setParam(name, checked))
                    throw Error(wanted + (range.empty() ? "" : "; usual values: " + range));
            }
            catch (const ompl::Exception &error)
            {
                throw Error(wanted + ": " + oneLine(error.what()));
            }
        }
    }  // namespace

    PlannerRegistry PlannerRegistry::builtIn()
    {
        PlannerRegistry registry;
        registry.add(entry<og::ImprovedAStar>("improved_astar", "improved A* of this project"));
        registry.add(entry<og::ImprovedAStar>("hybrid_astar",
                                              "Hybrid A*: the search of improved A* without its improvements", false,
                                              {{"parameter_set", "hybrid_astar"}}));
        registry.add(entry<TextbookHybridAStar>("textbook_hybrid_astar", "standard Hybrid A* on a uniform lattice"));
        registry.add(entry<ReedsSheppPlanner>("reeds_shepp", "the Reeds-Shepp curve alone, checked"));
        registry.add(entry<og::RRTstar>("RRTstar", "OMPL's RRT*", true));
        registry.add(entry<og::InformedRRTstar>("InformedRRTstar", "OMPL's Informed RRT*", true));
        registry.add(entry<og::PRM>("PRM", "OMPL's PRM, to the first solution"));
        registry.add(entry<og::PRMstar>("PRMstar", "OMPL's PRM*", true));
        registry.add(entry<og::LazyPRM>("LazyPRM", "OMPL's LazyPRM, to the first solution"));
        registry.add(entry<og::LazyPRMstar>("LazyPRMstar", "OMPL's LazyPRM*", true));
        registry.add(entry<og::RRT>("RRT", "OMPL's RRT"));
        registry.add(entry<og::RRTConnect>("RRTConnect", "OMPL's RRTConnect"));
        registry.add(entry<og::BITstar>("BITstar", "OMPL's BIT*", true));
        registry.add(entry<og::ABITstar>("ABITstar", "OMPL's ABIT*", true));
        registry.add(entry<og::AITstar>("AITstar", "OMPL's AIT*", true));
        registry.add(entry<og::KPIECE1>("KPIECE1", "OMPL's KPIECE"));
        registry.add(entry<og::BKPIECE1>("BKPIECE1", "OMPL's bidirectional KPIECE"));
        registry.add(entry<og::LBKPIECE1>("LBKPIECE1", "OMPL's lazy bidirectional KPIECE"));
        registry.add(entry<og::SBL>("SBL", "OMPL's SBL"));
        registry.add(entry<og::EST>("EST", "OMPL's EST"));
        registry.add(entry<og::BiEST>("BiEST", "OMPL's bidirectional EST"));
        registry.add(entry<og::SST>("SST", "OMPL's SST", true));
        registry.add(entry<og::LazyRRT>("LazyRRT", "OMPL's lazy RRT"));
        registry.add(entry<og::TRRT>("TRRT", "OMPL's T-RRT"));
        registry.add(entry<og::BiTRRT>("BiTRRT", "OMPL's bidirectional T-RRT"));
        registry.add(entry<og::LBTRRT>("LBTRRT", "OMPL's LBT-RRT", true));
        // Not LazyLBTRRT, whose assertions fail.
        registry.add(entry<og::RRTXstatic>("RRTXstatic", "OMPL's RRTX without changes of the world", true));
        registry.add(entry<og::RRTsharp>("RRTsharp", "OMPL's RRT#", true));
        registry.add(entry<og::SORRTstar>("SORRTstar", "OMPL's SORRT*", true));
        registry.add(entry<og::RLRT>("RLRT", "OMPL's range-limited random tree"));
        registry.add(entry<og::BiRLRT>("BiRLRT", "OMPL's bidirectional range-limited random tree"));
        registry.add(entry<og::ProjEST>("ProjEST", "OMPL's EST with a projection"));
        registry.add(entry<og::STRIDE>("STRIDE", "OMPL's STRIDE"));
        registry.add(entry<og::PDST>("PDST", "OMPL's PDST"));
        registry.add(entry<og::SPARS>("SPARS", "OMPL's SPARS", true));
        registry.add(entry<og::SPARStwo>("SPARStwo", "OMPL's SPARS2", true));
        registry.add(entry<og::FMT>("FMT", "OMPL's FMT*"));
        registry.add(entry<og::BFMT>("BFMT", "OMPL's bidirectional FMT*"));
        registry.add(entry<og::CForest>("CForest", "OMPL's C-FOREST of RRT* on several threads", true));
        registry.add(entry<og::AnytimePathShortening>(
            "AnytimePathShortening", "OMPL's shortening of RRTConnect's paths on several threads", true));
#ifdef PARKING_HAVE_EITSTAR
        registry.add(entry<og::EITstar>("EITstar", "OMPL's EIT*", true));
#endif
#ifdef PARKING_HAVE_AORRTC
        registry.add(entry<Aorrtc>("AORRTC", "OMPL's AORRTC", true));
#endif
#ifdef PARKING_HAVE_BLITSTAR
        registry.add(entry<og::BLITstar>("BLITstar", "OMPL's BLIT*", true));
#endif
        registry.add(controlEntry("RRT", "OMPL's RRT of controls, with the bicycle model", make<oc::RRT>));
        registry.add(controlEntry("SST", "OMPL's SST of controls, to the first solution", make<oc::SST>));
        registry.add(controlEntry("KPIECE1", "OMPL's KPIECE of controls", make<oc::KPIECE1>));
        registry.add(controlEntry("EST", "OMPL's EST of controls", make<oc::EST>));
        registry.add(controlEntry("PDST", "OMPL's PDST of controls", make<oc::PDST>));
        registry.add(controlEntry("SyclopRRT", "OMPL's Syclop with RRT", makeSyclop<oc::SyclopRRT>));
        registry.add(controlEntry("SyclopEST", "OMPL's Syclop with EST", makeSyclop<oc::SyclopEST>));
        return registry;
    }

    void PlannerRegistry::add(PlannerEntry entry)
    {
        if (entry.name.empty() || !std::all_of(entry.name.begin(), entry.name.end(),
                                               [](unsigned char c) {
                                                   return std::isalnum(c) != 0 ||
                                                          std::string("_.+-").find(static_cast<char>(c)) !=
                                                              std::string::npos;
                                               }))
            throw Error("the name of a planner must consist of letters, digits and _ . + -, and " +
                        inQuotes(entry.name) + " does not");
        if (!entry.allocate)
            throw Error("planner " + entry.name + " has no allocator");
        if (const auto known = lookUp(entry.name); known != entries_.end())
            throw Error("another planner already has the name " + known->name);
        entries_.push_back(std::move(entry));
    }

    std::vector<PlannerEntry>::const_iterator PlannerRegistry::lookUp(const std::string &name) const
    {
        return std::find_if(entries_.begin(), entries_.end(),
                            [key = keyOf(name)](const PlannerEntry &each) { return keyOf(each.name) == key; });
    }

    const PlannerEntry &PlannerRegistry::find(const std::string &name) const
    {
        const auto found = lookUp(name);
        if (found == entries_.end())
            throw Error(unknownName("planner", name, names()) + " (see --help)");
        return *found;
    }

    const PlannerEntry &PlannerRegistry::findWithControls(const std::string &name) const
    {
        const auto found = lookUp(CONTROL + name);
        return found == entries_.end() ? find(name) : *found;
    }

    std::vector<std::string> PlannerRegistry::names() const
    {
        std::vector<std::string> list;
        for (const PlannerEntry &each : entries_)
            list.push_back(each.name);
        return list;
    }

    void applySettings(ompl::base::Planner &planner, const PlannerSettings &settings)
    {
        for (const bool sets : {true, false})
            for (const auto &[name, value] : settings)
                try
                {
                    if ((name == "parameter_set") == sets)
                        applySetting(planner, name, value);
                }
                catch (const Error &error)
                {
                    throw SettingError({name}, error.what());
                }
    }
}  // namespace parking
