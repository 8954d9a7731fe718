#include "benchmarks/planners/PlannerRegistry.h"

#include "benchmarks/planners/KinodynamicPlanner.h"
#include "benchmarks/planners/ReedsSheppPlanner.h"
#include "benchmarks/planners/TextbookHybridAStar.h"
#include "ompl_improved_astar/ImprovedAStar.h"
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"

#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/BKPIECE1.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/kpiece/LBKPIECE1.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/sbl/SBL.h>
#include <ompl/geometric/planners/sst/SST.h>
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
            if (key == "kpiece" || key == "bkpiece" || key == "lbkpiece")
                key += "1";  // names in OMPL.app's files
            return key;
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
        template <class Planner>
        PlannerEntry controlEntry(const std::string &name, const std::string &summary)
        {
            return {name,
                    summary,
                    false,
                    [name](const ompl::base::SpaceInformationPtr &si)
                    {
                        return std::make_shared<KinodynamicPlanner>(
                            si, name, [](const auto &controls) { return std::make_shared<Planner>(controls); });
                    },
                    {}};
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
#ifdef PARKING_HAVE_EITSTAR
        registry.add(entry<og::EITstar>("EITstar", "OMPL's EIT*", true));
#endif
#ifdef PARKING_HAVE_AORRTC
        registry.add(entry<Aorrtc>("AORRTC", "OMPL's AORRTC", true));
#endif
#ifdef PARKING_HAVE_BLITSTAR
        registry.add(entry<og::BLITstar>("BLITstar", "OMPL's BLIT*", true));
#endif
        registry.add(controlEntry<oc::RRT>("control_RRT", "OMPL's RRT of controls, with the bicycle model"));
        registry.add(controlEntry<oc::SST>("control_SST", "OMPL's SST of controls, to the first solution"));
        registry.add(controlEntry<oc::KPIECE1>("control_KPIECE1", "OMPL's KPIECE of controls"));
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
