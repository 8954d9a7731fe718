#include "benchmarks/system/CommandLine.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <system_error>

#include <boost/program_options/errors.hpp>
#include <boost/program_options/parsers.hpp>

#include <sys/stat.h>
#include <unistd.h>

namespace po = boost::program_options;

namespace parking
{
    namespace
    {
        /** Whether both names refer to the same ordinary file, or will do so after one of them is written. */
        bool areSameFile(const std::string &a, const std::string &b)
        {
            namespace fs = std::filesystem;
            std::error_code failed;
            if (fs::exists(a, failed) && fs::exists(b, failed))
                return fs::is_regular_file(a, failed) && fs::equivalent(a, b, failed);
            const fs::path whole = fs::weakly_canonical(fs::absolute(a, failed), failed);
            return !failed && whole == fs::weakly_canonical(fs::absolute(b, failed), failed);
        }
    }  // namespace

    po::typed_value<std::string> *oneValue(const char *name)
    {
        return po::value<std::string>()->value_name(name);
    }

    po::typed_value<std::vector<std::string>> *manyValues(const char *name)
    {
        return po::value<std::vector<std::string>>()->value_name(name)->composing();
    }

    CommandLine::CommandLine(const std::vector<std::string> &arguments, const po::options_description &options,
                             const po::positional_options_description &positional)
    {
        std::vector<std::string> names;
        for (const auto &option : options.options())
            if (positional.max_total_count() == 0 || option->long_name() != positional.name_for_position(0))
                names.push_back("--" + option->long_name());
        try
        {
            po::store(po::command_line_parser(arguments)
                          .options(options)
                          .positional(positional)
                          .style(po::command_line_style::unix_style & ~po::command_line_style::allow_guessing)
                          .run(),
                      values_);
            po::notify(values_);
        }
        catch (const po::unknown_option &error)
        {
            throw Error(unknownName("option", error.get_option_name(), names) + " (see --help)");
        }
        catch (const po::too_many_positional_options_error &)
        {
            throw Error(positional.max_total_count() == 0 ? "unexpected value that belongs to no option (see --help)"
                                                          : "too many files given; one is expected (see --help)");
        }
        catch (const po::error &error)
        {
            // Boost replaces its placeholders in what() endlessly when an option has such a name.
            for (const std::string &argument : arguments)
                if (argument.rfind('-', 0) == 0 && argument.find('%') != std::string::npos)
                    throw Error("no option is called " + inQuotes(argument) + " (see --help)");
            throw Error(oneLine(error.what()) + " (see --help)");
        }
    }

    bool CommandLine::given(const std::string &option) const
    {
        return values_.count(option) > 0;
    }

    std::optional<std::string> CommandLine::text(const std::string &option) const
    {
        return given(option) ? std::optional<std::string>(values_[option].as<std::string>()) : std::nullopt;
    }

    std::optional<std::string> CommandLine::name(const std::string &option) const
    {
        if (given(option) && text(option)->empty())
            throw Error("--" + option + " has an empty name; without the option its default applies");
        return text(option);
    }

    std::vector<std::string> CommandLine::texts(const std::string &option) const
    {
        return given(option) ? values_[option].as<std::vector<std::string>>() : std::vector<std::string>{};
    }

    std::optional<double> CommandLine::positive(const std::string &option, double max) const
    {
        return given(option) ? std::optional<double>(positiveNumber("--" + option, *text(option), max)) : std::nullopt;
    }

    std::optional<double> CommandLine::between(const std::string &option, double min, double max,
                                               const std::string &unit) const
    {
        if (!given(option))
            return std::nullopt;
        double value = 0.0;
        if (!parseNumber(*text(option), value) || value < min || value > max)
            throw Error("--" + option + " must be a number from " + formatNumber(min) + " to " + formatNumber(max) +
                        " " + unit + ", not " + inQuotes(*text(option)));
        return value;
    }

    std::optional<std::size_t> CommandLine::whole(const std::string &option, std::size_t min, std::size_t max) const
    {
        return given(option) ? std::optional<std::size_t>(wholeNumber("--" + option, *text(option), min, max))
                             : std::nullopt;
    }

    std::optional<std::string> CommandLine::outputFile(const std::string &option) const
    {
        const std::optional<std::string> name = text(option);
        if (name && name->empty())
            throw Error("--" + option + " requires the name of a file to write, not an empty one");
        return name;
    }

