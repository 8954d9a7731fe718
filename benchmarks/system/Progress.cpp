#include "benchmarks/system/Progress.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <unistd.h>

namespace parking
{
    namespace
    {
        constexpr double INTERVAL_TERMINAL = 0.2, INTERVAL_FILE = 15.0;  // seconds between lines

        /** 754 seconds as "12 min 34 s". */
        std::string duration(double seconds)
        {
            const auto whole = static_cast<long long>(std::llround(std::max(0.0, seconds)));
            if (whole < 60)
                return std::to_string(whole) + " s";
            if (whole < 3600)
                return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
            return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
        }
    }  // namespace

    Progress::Progress(const std::vector<std::string> &planners, double timeLimit, bool quiet)
      : total_(planners.size()),
        timeLimit_(timeLimit),
        quiet_(quiet),
        terminal_(isatty(STDERR_FILENO) == 1),
        printed_(std::chrono::steady_clock::now())
    {
        for (const std::string &planner : planners)
            ++counts_[planner].left;
    }

    Progress::~Progress()
    {
        if (!quiet_ && terminal_ && width_ > 0)
            std::cerr << std::endl;
    }

    double Progress::remaining() const
    {
        double sum = 0.0;
        for (const auto &[planner, count] : counts_)
            sum += static_cast<double>(count.left) *
                   (count.done > 0 ? count.seconds / static_cast<double>(count.done) : timeLimit_);
        return sum;
    }

    void Progress::begin(const std::string &experiment, const std::string &planner)
    {
        print(std::to_string(done_) + " of " + std::to_string(total_) + " runs, " + duration(remaining()) +
                  " left; now " + planner + " on " + experiment,
              false);
    }

    void Progress::end(const std::string &planner, double seconds)
    {
        Count &count = counts_[planner];
        --count.left;
        ++count.done;
        count.seconds += seconds;
        if (++done_ == total_)
            print(std::to_string(done_) + " of " + std::to_string(total_) + " runs", true);
    }

    void Progress::note(const std::string &text)
    {
        if (terminal_ && width_ > 0)
            std::cerr << std::endl;
        width_ = 0;
        std::cerr << text << std::endl;
    }

    void Progress::print(const std::string &text, bool last)
    {
        const auto now = std::chrono::steady_clock::now();
        const double interval = terminal_ ? INTERVAL_TERMINAL : INTERVAL_FILE;
        if (quiet_ || (!last && std::chrono::duration<double>(now - printed_).count() < interval))
            return;
        printed_ = now;
        if (!terminal_)
        {
            std::cerr << text << std::endl;
            return;
        }
        std::cerr << '\r' << text << std::string(width_ > text.size() ? width_ - text.size() : 0, ' ') << std::flush;
        width_ = text.size();
    }
}  // namespace parking
