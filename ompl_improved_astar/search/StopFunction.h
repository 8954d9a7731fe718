#pragma once

#include <functional>

namespace parking::search
{
    /** \brief Polled during a search; true stops it. May be empty. */
    using StopFunction = std::function<bool()>;
}  // namespace parking::search
