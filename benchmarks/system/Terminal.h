#pragma once

#include <cstdlib>
#include <string>

#include <unistd.h>

namespace parking
{
    /** \brief Whether a file descriptor is a terminal with colours and the user accepts them: the variable NO_COLOR is
        empty or not set (https://no-color.org). */
    inline bool hasColour(int descriptor)
    {
        const char *refused = std::getenv("NO_COLOR"), *kind = std::getenv("TERM");
        return isatty(descriptor) == 1 && (refused == nullptr || *refused == '\0') && kind != nullptr &&
               std::string(kind) != "dumb";
    }

    /** \brief Codes of ANSI terminals. */
    namespace terminal_style
    {
        constexpr const char *BOLD = "1";  ///< for headings
        constexpr const char *RED = "31";  ///< for faults
    }                                      // namespace terminal_style

    /** \brief \e text in a style of the terminal, or unchanged without colours. */
    inline std::string styled(const std::string &text, const char *style, bool colours)
    {
        return colours && !text.empty() ? std::string("\033[") + style + "m" + text + "\033[0m" : text;
    }
}  // namespace parking
