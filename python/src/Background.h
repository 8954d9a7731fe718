#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <utility>

namespace parking::python
{
    /** \brief Runs \e work in a new thread, which may outlive the caller. It must own its data and must not use Python.
        If no thread is available, it runs before this function returns. */
    void runInBackground(std::function<void()> work);

    /** \brief Waits until all background work has ended. It is called before Python ends, without its lock. */
    void finishBackgroundWork();

    /** \brief Runs \e work as runInBackground() does, and returns its result or exception. */
    template <class Result>
    std::shared_future<Result> resultInBackground(std::function<Result()> work)
    {
        const auto task = std::make_shared<std::packaged_task<Result()>>(std::move(work));
        std::shared_future<Result> result = task->get_future().share();
        runInBackground([task] { (*task)(); });
        return result;
    }

    /** \brief Waits for a result and polls \e interrupted every 2 ms. \return whether the result is available */
    template <class Result>
    bool await(const std::shared_future<Result> &result, const std::function<bool()> &interrupted)
    {
        while (result.wait_for(std::chrono::milliseconds(2)) != std::future_status::ready)
            if (interrupted && interrupted())
                return false;
        return true;
    }
}  // namespace parking::python
