#pragma once

#include <string>

namespace parking
{
    /** \brief Writes a file whole or not at all.

        The content goes to a temporary file in the same folder, which takes the place of \e file only when everything
        is written: whoever reads meanwhile sees the old content or the new one, and a full disk leaves the old one as
        it was and no remains. A symbolic link is followed. What is no ordinary file (a pipe, /dev/null) is written
        directly.

        Throws parking::Error naming the file and the cause (missing folder, no permission, disk full). */
    void writeFileAtomically(const std::string &file, const std::string &content);
}  // namespace parking
