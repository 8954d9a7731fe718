#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <boost/program_options/options_description.hpp>
#include <boost/program_options/positional_options.hpp>
#include <boost/program_options/variables_map.hpp>

namespace parking
{
    /** \brief Parses a command line: options must be written out in full.

        Throws parking::Error with one line; for an unknown option it names the nearest. */
    boost::program_options::variables_map parseCommandLine(
        const std::vector<std::string> &arguments, const boost::program_options::options_description &options,
        const boost::program_options::positional_options_description &positional);

    /** \brief The number that option \e name was given. Throws parking::Error naming the option when it is no number
        that is positive (and finite). */
    double positiveNumber(const std::string &name, const std::string &text);

    /** \brief The same for whole numbers from \e least to \e most. */
    std::size_t wholeNumber(const std::string &name, const std::string &text, std::size_t least, std::size_t most);

    /** \brief Splits KEY=VALUE. Throws parking::Error naming option \e name when there is no '=' or no key. */
    std::pair<std::string, std::string> keyAndValue(const std::string &name, const std::string &text);

    /** \brief Throws parking::Error unless \e file could be written: its folder exists and may be written to, and it is
        no folder itself. Better to know before the work than after. */
    void requireWritable(const std::string &file);
}  // namespace parking
