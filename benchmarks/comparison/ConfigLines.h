#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Where the keys of a .cfg file are. Boost, which reads them, tells no lines. */
    class ConfigLines
    {
    public:
        /** \brief Throws parking::Error naming file and line for a section that is not known, and for what is neither
            a section nor a key in one. */
        ConfigLines(const std::string &file, const std::string &text);

        /** \brief "FILE:LINE: " of the key at \e index, counted from 0 over the whole file. */
        std::string at(std::size_t index) const;

        /** \brief Notes in \e known that \e key, called \e name in the file, is at \e index. Throws parking::Error
            naming both lines when it is there already: of two values one would be ignored. */
        void noteOnce(std::map<std::string, std::string> &known, const std::string &key, const std::string &name,
                      std::size_t index) const;

    private:
        std::string where(std::size_t number) const;

        std::string file_;
        std::vector<std::size_t> numbers_;
    };
}  // namespace parking
