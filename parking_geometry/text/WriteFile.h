#pragma once

#include <string>

namespace parking
{
    /** \brief Writes a file completely or not at all.

        The function writes a temporary file in the same folder and then renames it to \e file. A concurrent reader sees
        either the old or the new content. If the disk is full, the old file stays unchanged and the temporary file is
        removed. Symbolic links are followed. Special files such as pipes and /dev/null are written directly.

        Throws parking::Error naming the file and the cause (missing folder, no permission, disk full). */
    void writeFileAtomically(const std::string &file, const std::string &content);
}  // namespace parking
