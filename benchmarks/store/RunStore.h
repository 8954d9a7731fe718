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

    /** \brief What the database of a comparison shows. */
    struct StoredRuns
    {
        std::vector<Row> experiments;    ///< rows of the table `experiments`
        std::vector<RunRecord> records;  ///< those of an experiment and planner together, and in order
    };

    /** \brief The database of a comparison: the journal of its finished runs, in OMPL's schema.

        Each run is a transaction, and on the disk before the next one begins: a process that is killed loses the run
        that was under way, whatever it was doing. One process at a time has the database open; others may read it.

        Nothing is ever taken out. The tables all_experiments, all_plannerConfigs and all_runs have whatever was
        measured; the views experiments, plannerConfigs and runs, which are those of OMPL's ompl_benchmark_statistics,
        show the runs that were selected: so what reads such databases (Planner Arena) sees the last comparison only.
        The table details has of each run its fingerprint, the reason why it found nothing, and its path. */
    class RunStore
    {
    public:
        /** \brief Opens \e file, and makes it when it is missing. Throws parking::Error when it cannot be written, is
            no database of this version, or another process has it. */
        explicit RunStore(const std::string &file);

        /** \brief No run that is there shall be shown again. */
        void forget();

        /** \brief Shows the runs with these fingerprints. For a fingerprint without the part behind its '+', that of
            the program: those that go on from it and are shown already, or are merged.

            \param count runs of each planner on each experiment */
        void select(const std::vector<std::string> &fingerprints, std::size_t count);

        /** \brief Describes experiments: a row of the table each, with "name". Where runs of an experiment are shown,
            only limits, seed and number of runs change; machine and date are those of the beginning. */
        void describe(const std::vector<Row> &experiments);

        /** \brief Is there a run to show for this experiment, planner and number? */
        bool has(const std::string &experiment, const std::string &planner, std::size_t run) const;

        /** \brief Adds a run, whose fingerprint was selected. Throws parking::Error when it cannot be written (disk
            full); what was written before stays. */
        void add(const RunRecord &record);

        /** \brief Adds the runs of another database whose fingerprints begin with those that were selected, and its
            experiments: all or nothing. They take the place of runs that are there already. The machine of an
            experiment is that of the part that began first, with the names of all. */
        void merge(const StoredRuns &part);

        /** \brief The runs of an experiment that are shown. */
        std::vector<RunRecord> read(const std::string &experiment) const;

        /** \brief All that a database shows, which another process may have open. Throws parking::Error naming the file
            when it is missing or something else. */
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
        /** Is it one of those that were selected, or does it go on from one of them? */
        bool selectIfBegun(const std::string &fingerprint);
        void mergeExperiment(Row row);

        Database database_;
        std::set<Key> known_;
        std::set<std::string> selected_;  // fingerprints, or their beginnings
        std::int64_t count_{0};
        std::map<std::string, std::set<std::string>> columns_;                    // of each table, in small letters
        std::map<std::string, std::unique_ptr<Database::Statement>> insertions_;  // by their text
    };
}  // namespace parking
