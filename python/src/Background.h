#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <utility>

namespace parking::python
{
    /** \brief Runs \e work in a thread of its own, so that who waits for it may go away before it ends: it must own all
        that it touches, and nothing of Python's. Where no thread can be had, it is done before this returns. */
    void runInBackground(std::function<void()> work);

    /** \brief Waits until all such work has ended; called before Python ends, without its lock. */
    void finishBackgroundWork();

    /** \brief As runInBackground(), with a result or what was thrown. */
    template <class Result>
    std::shared_future<Result> resultInBackground(std::function<Result()> work)
    {
        const auto task = std::make_shared<std::packaged_task<Result()>>(std::move(work));
        std::shared_future<Result> result = task->get_future().share();
        runInBackground([task] { (*task)(); });
        return result;
    }

    /** \brief Waits for a result and asks every 2 ms whether to go on; \return has it come? */
    template <class Result>
    bool await(const std::shared_future<Result> &result, const std::function<bool()> &interrupted)
    {
        while (result.wait_for(std::chrono::milliseconds(2)) != std::future_status::ready)
            if (interrupted && interrupted())
                return false;
        return true;
    }
}  // namespace parking::python
