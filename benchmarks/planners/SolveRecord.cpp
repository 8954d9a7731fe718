#include "benchmarks/planners/SolveRecord.h"

#include <cmath>
#include <limits>

namespace parking
{
    namespace
    {
        std::timespec processorTime()
        {
            std::timespec now{};
            clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
            return now;
        }
    }  // namespace

    void SolveRecord::begin()
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        improvements_.clear();
        wallTime_ = cpuTime_ = 0.0;
        cpuBegin_ = processorTime();
        begin_ = Clock::now();
    }

    void SolveRecord::end()
    {
        const Clock::time_point now = Clock::now();
        const std::timespec cpu = processorTime();
        const std::lock_guard<std::mutex> lock(mutex_);
        wallTime_ = std::chrono::duration<double>(now - begin_).count();
        cpuTime_ = static_cast<double>(cpu.tv_sec - cpuBegin_.tv_sec) +
                   1e-9 * static_cast<double>(cpu.tv_nsec - cpuBegin_.tv_nsec);
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
