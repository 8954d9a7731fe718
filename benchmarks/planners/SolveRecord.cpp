#include "benchmarks/planners/SolveRecord.h"

#include "benchmarks/system/ProcessorTime.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/ompl/OmplPose.h"

#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <limits>
#include <new>

namespace parking
{
    namespace
    {
        constexpr double FARTHEST = 1e6;  // metres; assertions of OMPL about Reeds-Shepp curves fail far beyond

        std::atomic<bool> countsProcessorTime{false};

        constexpr double LOOK = 0.05;  // seconds between two looks at the clock, at most

        /** Seconds in which this thread could have run and had no processor; infinite where the kernel does not tell.
         */
        double queuedTime()
        {
            std::ifstream stream("/proc/thread-self/schedstat");
            double ran = 0.0, queued = 0.0;
            return stream >> ran >> queued ? 1e-9 * queued : std::numeric_limits<double>::infinity();
        }
    }  // namespace

    SolveRecord::Clock::time_point SolveRecord::Clock::now()
    {
        if (!countsProcessorTime.load(std::memory_order_relaxed))
            return time_point(std::chrono::steady_clock::now().time_since_epoch());
        return time_point(std::chrono::duration_cast<duration>(std::chrono::duration<double>(processorTime())));
    }

    void SolveRecord::Clock::countProcessorTime(bool processorTime)
    {
        countsProcessorTime = processorTime;
    }

    void SolveRecord::begin()
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        improvements_.clear();
        wallTime_ = cpuTime_ = 0.0;
        cpuBegin_ = processorTime();
        thread_ = std::this_thread::get_id();
        steadyBegin_ = std::chrono::steady_clock::now();
        queuedBefore_ = countsProcessorTime ? queuedTime() : 0.0;
        begin_ = Clock::now();
        nextLook_ = steadyBegin_;
    }

    void SolveRecord::end()
    {
        const Clock::time_point now = Clock::now();
        const double cpu = processorTime();
        const std::lock_guard<std::mutex> lock(mutex_);
        wallTime_ = std::chrono::duration<double>(now - begin_).count();
        cpuTime_ = cpu - cpuBegin_;
    }

    void SolveRecord::note(double cost)
    {
        const Clock::time_point now = Clock::now();
        const std::lock_guard<std::mutex> lock(mutex_);
        add(std::chrono::duration<double>(now - begin_).count(), cost);
    }

    void SolveRecord::noteAtEnd(double cost)
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        add(wallTime_, cost);
    }

    void SolveRecord::add(double time, double cost)
    {
        if (std::isfinite(cost) && (improvements_.empty() || cost < improvements_.back().cost))
            improvements_.push_back({time, cost});
    }

    double SolveRecord::wallTime() const
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        return wallTime_;
    }

    double SolveRecord::cpuTime() const
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        return cpuTime_;
    }

    double SolveRecord::bestCost() const
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        return improvements_.empty() ? std::numeric_limits<double>::infinity() : improvements_.back().cost;
    }

    std::vector<Improvement> SolveRecord::improvements() const
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        return improvements_;
    }

    bool SolveRecord::isOver(double seconds)
    {
        using std::chrono::duration;
        using std::chrono::steady_clock;
        const steady_clock::time_point now = steady_clock::now();
        if (now < nextLook_.load(std::memory_order_relaxed))
            return false;
        static const double processors = std::max(1U, std::thread::hardware_concurrency());
        const bool byProcessorTime = countsProcessorTime.load(std::memory_order_relaxed);
        const std::lock_guard<std::mutex> lock(mutex_);
        const double left = seconds - duration<double>(Clock::now() - begin_).count();
        const duration<double> pause(std::min(byProcessorTime ? left / processors : left, LOOK));
        nextLook_ = now + std::chrono::duration_cast<steady_clock::duration>(pause);
        return left <= 0.0 || (byProcessorTime && hasSleptLongerThan(seconds));
    }

    bool SolveRecord::hasSleptLongerThan(double seconds) const
    {
        if (std::this_thread::get_id() != thread_)
            return false;
        const double awake = processorTime() - cpuBegin_;
        const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - steadyBegin_).count();
        return passed - awake > seconds && passed - awake - (queuedTime() - queuedBefore_) > seconds;
    }

    PlannerFailure currentFailure(const std::string &where)
    {
        try
        {
            throw;
        }
        catch (const std::bad_alloc &)
        {
            return {PlannerFailure::Kind::Memory, where + " found no memory"};
        }
        catch (const std::exception &error)
        {
            return {PlannerFailure::Kind::Exception, where + " threw: " + oneLine(error.what())};
        }
        catch (...)
        {
            return {PlannerFailure::Kind::Exception, where + " threw something that is no std::exception"};
        }
    }

    PlannerFailure failureOfAnswer(const ompl::base::ProblemDefinition &problem, bool exact)
    {
        const auto nonsense = [](const std::string &text)
        {
            return PlannerFailure{PlannerFailure::Kind::Nonsense, text};
        };
        const ompl::base::PathPtr path = problem.getSolutionPath();
        if (!path)
            return exact ? nonsense("it speaks of an exact solution, but there is no path") : PlannerFailure();
        const auto *states = dynamic_cast<const ompl::geometric::PathGeometric *>(path.get());
        if (states == nullptr)
            return nonsense("its path is of a kind that nobody here knows");
        if (states->getStateCount() == 0)
            return nonsense("its path has no states");
        for (unsigned int i = 0; i < states->getStateCount(); ++i)
        {
            const ompl::base::State *state = states->getState(i);
            if (state == nullptr)
                return nonsense("state " + std::to_string(i) + " of its path is null");
            const Pose pose = poseOf(state);
            if (!(std::abs(pose.x) <= FARTHEST && std::abs(pose.y) <= FARTHEST && std::abs(pose.yaw) <= FARTHEST))
                return nonsense("state " + std::to_string(i) + " of its path is nowhere: " + formatNumber(pose.x) +
                                ", " + formatNumber(pose.y) + ", " + formatNumber(pose.yaw));
        }
        return {};
    }

    RecordingObjective::RecordingObjective(const ompl::base::SpaceInformationPtr &si,
                                           std::shared_ptr<SolveRecord> record)
      : ompl::base::PathLengthOptimizationObjective(si),
        record_(std::move(record))
    {
        description_ = "Path Length";
    }

    bool RecordingObjective::isSatisfied(ompl::base::Cost cost) const
    {
        record_->note(cost.value());
        return ompl::base::PathLengthOptimizationObjective::isSatisfied(cost);
    }
}  // namespace parking
