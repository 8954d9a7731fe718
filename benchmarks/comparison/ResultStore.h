#pragma once

#include "benchmarks/comparison/RunRecord.h"
#include "benchmarks/system/LockedFile.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace parking
{
    /** \brief What a file of results holds. */
    struct StoredResults
    {
        nlohmann::json header;           ///< of the comparison that wrote to it last; without names when there is none
        bool hasHeader{false};           ///< has the file a line about the comparison?
        std::vector<RunRecord> records;  ///< in the order of the file
        std::size_t end{0};              ///< bytes up to the end of the last whole line
        std::string damage;              ///< one line that names file and line of what is none; empty when all is well
    };

    /** \brief The finished runs of a comparison: a journal, a file that grows by a line for each.

        What is written stays written, and is on the disk before the next run begins. A process that is killed loses the
        run that was under way, whatever it was doing. A line that was cut short is left out when reading, and so is one
        that is damaged, which StoredResults::damage tells.

        A line about the comparison and the machine goes before the runs. Its member "fingerprints" says, by experiment
        and planner, which runs are of use: those with the same fingerprint. A comparison that wants others writes such
       a line again; what earlier ones have finished stays in the file, for it or for later ones. */
    class ResultStore
    {
    public:
        /** \brief Opens \e file, and makes it when it is missing. It is locked before anything is looked at, and stays
            so as long as the object lives.

            When none of its runs is of use the file is set aside, as `previous-NAME`, or `previous-NAME-2` and so on
            when that is taken.

            \param fresh set aside whatever is there
            Throws parking::Error when the file cannot be written, or another process has it. */
        ResultStore(const std::string &file, const nlohmann::json &header, bool fresh);
        ResultStore(const ResultStore &) = delete;
        ResultStore &operator=(const ResultStore &) = delete;

        /** \brief Is there a run of use for this experiment, planner and number? */
        bool has(const std::string &experiment, const std::string &planner, std::size_t run) const;

        /** \brief The runs that are of use. */
        const std::vector<RunRecord> &records() const
        {
            return records_;
        }

        /** \brief As it is in the file: machine and date are those of the beginning. */
        const nlohmann::json &header() const
        {
            return header_;
        }

        /** \brief Where an earlier comparison went; empty when there was none. */
        const std::string &setAside() const
        {
            return setAside_;
        }

        /** \brief See StoredResults::damage. */
        const std::string &damage() const
        {
            return damage_;
        }

        /** \brief Adds a run and writes it. Throws parking::Error when that fails (disk full); what was written before
            stays readable. */
        void add(RunRecord record);

        /** \brief Reads a file of results. Throws parking::Error naming the file when it is missing, holds nothing that
            can be used or is of another version. */
        static StoredResults read(const std::string &file);

    private:
        using Key = std::tuple<std::string, std::string, std::size_t>;

        bool isOfUse(const RunRecord &record) const;
        /** Takes over what is there; false when nothing is of use. */
        bool goOn(StoredResults &stored);
        /** \param keep set aside what is there */
        void beginAnew(bool keep);

        LockedFile file_;
        nlohmann::json header_;
        std::vector<RunRecord> records_;
        std::set<Key> known_;
        std::string setAside_, damage_;
    };
}  // namespace parking
