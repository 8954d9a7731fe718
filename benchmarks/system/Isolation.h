#pragma once

#include <atomic>
#include <functional>
#include <string>

namespace parking
{
    /** \brief Limits of an isolated process. */
    struct IsolationLimits
    {
        double timeToHalf{0.0};  ///< seconds of wall-clock time until the work reports that it is half done
        double timeAfter{0.0};   ///< seconds of wall-clock time for the second half
        double memory{0.0};      ///< MB of data in addition to those at the beginning
    };

    /** \brief Result of work in an isolated process. */
    struct IsolatedResult
    {
        /** \brief Cause of the end of the process. */
        enum class End
        {
            Answered,     ///< the work returned its answer
            Exception,    ///< the work threw an exception
            Died,         ///< a signal ended it, or it called exit
            TimeUp,       ///< it exceeded its time limit
            OutOfMemory,  ///< it exceeded its memory limit
            Stopped       ///< the caller stopped it
        };
        End end{End::Died};    ///< cause of the end
        std::string text;      ///< the answer, or one line on the failure
        int status{-1};        ///< exit status of a process that called exit
        std::string errors{};  ///< the last line on standard error of a process that died
    };

    /** \brief Executes work in a copy of this process and waits for its answer. Failures of the work do not affect this
       process.

       Changes in memory are not visible here. The work's input is empty. Its output is discarded, except for the last
       line of errors, which the result contains if it dies. The process and its children end with this one.

       \param work receives a function to call when it is half done, and returns its answer: a line of text
       \param stop set to true to end the work
       Throws parking::Error when no process can be created. */
    IsolatedResult runIsolated(const std::function<std::string(const std::function<void()> &halfDone)> &work,
                               const IsolationLimits &limits, const std::atomic<bool> &stop);
}  // namespace parking
