#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Tells on standard error how far a comparison is, and how long the rest will take.

        On a terminal one line that changes; otherwise a line now and then. */
    class Progress
    {
    public:
        /** \brief \param planners of all runs still to be done, by name
            \param timeLimit seconds: what a planner is expected to take before it has run
            \param quiet say nothing */
        Progress(const std::vector<std::string> &planners, double timeLimit, bool quiet);
        ~Progress();
        Progress(const Progress &) = delete;
        Progress &operator=(const Progress &) = delete;

        /** \brief A run begins: names what is under way. */
        void begin(const std::string &experiment, const std::string &planner);

        /** \brief \param seconds that the run took, with everything round it */
        void end(const std::string &planner, double seconds);

        /** \brief Says something on a line of its own. */
        void note(const std::string &text);

    private:
        struct Count
        {
            std::size_t left{0};
            std::size_t done{0};
            double seconds{0.0};
        };

        double remaining() const;
        void say(const std::string &text, bool last);

        std::map<std::string, Count> counts_;
        std::size_t total_;
        std::size_t done_{0};
        double timeLimit_;
        bool quiet_;
        bool terminal_;
        std::size_t width_{0};
        std::chrono::steady_clock::time_point said_;
    };
}  // namespace parking
