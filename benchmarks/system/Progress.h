#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Reports the progress of a comparison and its remaining time on standard error.
        On a terminal one line is updated; otherwise lines are printed at intervals. */
    class Progress
    {
    public:
        /** \brief \param planners names of all remaining runs' planners
            \param timeLimit expected time in seconds of a planner before its first run
            \param quiet whether to print nothing */
        Progress(const std::vector<std::string> &planners, double timeLimit, bool quiet);
        ~Progress();
        Progress(const Progress &) = delete;
        Progress &operator=(const Progress &) = delete;

        /** \brief Reports that a run begins. */
        void begin(const std::string &experiment, const std::string &planner);

        /** \brief Counts a finished run.

            \param planner name of the run's planner
            \param seconds time of the run, including preparation and processing */
        void end(const std::string &planner, double seconds);

        /** \brief Prints a message on a separate line. */
        void note(const std::string &text);

    private:
        struct Count
        {
            std::size_t left{0};
            std::size_t done{0};
            double seconds{0.0};
        };

        double remaining() const;
        void print(const std::string &text, bool last);

        std::map<std::string, Count> counts_;
        std::size_t total_;
        std::size_t done_{0};
        double timeLimit_;
        bool quiet_;
        bool terminal_;
        std::size_t width_{0};
        std::chrono::steady_clock::time_point printed_;
    };
}  // namespace parking
