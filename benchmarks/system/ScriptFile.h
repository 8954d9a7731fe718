#pragma once

#include <string>

namespace parking
{
    /** \brief The file of a script of this suite: installed with the running program, or in the source folder of the
        build; empty when there is neither. \param name relative to the folder benchmarks */
    std::string findScript(const std::string &name);
}  // namespace parking
