#pragma once

#include "benchmarks/system/ExternalProgram.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <ompl/base/Planner.h>
#include <nlohmann/json.hpp>

namespace parking
{
    /** \brief What a Python file with a planner says about itself. */
    struct PythonPlannerFile
    {
        std::string file;           ///< absolute name
        std::string name;           ///< NAME of the module, otherwise the file's
        std::string summary;        ///< first line of its docstring
        bool improves{false};       ///< whether plan() is a generator: of paths, each shorter than the last
        nlohmann::json parameters;  ///< an object of default values: PARAMETERS of the module
    };

    /** \brief Loads a Python file in a process of its own and returns its description.
        Throws parking::Error with Python's message if it cannot be loaded or defines no plan(). */
    PythonPlannerFile readPythonPlanner(const std::string &file);

    /** \brief A planner written in Python (docs/benchmarking.md).

        Each solve() uses a new process, which setup() has already started, so that imports do not count as planning
       time. The process and its children are killed when solve() must end. Questions about free poses and motions are
       answered by the problem's checkers. */
    class PythonPlanner final : public ompl::base::Planner
    {
    public:
        /** \brief A planner with the parameters in \e description. Starts no process. */
        PythonPlanner(const ompl::base::SpaceInformationPtr &si, const PythonPlannerFile &description);

        /** \brief Starts Python. Throws ompl::Exception when the module cannot be loaded, for a footprint that is not
           the car's, and when processor time is measured, which does not include that of other processes. */
        void setup() override;

        /** \brief TIMEOUT when the planner returns no path or not in time; INVALID_START and INVALID_GOAL when none is
            free. Paths that do not end at a goal are approximate.
            Throws std::bad_alloc for Python's MemoryError, ompl::Exception with the last line of other exceptions. */
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &ptc) override;
        using ompl::base::Planner::solve;

        /** \brief Time limit in seconds to report to the planner, which is stopped by the termination condition. */
        void setTimeLimit(double seconds)
        {
            timeLimit_ = seconds;
        }

    private:
        template <class Value>
        void declare(const std::string &name);
        void start();
        nlohmann::json problem(const ompl::base::State *start,
                               const std::vector<const ompl::base::State *> &goals) const;
        nlohmann::json answer(const nlohmann::json &question, const ExternalProgram::Stop &stop) const;
        bool addPath(const nlohmann::json &poses, const std::vector<const ompl::base::State *> &goals);

        std::string file_;
        nlohmann::json parameters_;
        double timeLimit_{0.0};
        std::unique_ptr<ExternalProgram> program_;
    };
}  // namespace parking
