#pragma once

#include <functional>

namespace parking::search
{
    /** \brief Polled now and then; true stops the search. Empty: never. */
    using StopFunction = std::function<bool()>;
}  // namespace parking::search
