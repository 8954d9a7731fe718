#pragma once

#include <map>
#include <string>
#include <vector>

namespace parking
{
    /** \brief A line "key = value" of a .cfg file. */
    struct ConfigLine
    {
        std::string section;  ///< that it is in, without brackets
        std::string key;      ///< before the first equals sign
        std::string value;    ///< behind it
        std::string where;    ///< "FILE:LINE: ", with which messages begin

        /** \brief Notes in \e known that \e name is set here. Throws parking::Error naming both lines when it is there
            already: of two values one would be ignored. */
        void noteOnce(std::map<std::string, std::string> &known, const std::string &name) const;
    };

    /** \brief Reads a .cfg file: sections in brackets, a key and its value a line, comments from # on.

        Throws parking::Error naming file and line for a section that is not known, and for what is neither a section
       nor a key in one. */
    std::vector<ConfigLine> readConfigLines(const std::string &file);
}  // namespace parking
