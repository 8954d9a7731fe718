#pragma once

#include <string>

namespace parking
{
    /** \brief A file that one process at a time writes; made when it is missing.

        The lock ends with the process, however that ends, and is apart from those that SQLite has on the same file. */
    class FileLock
    {
    public:
        /** \brief Throws parking::Error naming the file when it cannot be written, or another process has it. */
        explicit FileLock(const std::string &file);
        ~FileLock();
        FileLock(const FileLock &) = delete;
        FileLock &operator=(const FileLock &) = delete;

        /** \brief False on a file system that knows no locks. */
        bool isLocked() const
        {
            return locked_;
        }

    private:
        int descriptor_{-1};
        bool locked_{false};
    };
}  // namespace parking
