#include "benchmarks/planners/SolveRecord.h"

#include "benchmarks/system/ProcessorTime.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace parking
{
    namespace
    {
        std::atomic<bool> countsProcessorTime{false};

        constexpr double LOOK = 0.05;  // maximum seconds between two checks of the clock

        /** Time in seconds in which this thread was ready to run but had no processor; infinite if the kernel does not
         report it. */
        double queuedTime()
        {
            std::ifstream stream("/proc/thread-self/schedstat");
            double ran = 0.0, queued = 0.0;
            return stream >> ran >> queued ? 1e-9 * queued : std::numeric_limits<double>::infinity();
        }

        /** Time in seconds of the clock that countProcessorTime() selected. */
        double clockTime()
        {
            if (countsProcessorTime.load(std::memory_order_relaxed))
                return processorTime();
            return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
        }
    }  // namespace

    void SolveRecord::countProcessorTime(bool processorTime)
    {
        countsProcessorTime = processorTime;
    }

    bool SolveRecord::isByProcessorTime()
    {
        return countsProcessorTime;
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
        begin_ = clockTime();
        nextLook_ = steadyBegin_;
    }

    void SolveRecord::end()
    {
        const double now = clockTime();
        const double cpu = processorTime();
        const std::lock_guard<std::mutex> lock(mutex_);
        wallTime_ = now - begin_;
        cpuTime_ = cpu - cpuBegin_;
    }

    void SolveRecord::note(double cost)
    {
        const double now = clockTime();
        const std::lock_guard<std::mutex> lock(mutex_);
        add(now - begin_, cost);
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
        const double left = seconds - (clockTime() - begin_);
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
}  // namespace parking
