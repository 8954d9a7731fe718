#include "python/src/Background.h"

#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>

namespace parking::python
{
    namespace
    {
        struct Running
        {
            std::mutex mutex;
            std::condition_variable less;
            std::size_t count{0};

            void change(int by)
            {
                const std::lock_guard<std::mutex> lock(mutex);
                count += by;
                less.notify_all();
            }
        };

        Running &running()
        {
            static Running only;
            return only;
        }
    }  // namespace

    void runInBackground(std::function<void()> work)
    {
        running().change(1);
        try
        {
            std::thread(
                [work]() mutable
                {
                    work();
                    work = nullptr;  // what it owns goes first
                    running().change(-1);
                })
                .detach();
        }
        catch (const std::system_error &)
        {
            running().change(-1);
            work();
        }
    }

    void finishBackgroundWork()
    {
        Running &all = running();
        std::unique_lock<std::mutex> lock(all.mutex);
        all.less.wait(lock, [&all] { return all.count == 0; });
    }
}  // namespace parking::python
