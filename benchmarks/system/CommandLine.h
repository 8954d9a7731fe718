#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <boost/program_options/options_description.hpp>
#include <boost/program_options/positional_options.hpp>
#include <boost/program_options/value_semantic.hpp>
#include <boost/program_options/variables_map.hpp>

namespace parking
{
    /** \brief Maximum time limit of a run in seconds.
        OMPL computes the end of a run in nanoseconds since 1970, which overflow more than two hundred years ahead. */
    constexpr double LONGEST_RUN = 1e6;

    /** \brief The value of an option, a text; \e name is its placeholder in the help. */
    boost::program_options::typed_value<std::string> *oneValue(const char *name);

    /** \brief The values of a repeatable option; \e name is their placeholder in the help. */
    boost::program_options::typed_value<std::vector<std::string>> *manyValues(const char *name);

    /** \brief The options of a command line, written in full.

        Missing options are empty; the caller has the defaults: `line.positive("time").value_or(5.0)`. The readers throw
        parking::Error naming option and value for an invalid value. */
    class CommandLine
    {
    public:
        /** \brief Throws parking::Error with one line; for an unknown option it names the nearest. */
        CommandLine(const std::vector<std::string> &arguments,
                    const boost::program_options::options_description &options,
                    const boost::program_options::positional_options_description &positional);

        /** \brief Whether the option was given. */
        bool given(const std::string &option) const;

        /** \brief The value of an option; empty without the option. */
        std::optional<std::string> text(const std::string &option) const;

        /** \brief The value of an option that is a name. Throws parking::Error for an empty name. */
        std::optional<std::string> name(const std::string &option) const;

        /** \brief The values of a repeatable option. */
        std::vector<std::string> texts(const std::string &option) const;

        /** \brief A positive number, see positiveNumber(). */
        std::optional<double> positive(const std::string &option,
                                       double max = std::numeric_limits<double>::infinity()) const;

        /** \brief A number from \e min to \e max; \e unit is for the message. */
        std::optional<double> between(const std::string &option, double min, double max, const std::string &unit) const;

        /** \brief A whole number, see wholeNumber(). */
        std::optional<std::size_t> whole(const std::string &option, std::size_t min, std::size_t max) const;

        /** \brief The name of a file to write. Throws parking::Error naming the option for an empty name. */
        std::optional<std::string> outputFile(const std::string &option) const;

    private:
        boost::program_options::variables_map values_;
    };

    /** \brief The number given for option \e name. Throws parking::Error naming the option unless it is positive,
        finite and at most \e max. */
    double positiveNumber(const std::string &name, const std::string &text,
                          double max = std::numeric_limits<double>::infinity());

    /** \brief The whole number given for option \e name. Throws parking::Error naming the option unless it is from \e
        min to \e max. */
    std::size_t wholeNumber(const std::string &name, const std::string &text, std::size_t min, std::size_t max);

    /** \brief Splits KEY=VALUE. Throws parking::Error naming option \e name without a '=' or without a key. */
    std::pair<std::string, std::string> keyAndValue(const std::string &name, const std::string &text);

    /** \brief A title and names for a help text, in lines of at most 80 characters. */
    std::string wrapped(const std::string &title, const std::vector<std::string> &names);

    /** \brief Throws parking::Error unless \e file can be written: its folder exists and is writable, and it is not a
        folder itself.
        Call it first, so that the program does not fail after its work. */
    void requireWritable(const std::string &file);

    /** \brief Checks all files that a program writes.
        Throws parking::Error if one cannot be written, is also an input, appears twice, or has the name -, which
        usually means standard output. */
    void requireOutputs(const std::vector<std::string> &outputs, const std::vector<std::string> &inputs);

    /** \brief Throws parking::Error when one of \e outputs is one of \e inputs, which would be lost.
        For inputs found while reading others, such as the map of a scenario. */
    void requireNoInput(const std::vector<std::string> &outputs, const std::vector<std::string> &inputs);

    /** \brief Runs a program on its arguments and returns its exit status.
        An exception becomes one line on standard error that begins with \e name, and status 2: invalid input or usage.
        The same applies to an error of standard output. */
    int runProgram(const char *name, int argc, char **argv,
                   const std::function<int(const std::vector<std::string> &)> &program);
}  // namespace parking
