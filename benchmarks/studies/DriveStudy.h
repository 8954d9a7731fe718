#pragma once

#include "automatic_parking/AutomaticParking.h"
#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Scenario.h"

#include <optional>
#include <string>
#include <vector>

#include <boost/program_options/options_description.hpp>

namespace parking
{
    /** \brief What the programs have in common that park the cars of scenarios many times: which scenarios, and how the
        pipeline is tuned. */
    class DriveStudy
    {
    public:
        /** \param program its name \param purpose a sentence for its help */
        DriveStudy(std::string program, std::string purpose);

        /** \brief To add more options to. */
        boost::program_options::options_description &options()
        {
            return options_;
        }

        /** \brief Reads the command line; nothing when it asks for help, which is then printed.

            Throws parking::Error for unknown options, and without a scenario. */
        std::optional<CommandLine> read(const std::vector<std::string> &arguments) const;

        /** \brief The scenarios that \e line names. Throws what readScenario() throws. */
        static std::vector<Scenario> scenarios(const CommandLine &line);

        /** \brief The pipeline as \e line tunes it. Throws parking::Error for values out of their range. */
        static ParkingParameters parameters(const CommandLine &line);

    private:
        std::string program_, purpose_;
        boost::program_options::options_description options_{"Options"};
    };

    /** \brief A table of Markdown, the first column aligned left and all others right. */
    class MarkdownTable
    {
    public:
        /** \brief With the names of the columns, of which there must be one. */
        explicit MarkdownTable(const std::vector<std::string> &head);

        /** \brief Adds a line; cells that are missing at its end stay empty. */
        void add(const std::vector<std::string> &cells);

        /** \brief All of it, each line ended. */
        const std::string &text() const
        {
            return text_;
        }

    private:
        std::size_t columns_;
        std::string text_;
    };
}  // namespace parking
