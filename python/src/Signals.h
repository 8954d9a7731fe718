#pragma once

#include <chrono>

#include <pybind11/pybind11.h>

namespace parking::python
{
    /** \brief Handles Ctrl-C while C++ runs without the interpreter's lock, by polling Python's signals every 2 ms. As
        always in Python, only the main thread receives them. */
    class Signals
    {
    public:
        /** \brief Whether a signal has arrived. Poll it without the interpreter's lock. */
        bool arrived()
        {
            const auto now = std::chrono::steady_clock::now();
            if (!arrived_ && now >= next_)
            {
                ask();
                next_ = now + std::chrono::milliseconds(2);
            }
            return arrived_;
        }

        /** \brief Polls for signals immediately and returns whether one has arrived. */
        bool ask()
        {
            const PyGILState_STATE state = PyGILState_Ensure();
            arrived_ = arrived_ || PyErr_CheckSignals() != 0;
            PyGILState_Release(state);
            return arrived_;
        }

        /** \brief Throws the exception of the signal's handler (KeyboardInterrupt), if a signal has arrived. Requires
            the interpreter's lock. */
        void raise() const
        {
            if (arrived_)
                throw pybind11::error_already_set();
        }

    private:
        std::chrono::steady_clock::time_point next_{std::chrono::steady_clock::now() + std::chrono::milliseconds(2)};
        bool arrived_{false};
    };
}  // namespace parking::python
