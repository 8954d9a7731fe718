#pragma once

#include "benchmarks/comparison/Database.h"
#include "benchmarks/comparison/RunRecord.h"
#include "benchmarks/system/FileLock.h"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace parking
{
    /** \brief A row of a table: cells by the names of their columns. */
    using Row = std::map<std::string, SqlValue>;

    /** \brief What the database of a comparison holds. */
    struct StoredRuns
    {
        std::vector<Row> experiments;    ///< rows of the table `experiments`
        std::vector<RunRecord> records;  ///< in the order in which they were finished
    };

    /** \brief The database of a comparison: the journal of its finished runs, in OMPL's schema.

        Each run is a transaction, and on the disk before the next one begins: a process that is killed loses the run
        that was under way, whatever it was doing. Tables and columns are those of OMPL's ompl_benchmark_statistics, so
        that what reads its databases (Planner Arena) reads these at any time. Two tables are the comparison's own:
        `details` has of each run its fingerprint, the reason why it failed, and its path; `superseded` keeps runs that
        are not of this comparison. One process at a time has the database open. */
    class RunStore
    {
    public:
        /** \brief Is a run one of this comparison? */
        using IsOfUse = std::function<bool(const RunRecord &)>;

        /** \brief Opens \e file, and makes it when it is missing.

            Runs that are not of use are superseded; those that were and are of use again come back. When none is of
            use the file is set aside, as `previous-NAME`, or `previous-NAME-2` and so on when that is taken.

            \param fresh set aside whatever is there
            Throws parking::Error when the file cannot be written, is no database of this version, or another process
            has it. */
        RunStore(const std::string &file, const IsOfUse &isOfUse, bool fresh);

        /** \brief Says which experiments there are: a row of the table each, with "name". Of an experiment that is
            there already only what the configuration says is changed; machine and date are those of the beginning. */
        void setExperiments(const std::vector<Row> &experiments);

        /** \brief Is there a run for this experiment, planner and number? */
        bool has(const std::string &experiment, const std::string &planner, std::size_t run) const;

        /** \brief Adds a run of an experiment that is known. Throws parking::Error when it cannot be written (disk
            full); what was written before stays. */
        void add(const RunRecord &record);

        /** \brief Adds those runs of a part of the comparison that are \e wanted, and its experiments: all or nothing.
            A run that differs from the one that is there supersedes it. The machine of an experiment is that of the
            part that began first, with the names of all. */
        void merge(const StoredRuns &part, const IsOfUse &wanted);

        /** \brief All runs, those of an experiment and planner together and in order. */
        std::vector<RunRecord> records() const;

        /** \brief The open database, for queries. */
        const Database &database() const
        {
            return *database_;
        }

        /** \brief Where an earlier comparison went; empty when there was none. */
        const std::string &setAside() const
        {
            return setAside_;
        }

        /** \brief Reads the database of a comparison. Throws parking::Error naming the file when it is missing or
            something else. */
        static StoredRuns read(const std::string &file);

    private:
        using Key = std::tuple<std::string, std::string, std::size_t>;

        static Key keyOf(const RunRecord &record);
        void open();
        /** Sets the file aside. */
        void makeRoom();
        /** Takes over the runs that are there; false when none is of use, and nothing has changed then. */
        bool sortOut(const IsOfUse &isOfUse);
        void supersede(const RunRecord &record);
        /** Adds a column to a table that lacks it. */
        void grow(const std::string &table, const std::string &column, const std::string &type);
        std::int64_t insert(const std::string &table, const Row &row);
        void insert(const RunRecord &record);
        void mergeExperiment(Row row);

        std::string file_, setAside_;
        std::optional<FileLock> lock_;
        std::optional<Database> database_;
        std::map<Key, std::int64_t> known_;                                       // ids of the runs
        std::map<std::string, std::set<std::string>> columns_;                    // of each table, in small letters
        std::map<std::string, std::unique_ptr<Database::Statement>> insertions_;  // by their text
    };
}  // namespace parking
