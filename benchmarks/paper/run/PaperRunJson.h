#pragma once

#include "benchmarks/paper/run/PaperTask.h"

#include <nlohmann/json.hpp>

#include <string>

namespace parking
{
    /** \brief The version of the form below. */
    constexpr int PAPER_RUN_FORMAT = 1;

    /** \brief One run of one algorithm in one scenario, as `paper_run` writes it.

        \param lines with the points of the way and the states of the drive, else their figures only */
    nlohmann::json paperRunJson(const std::string &scenario, const std::string &algorithm, const PaperTask &task,
                                const PaperRun &run, bool lines);
}  // namespace parking
