#include "benchmarks/system/LongStep.h"

#include "benchmarks/system/Progress.h"

#include <iostream>
#include <utility>

#include <unistd.h>

namespace parking
{
    namespace
    {
        constexpr std::chrono::milliseconds LONG{500}, INTERVAL{200};
    }  // namespace

    LongStep::LongStep(std::string what) : what_(std::move(what)), begin_(std::chrono::steady_clock::now())
    {
        if (isatty(STDERR_FILENO) == 1)
            teller_ = std::thread([this] { tell(); });
    }

    LongStep::~LongStep()
    {
        if (!teller_.joinable())
            return;
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            isOver_ = true;
        }
        over_.notify_one();
        teller_.join();
    }

    void LongStep::tell()
    {
        std::unique_lock<std::mutex> lock(mutex_);
        std::size_t width = 0;
        const auto isOver = [this]
        {
            return isOver_;
        };
        for (std::chrono::milliseconds wait = LONG; !over_.wait_for(lock, wait, isOver); wait = INTERVAL)
        {
            const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begin_;
            const std::string text = what_ + ", " + duration(gone.count());
            width = std::max(width, text.size());
            std::cerr << '\r' << text << std::string(width - text.size(), ' ') << std::flush;
        }
        if (width > 0)
            std::cerr << '\r' << std::string(width, ' ') << '\r' << std::flush;
    }
}  // namespace parking