    double positiveNumber(const std::string &name, const std::string &text, double max)
    {
        double value = 0.0;
        if (!parseNumber(text, value) || value <= 0.0 || value > max)
            throw Error(name + " must be a positive number" +
                        (std::isfinite(max) ? " of at most " + formatNumber(max) : "") + ", not " + inQuotes(text));
        return value;
    }

    std::size_t wholeNumber(const std::string &name, const std::string &text, std::size_t min, std::size_t max)
    {
        std::size_t value = 0;
        if (!parseCount(text, value) || value < min || value > max)
            throw Error(name + " must be a whole number from " + std::to_string(min) + " to " + std::to_string(max) +
                        ", not " + inQuotes(text));
        return value;
    }

    std::pair<std::string, std::string> keyAndValue(const std::string &name, const std::string &text)
    {
        const std::size_t split = text.find('=');
        if (split == std::string::npos || split == 0)
            throw Error(name + " requires KEY=VALUE, not " + inQuotes(text));
        return {text.substr(0, split), text.substr(split + 1)};
    }

    std::string wrapped(const std::string &title, const std::vector<std::string> &names)
    {
        constexpr std::size_t WIDTH = 80;
        std::string text = title, indent = "\n  ";
        std::size_t length = title.size();
        for (const std::string &name : names)
        {
            const bool fits = length + 1 + name.size() <= WIDTH;
            text += (fits ? " " : indent) + name;
            length = (fits ? length + 1 : 2) + name.size();
        }
        return text + "\n";
    }

    void requireWritable(const std::string &file)
    {
        namespace fs = std::filesystem;
        std::error_code ignored;
        if (file.empty())
            throw Error("the name of an output file is empty");
        if (fs::is_directory(file, ignored))
            throw Error(oneLine(file) + ": is a folder, not a file to write");
        if (fs::is_block_file(file, ignored))
            throw Error(oneLine(file) + ": is a disk, whose content would be lost; name a file");
        if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored))
            return;  // a pipe or a device reports its own errors
        fs::path folder = fs::path(file).parent_path();
        if (folder.empty())
            folder = ".";
        if (!fs::is_directory(folder, ignored))
            throw Error(oneLine(file) + ": cannot be written: there is no folder " + oneLine(folder.string()));
        if (access(folder.c_str(), W_OK) != 0)
            throw Error(oneLine(file) + ": cannot be written: " + std::strerror(errno));
    }

    void requireOutputs(const std::vector<std::string> &outputs, const std::vector<std::string> &inputs)
    {
        for (std::size_t i = 0; i < outputs.size(); ++i)
        {
            const std::string &file = outputs[i];
            if (file == "-")
                throw Error("'-' is not standard output here; for a file of that name write './-'");
            requireWritable(file);
            requireNoInput({file}, inputs);
            for (std::size_t k = 0; k < i; ++k)
                if (areSameFile(file, outputs[k]))
                    throw Error(inQuotes(file) + " would be written twice: name two files");
        }
    }

    void requireNoInput(const std::vector<std::string> &outputs, const std::vector<std::string> &inputs)
    {
        // By the system's identifiers: a comparison may have thousands of inputs and outputs, under any names.
        std::map<std::pair<dev_t, ino_t>, std::string> known;
        struct stat status = {};
        for (const std::string &input : inputs)
            if (stat(input.c_str(), &status) == 0 && S_ISREG(status.st_mode))
                known.emplace(std::make_pair(status.st_dev, status.st_ino), input);
        for (const std::string &output : outputs)
        {
            if (stat(output.c_str(), &status) != 0 || !S_ISREG(status.st_mode))
                continue;
            const auto found = known.find({status.st_dev, status.st_ino});
            if (found != known.end())
                throw Error(inQuotes(output) + " is the input" +
                            (output == found->second ? "" : " " + inQuotes(found->second)) +
                            ", which would be lost; choose another file to write");
        }
    }

    int runProgram(const char *name, int argc, char **argv,
                   const std::function<int(const std::vector<std::string> &)> &program)
    {
        constexpr int BAD_INPUT = 2;
        try
        {
            const int status = program({argv + 1, argv + argc});
            if (!std::cout.flush())
                throw Error("standard output cannot be written");
            return status;
        }
        catch (const std::exception &error)
        {
            std::cerr << name << ": " << oneLine(error.what()) << std::endl;
            return BAD_INPUT;
        }
    }
}  // namespace parking
