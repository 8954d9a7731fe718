#pragma once

#include "benchmarks/system/LockedFile.h"

#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Turns logs of ompl::tools::Benchmark into a SQLite database.

        Tables and columns are those of OMPL's ompl_benchmark_statistics, so that what reads its databases (Planner
        Arena) reads these, too. While it lives no other process can write that database. */
    class DatabaseWriter
    {
    public:
        /** \brief Throws parking::Error when another process has it, or it cannot be written. */
        explicit DatabaseWriter(std::string database);
        ~DatabaseWriter();
        DatabaseWriter(const DatabaseWriter &) = delete;
        DatabaseWriter &operator=(const DatabaseWriter &) = delete;

        /** \brief A database that is there is replaced, once the new one is complete and on the disk.

            Throws parking::Error naming the file when a log cannot be read or the database cannot be written. */
        void write(const std::vector<std::string> &logs);

    private:
        std::string database_;
        std::optional<LockedFile> unfinished_;
    };
}  // namespace parking
