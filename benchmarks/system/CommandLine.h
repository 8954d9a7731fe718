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
    /** \brief Seconds: the longest that a run may be given. OMPL computes the end of a run in nanoseconds since 1970,
        which overflow when it lies more than two hundred years ahead. */
    constexpr double LONGEST_RUN = 1e6;

    /** \brief The value of an option, a text; \e name stands for it in the help. */
    boost::program_options::typed_value<std::string> *oneValue(const char *name);

    /** \brief The same of an option that may be given several times. */
    boost::program_options::typed_value<std::vector<std::string>> *manyValues(const char *name);

    /** \brief A command line that was read: what each option was given. Options must be written out in full.

        Options that were not given are empty; the caller has the defaults: `line.positive("time").value_or(5.0)`. The
        readers throw parking::Error naming option and value where a value is not what it must be. */
    class CommandLine
    {
    public:
        /** \brief Throws parking::Error with one line; for an unknown option it names the nearest. */
        CommandLine(const std::vector<std::string> &arguments,
                    const boost::program_options::options_description &options,
                    const boost::program_options::positional_options_description &positional);

        /** \brief Was it given at all? */
        bool given(const std::string &option) const;

        /** \brief What it was given; nothing when it was not. */
        std::optional<std::string> text(const std::string &option) const;

        /** \brief The same of an option whose text names something. Throws parking::Error for an empty one. */
        std::optional<std::string> name(const std::string &option) const;

        /** \brief Of an option that may be given several times. */
        std::vector<std::string> texts(const std::string &option) const;

        /** \brief See positiveNumber(). */
        std::optional<double> positive(const std::string &option,
                                       double most = std::numeric_limits<double>::infinity()) const;

        /** \brief A number from \e least to \e most; \e unit is for the message. */
        std::optional<double> between(const std::string &option, double least, double most,
                                      const std::string &unit) const;

        /** \brief See wholeNumber(). */
        std::optional<std::size_t> whole(const std::string &option, std::size_t least, std::size_t most) const;

        /** \brief The name of a file to write. Throws parking::Error naming the option for an empty one. */
        std::optional<std::string> outputFile(const std::string &option) const;

    private:
        boost::program_options::variables_map values_;
    };

    /** \brief The number that option \e name was given. Throws parking::Error naming the option when it is no number
        that is positive (and finite) and at most \e most. */
    double positiveNumber(const std::string &name, const std::string &text,
                          double most = std::numeric_limits<double>::infinity());

    /** \brief The same for whole numbers from \e least to \e most. */
    std::size_t wholeNumber(const std::string &name, const std::string &text, std::size_t least, std::size_t most);

    /** \brief Splits KEY=VALUE. Throws parking::Error naming option \e name when there is no '=' or no key. */
    std::pair<std::string, std::string> keyAndValue(const std::string &name, const std::string &text);

    /** \brief Throws parking::Error unless \e file could be written: its folder exists and may be written to, and it is
        no folder itself. Better to know before the work than after. */
    void requireWritable(const std::string &file);

    /** \brief The same for all files that a program writes. Throws parking::Error, too, when one of them is an input,
        which would be lost, when two are the same file, of which one would be, or when one is called -, which is no
        file to most people. */
    void requireOutputs(const std::vector<std::string> &outputs, const std::vector<std::string> &inputs);

    /** \brief Throws parking::Error when one of \e outputs is one of \e inputs, which would be lost: for inputs that
        are known only once others have been read, as the map of a scenario is. */
    void requireNoInput(const std::vector<std::string> &outputs, const std::vector<std::string> &inputs);

    /** \brief Runs a program on its arguments and returns its status. What it throws becomes one line on standard
        error that begins with \e name, and status 2: bad input or usage. So does standard output that cannot be
        written. */
    int runProgram(const char *name, int argc, char **argv,
                   const std::function<int(const std::vector<std::string> &)> &program);
}  // namespace parking
