#pragma once

#include <chrono>

#include <pybind11/pybind11.h>

namespace parking::python
{
    /** \brief Lets Ctrl-C through while C++ is at work without the interpreter's lock: every 2 ms Python is asked for
        signals. Only the main thread gets them, as always in Python. */
    class Signals
    {
    public:
        /** \brief Has one come? To be called now and then, without the lock. */
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

        /** \brief Asks at once. */
        bool ask()
        {
            const PyGILState_STATE state = PyGILState_Ensure();
            arrived_ = arrived_ || PyErr_CheckSignals() != 0;
            PyGILState_Release(state);
            return arrived_;
        }

        /** \brief Throws what the signal's handler raised (KeyboardInterrupt), if it has come; with the lock. */
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
