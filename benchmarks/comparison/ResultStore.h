#pragma once

#include "benchmarks/comparison/RunRecord.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace parking
{
    /** \brief The finished runs of a comparison, in a file that grows by a line for each.

        A first line describes the comparison and the machine. What is written stays written: when the program is
        interrupted only the run that was under way is lost, and a line that was cut short is ignored when reading. */
    class ResultStore
    {
    public:
        /** \brief Opens \e file for appending, makes it when it is missing.

            \param header describes what is compared; member "fingerprint" tells comparisons apart
            \param fresh forget what is there
            Throws parking::Error when the file cannot be written, or holds the runs of another comparison. */
        ResultStore(std::string file, const nlohmann::json &header, bool fresh);
        ResultStore(const ResultStore &) = delete;
        ResultStore &operator=(const ResultStore &) = delete;

        bool has(const std::string &experiment, const std::string &planner, std::size_t run) const;

        const std::vector<RunRecord> &records() const
        {
            return records_;
        }

        /** \brief What the file begins with. */
        const nlohmann::json &header() const
        {
            return header_;
        }

        /** \brief Adds a run and writes it. Throws parking::Error when that fails (disk full); what was written before
            stays readable. */
        void add(RunRecord record);

        /** \brief Reads a file of results. Throws parking::Error naming the file when it is missing or something else.

            \param end becomes the number of bytes up to the end of the last whole line */
        static std::pair<nlohmann::json, std::vector<RunRecord>> read(const std::string &file,
                                                                      std::size_t *end = nullptr);

    private:
        using Key = std::tuple<std::string, std::string, std::size_t>;

        /** An open file; a member, so that it is closed when the constructor throws, too. */
        struct Descriptor
        {
            explicit Descriptor(int number) : value(number)
            {
            }
            ~Descriptor();
            Descriptor(const Descriptor &) = delete;
            Descriptor &operator=(const Descriptor &) = delete;

            int value;
        };

        void writeLine(const std::string &line);

        std::string file_;
        bool exists_{false};  ///< there was something in it
        Descriptor descriptor_;
        nlohmann::json header_;
        std::vector<RunRecord> records_;
        std::map<Key, std::size_t> index_;
    };
}  // namespace parking
