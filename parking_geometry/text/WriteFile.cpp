#include "parking_geometry/text/WriteFile.h"

#include "parking_geometry/Error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace parking
{
    namespace
    {
        namespace fs = std::filesystem;

        [[noreturn]] void fail(const std::string &file, int error)
        {
            throw Error(file + ": cannot be written: " + std::strerror(error));
        }

        /** Writes all of \e content. \return the error, or 0 */
        int writeAll(int descriptor, const std::string &content)
        {
            std::size_t done = 0;
            while (done < content.size())
            {
                const ssize_t count = ::write(descriptor, content.data() + done, content.size() - done);
                if (count > 0)
                    done += static_cast<std::size_t>(count);
                else if (count < 0 && errno != EINTR)
                    return errno;
            }
            return 0;
        }

        /** Closes the file and returns the error. On network drives, closing may be the first call to report a full
            disk. */
        int closeChecked(int descriptor)
        {
            return ::close(descriptor) == 0 ? 0 : errno;
        }

        void writeDirectly(const std::string &file, const std::string &content)
        {
            const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
            if (descriptor < 0)
                fail(file, errno);
            const int written = writeAll(descriptor, content);
            const int closed = closeChecked(descriptor);
            if (written || closed)
                fail(file, written ? written : closed);
        }

        /** The target of a symbolic link, which need not exist. */
        fs::path followLinks(fs::path file)
        {
            std::error_code error;
            // The bound is that of the system for chains of links. Longer chains are cycles.
            for (int links = 0; links < 40 && fs::is_symlink(fs::symlink_status(file, error)); ++links)
                file = file.parent_path() / fs::read_symlink(file, error);
            return file;
        }

        /** Permissions of the replaced file or, if there is none, the default for new files. */
        mode_t permissionsFor(const std::string &target)
        {
            struct stat status = {};
            if (::stat(target.c_str(), &status) == 0)
                return status.st_mode & 07777;
            const mode_t mask = ::umask(0);
            ::umask(mask);
            return 0666 & ~mask;
        }
    }  // namespace

    void writeFileAtomically(const std::string &file, const std::string &content)
    {
        if (file.empty())
            throw Error("no name given for the file to write");
        std::error_code ignored;
        const fs::file_status status = fs::status(file, ignored);
        if (fs::is_directory(status))
            throw Error(file + ": is a folder; the name of a file is needed");
        if (fs::is_block_file(status))
            throw Error(file + ": is a disk, whose content would be lost; the name of a file is needed");
        if (fs::exists(status) && !fs::is_regular_file(status))
            return writeDirectly(file, content);

        const std::string target = followLinks(file).string();
        if (fs::is_symlink(fs::symlink_status(target, ignored)))
            fail(file, ELOOP);
        const fs::path folder = fs::path(target).parent_path();
        if (!folder.empty() && !fs::is_directory(folder, ignored))
            throw Error(file + ": cannot be written: there is no folder " + folder.string());

        std::string temporary = target + ".new.XXXXXX";
        const int descriptor = ::mkostemp(temporary.data(), O_CLOEXEC);
        if (descriptor < 0)
            fail(file, errno);
        int error = writeAll(descriptor, content);
        if (!error && ::fchmod(descriptor, permissionsFor(target)) != 0)
            error = errno;
        const int closed = closeChecked(descriptor);
        error = error ? error : closed;
        if (!error && std::rename(temporary.c_str(), target.c_str()) != 0)
            error = errno;
        if (error)
        {
            ::unlink(temporary.c_str());
            fail(file, error);
        }
    }
}  // namespace parking
