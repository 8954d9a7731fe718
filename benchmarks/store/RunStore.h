#pragma once

#include "benchmarks/store/Database.h"
#include "benchmarks/store/RunRecord.h"

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace parking
{
    /** \brief A row of a table: cells by the names of their columns. */
    using Row = std::map<std::string, SqlValue>;

    /** \brief Selected contents of the database of a comparison. */
    struct StoredRuns
    {
        std::vector<Row> experiments;    ///< rows of the table `experiments`
        std::vector<RunRecord> records;  ///< runs grouped by experiment and planner, in order
    };

    /** \brief The database of a comparison: the journal of its finished runs, in OMPL's schema.

        Each run is a transaction that is on the disk before the next run begins: a killed process loses only the
        current run. One process at a time has the database open; others may read it.

        Rows are never removed. The tables all_experiments, all_plannerConfigs and all_runs contain everything measured.
        The views experiments, plannerConfigs and runs, which are those of OMPL's ompl_benchmark_statistics, show the
        selected runs. Readers of such databases (Planner Arena) thus see only the last comparison. The table details
        contains the fingerprint, the failure reason, the improvements and the path of each run, and progress samples of
        its best cost if it continued after its first solution. */
    class RunStore
    {
    public:
        /** \brief Opens \e file, and creates it when it is missing. Throws parking::Error when it cannot be written, is
            not a database of this version, or is open in another process. */
        explicit RunStore(const std::string &file);

        /** \brief Hides all stored runs permanently. */
        void forget();

        /** \brief Shows the runs with these fingerprints.

            A fingerprint without the part after its '+', that of the program, selects runs that extend it and are shown
            already or merged.

            \param count runs of each planner on each experiment */
        void select(const std::vector<std::string> &fingerprints, std::size_t count);

        /** \brief Describes experiments by rows of the table, each with "name".
            If runs of an experiment are shown, only limits, seed and number of runs change; machine and date stay those
            of the beginning. */
        void describe(const std::vector<Row> &experiments);

        /** \brief Whether the selection contains a run of this experiment, planner and number. */
        bool has(const std::string &experiment, const std::string &planner, std::size_t run) const;

        /** \brief Adds a run, whose fingerprint was selected. Throws parking::Error when it cannot be written (disk
            full); earlier runs stay intact. */
        void add(const RunRecord &record);

        /** \brief Adds the experiments and selected runs of another database, completely or not at all.
            They replace existing runs. The machine of an experiment is that of the part that began first, with the
            names of all machines. */
        void merge(const StoredRuns &part);

        /** \brief The selected runs of an experiment. */
        std::vector<RunRecord> read(const std::string &experiment) const;

        /** \brief All selected contents of a database, which another process may have open. Throws parking::Error
            naming the file when it is missing or not such a database. */
        static StoredRuns readFile(const std::string &file);

        /** \brief The open database, for queries. */
        const Database &database() const
        {
            return database_;
        }

    private:
        using Key = std::tuple<std::string, std::string, std::size_t>;

        static Key keyOf(const RunRecord &record);
        /** Adds a column to a table that lacks it. */
        void grow(const std::string &table, const std::string &column, const std::string &type);
        std::int64_t insert(const std::string &table, const Row &row);
        std::int64_t idOf(const std::string &table, const Row &row);
        void insert(const RunRecord &record);
        void setColumn(const std::string &table, std::int64_t id, const std::string &column, const SqlValue &value);
        /** Whether the fingerprint was selected, or extends a selected one. */
        bool selectIfBegun(const std::string &fingerprint);
        void mergeExperiment(Row row);

        Database database_;
        std::set<Key> known_;
        std::set<std::string> selected_;  // fingerprints, or their beginnings
        std::int64_t count_{0};
        std::map<std::string, std::set<std::string>> columns_;  // names of each table's columns, in small letters
        std::map<std::string, std::unique_ptr<Database::Statement>> insertions_;  // prepared statements by their text
    };
}  // namespace parking
