#pragma once

#include <string>

namespace parking
{
    /** \brief A file open for writing that one process at a time has; made when it is missing.

        The lock is on the file itself and ends with the process, however that ends, so that none is ever left behind.
        What has the name when the constructor is done is what is locked: a file that another process has put in its
        place meanwhile is found out and tried instead. */
    class LockedFile
    {
    public:
        /** \brief Throws parking::Error naming the file when it cannot be written, or another process has it. */
        explicit LockedFile(std::string file);
        ~LockedFile();

        /** \brief Takes over file and lock. */
        LockedFile(LockedFile &&other) noexcept;

        /** \brief Exchanges file and lock. */
        LockedFile &operator=(LockedFile &&other) noexcept;

        /** \brief Keeps the first \e length bytes; what is written next follows them. Throws parking::Error. */
        void cutTo(std::size_t length);

        /** \brief Writes a text at the end and waits until the disk has it: all of it or nothing. Throws parking::Error
            naming the file and the cause. */
        void append(const std::string &text);

        /** \brief Gives the file another name, taking the place of what had it. Throws parking::Error. */
        void rename(const std::string &name);

        /** \brief As given, or what rename() has made of it. */
        const std::string &name() const
        {
            return file_;
        }

    private:
        [[noreturn]] void fail(int error) const;

        std::string file_;
        int descriptor_{-1};
    };
}  // namespace parking
