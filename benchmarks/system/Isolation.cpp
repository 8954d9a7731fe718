#include "benchmarks/system/Isolation.h"

#include "benchmarks/system/ChildProcess.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <new>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace parking
{
    namespace
    {
        using Clock = std::chrono::steady_clock;
        using End = IsolatedResult::End;

        constexpr double BYTES = 1048576.0;        // in a MB
        constexpr int LONGEST_WAIT = 100;          // milliseconds between checks of the process and of stop
        constexpr std::size_t KEPT = 4096;         // maximum bytes kept of the error stream
        constexpr rlim_t LEAST = rlim_t(1) << 20;  // bytes

        // Messages of the process, each after a byte with its kind.
        constexpr char HALF_DONE = 'h', ANSWER = 'a', EXCEPTION = 'x', OUT_OF_MEMORY = 'm', LAST = '\n';

        int answers = -1;  // channel of the process of the work; in that process only

        void send(const char *text, std::size_t size)
        {
            while (size > 0)
            {
                const ssize_t count = write(answers, text, size);
                if (count < 0 && errno != EINTR)
                    return;
                text += std::max<ssize_t>(count, 0);
                size -= static_cast<std::size_t>(std::max<ssize_t>(count, 0));
            }
        }

        void send(char kind, const std::string &text)
        {
            const std::string line = kind + text + LAST;
            send(line.data(), line.size());
        }

        /** Reports exhausted memory without allocating any. */
        [[noreturn]] void endWithoutMemory()
        {
            const std::array<char, 2> text{OUT_OF_MEMORY, LAST};
            send(text.data(), text.size());
            _exit(EXIT_FAILURE);
        }

        void limitResources(double memory)
        {
            const rlimit none{0, 0};
            setrlimit(RLIMIT_CORE, &none);
            // The kernel compares pages of data and stack with the limit.
            std::ifstream file("/proc/self/statm");
            double size = 0.0, resident = 0.0, shared = 0.0, text = 0.0, library = 0.0, data = 0.0;
            if (!(file >> size >> resident >> shared >> text >> library >> data) || !(memory > 0.0))
                return;
            const double bytes = data * static_cast<double>(sysconf(_SC_PAGESIZE)) + memory * BYTES;
            if (bytes < 0.9 * static_cast<double>(RLIM_INFINITY))
            {
                const rlim_t limit = std::max(LEAST, static_cast<rlim_t>(bytes));
                const rlimit both{limit, limit};
                setrlimit(RLIMIT_DATA, &both);
            }
            std::set_new_handler(endWithoutMemory);
        }

        [[noreturn]] void work(const std::function<std::string(const std::function<void()> &)> &what, double memory)
        {
            try
            {
                limitResources(memory);
                send(ANSWER, what(
                                 []
                                 {
                                     const char text = HALF_DONE;
                                     send(&text, 1);
                                 }));
            }
            catch (const std::bad_alloc &)
            {
                endWithoutMemory();
            }
            catch (const std::exception &error)
            {
                send(EXCEPTION, oneLine(error.what()));
            }
            catch (...)
            {
                send(EXCEPTION, "an exception that is not a std::exception");
            }
            // Without destructors and exit handlers: they belong to the parent process.
            _exit(EXIT_SUCCESS);
        }

        /** A pipe that closes its ends. */
        struct Pipe
        {
            Pipe()
            {
                if (pipe2(ends.data(), O_CLOEXEC) != 0)
                    throw Error(std::string("a process for a run cannot be started: ") + std::strerror(errno));
            }
            ~Pipe()
            {
                closeEnd(0);
                closeEnd(1);
            }
            Pipe(const Pipe &) = delete;
            Pipe &operator=(const Pipe &) = delete;

            void closeEnd(std::size_t end)
            {
                if (ends[end] >= 0)
                    close(ends[end]);
                ends[end] = -1;
            }

            std::array<int, 2> ends{-1, -1};
        };

        /** Takes what is there; closes the end of a pipe that has no other any more. */
        void take(Pipe &pipe, std::string &text)
        {
            std::array<char, 65536> buffer;
            for (;;)
            {
                const ssize_t count = read(pipe.ends[0], buffer.data(), buffer.size());
                if (count > 0)
                {
                    text.append(buffer.data(), static_cast<std::size_t>(count));
                    if (count < static_cast<ssize_t>(buffer.size()))
                        return;
                }
                else if (count < 0 && errno == EINTR)
                    continue;
                else
                {
                    if (count == 0)
                        pipe.closeEnd(0);
                    return;
                }
            }
        }

        /** The last line that is not blank: the error message in Python's output. */
        std::string lastLine(const std::string &text)
        {
            const std::size_t last = text.find_last_not_of(" \r\n");
            if (last == std::string::npos)
                return "";
            const std::size_t first = text.rfind('\n', last) + 1;
            return oneLine(text.substr(first, last + 1 - first));
        }

        /** The result of a process that ended without an answer. */
        IsolatedResult endOf(int status, const std::string &errors)
        {
            const std::string last = lastLine(errors), more = last.empty() ? "" : ": " + last;
            if (!WIFSIGNALED(status))
                return {End::Died, textOfEnd(status) + more, WEXITSTATUS(status), last};
            // Only the system does that.
            if (WTERMSIG(status) == SIGKILL)
                return {End::OutOfMemory, "killed by the system, as happens when memory is exhausted"};
            return {End::Died, textOfEnd(status) + more, -1, last};
        }

        IsolatedResult readAnswer(const std::string &messages, std::size_t begin)
        {
            const std::string text = messages.substr(begin + 1, messages.size() - begin - 2);
            switch (messages[begin])
            {
                case ANSWER:
                    return {End::Answered, text};
                case EXCEPTION:
                    return {End::Exception, text};
                case OUT_OF_MEMORY:
                    return {End::OutOfMemory, "out of memory"};
                default:
                    return {End::Died, "it wrote into the channel of its answer"};
            }
        }

        /** Waits for the answer, or for another end of the process. */
        IsolatedResult await(ChildProcess &child, Pipe &messages, Pipe &errors, const IsolationLimits &limits,
                             const std::atomic<bool> &stop)
        {
            const auto later = [](double seconds)
            {
                return Clock::now() + std::chrono::milliseconds(std::llround(1e3 * std::min(seconds, 1e9)));
            };
            Clock::time_point deadline = later(limits.timeToHalf);
            std::string words, complaints;
            bool half = false, ended = false;
            for (;;)
            {
                std::array<pollfd, 2> ends{{{messages.ends[0], POLLIN, 0}, {errors.ends[0], POLLIN, 0}}};
                if (!ended)
                    poll(ends.data(), ends.size(), LONGEST_WAIT);
                if (messages.ends[0] >= 0)
                    take(messages, words);
                if (errors.ends[0] >= 0)
                    take(errors, complaints);
                if (complaints.size() > 2 * KEPT)
                    complaints.erase(0, complaints.size() - KEPT);
                if (!half && !words.empty() && words.front() == HALF_DONE)
                {
                    half = true;
                    deadline = later(limits.timeAfter);
                }
                const std::size_t begin = half ? 1 : 0;
                if (words.size() > begin + 1 && words.back() == LAST)
                    return readAnswer(words, begin);
                if (stop)
                    return {End::Stopped, "stopped"};
                if (ended)
                    return endOf(child.end(), complaints);
                if (Clock::now() >= deadline)
                    return {End::TimeUp,
                            half ? "measuring its path exceeded the time limit" : "it exceeded the time limit"};
                // One more iteration for the last output. Children may keep the pipes open.
                ended = child.hasEnded();
            }
        }
    }  // namespace

    IsolatedResult runIsolated(const std::function<std::string(const std::function<void()> &halfDone)> &what,
                               const IsolationLimits &limits, const std::atomic<bool> &stop)
    {
        Pipe messages, errors;
        std::cout.flush();
        std::cerr.flush();
        std::fflush(nullptr);
        const pid_t self = getpid(), process = fork();
        if (process < 0)
            throw Error(std::string("a process for a run cannot be started: ") + std::strerror(errno));
        if (process == 0)
        {
            beginChild(self);
            if (dup2(STDIN_FILENO, STDOUT_FILENO) < 0 || dup2(errors.ends[1], STDERR_FILENO) < 0)
                _exit(EXIT_FAILURE);
            messages.closeEnd(0);
            errors.closeEnd(0);
            answers = messages.ends[1];
            work(what, limits.memory);
        }
        ChildProcess child(process);
        messages.closeEnd(1);
        errors.closeEnd(1);
        fcntl(messages.ends[0], F_SETFL, O_NONBLOCK);
        fcntl(errors.ends[0], F_SETFL, O_NONBLOCK);
        return await(child, messages, errors, limits, stop);
    }
}  // namespace parking
