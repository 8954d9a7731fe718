#pragma once

#include <string>
#include <vector>

namespace parking
{
    /** \brief What a program left behind. */
    struct ProcessResult
    {
        int status{-1};      ///< exit status; 127: not started; 128 + the signal's number when one ended it
        std::string errors;  ///< what it wrote to standard error
    };

    /** \brief Is \e name a program that can be started: found in PATH, or a path itself? */
    bool isProgram(const std::string &name);

    /** \brief Runs a program, found in PATH, with its arguments and waits for its end. Its standard output is thrown
        away. No shell is involved. Throws parking::Error when there can be no other process. */
    ProcessResult runProcess(const std::vector<std::string> &command);

    /** \brief The last line of what a program wrote that is not blank: where Python's errors say what is wrong. */
    std::string lastLine(const std::string &text);
}  // namespace parking
