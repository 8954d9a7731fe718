#pragma once

#include <atomic>
#include <functional>
#include <string>

namespace parking
{
    /** \brief What a process of its own may take. */
    struct IsolationLimits
    {
        double timeToHalf{0.0};  ///< seconds of wall clock until the work says that it is half done
        double timeAfter{0.0};   ///< seconds from then on
        double memory{0.0};      ///< MB of data beyond what there is at the beginning
    };

    /** \brief How work in a process of its own ended. */
    struct IsolatedResult
    {
        /** \brief How the process ended. */
        enum class End
        {
            Answered,     ///< with the work's answer
            Exception,    ///< one left the work
            Died,         ///< of a signal, or it ended the process itself
            TimeUp,       ///< it took longer than it may, and was ended
            OutOfMemory,  ///< it took more memory than it may
            Stopped       ///< it was told to stop
        };
        End end{End::Died};    ///< how it ended
        std::string text;      ///< the answer, or one line on what happened
        int status{-1};        ///< exit status of a process that ended itself
        std::string errors{};  ///< the last line that it wrote to standard error, if it died
    };

    /** \brief Does work in a process of its own, a copy of this one, and waits for its answer: whatever the work does
       to its process, this one goes on.

        Nothing that the work changes in memory is seen here. It reads nothing, and what it prints is thrown away but
       for the last line of its errors, which is told when it dies. It ends with this process, and so do the processes
       that it has started.

        \param work is handed what it may call when it is half done, and returns its answer: a line of text
        \param stop once true, the work is ended
        Throws parking::Error when there can be no other process. */
    IsolatedResult runIsolated(const std::function<std::string(const std::function<void()> &halfDone)> &work,
                               const IsolationLimits &limits, const std::atomic<bool> &stop);
}  // namespace parking
