#include "benchmarks/system/LockedFile.h"

#include "parking_geometry/Error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace parking
{
    namespace
    {
        constexpr int MOST_ATTEMPTS = 100;  // while others put new files in the place of the one just opened

        bool hasName(int descriptor, const std::string &file)
        {
            struct stat opened = {}, named = {};
            return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 &&
                   opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
        }

        /** Waits until the disk has what was written; the errno of what went wrong. What is no ordinary file has no
            disk to wait for. */
        int toDisk(int descriptor)
        {
            while (fdatasync(descriptor) != 0)
                if (errno != EINTR)
                    return errno == EINVAL || errno == ENOTSUP ? 0 : errno;
            return 0;
        }

        /** The same for the names in a folder; where that is not possible they come to the disk later. */
        void namesToDisk(const std::string &file)
        {
            const std::string folder = std::filesystem::path(file).parent_path().string();
            const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
            if (descriptor < 0)
                return;
            fsync(descriptor);
            close(descriptor);
        }
    }  // namespace

    LockedFile::LockedFile(std::string file) : file_(std::move(file))
    {
        // Opening a pipe waits until somebody reads it, and a device keeps nothing.
        if (std::error_code ignored; std::filesystem::exists(file_, ignored) &&
                                     !std::filesystem::is_regular_file(file_, ignored) &&
                                     !std::filesystem::is_directory(file_, ignored))
            throw Error(file_ + ": is a pipe or a device; it must be a file, which can be gone on with");
        for (int attempt = 0; attempt < MOST_ATTEMPTS; ++attempt)
        {
            descriptor_ = open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
            if (descriptor_ < 0)
                fail(errno);
            // Where a file system knows no locks there is none.
            const bool refused = flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
            if (!refused && hasName(descriptor_, file_))
                return;
            close(std::exchange(descriptor_, -1));
            if (refused)
                break;
        }
        throw Error(file_ + ": another parking_benchmark is writing it at this moment");
    }

    LockedFile::~LockedFile()
    {
        if (descriptor_ >= 0)
            close(descriptor_);
    }

    LockedFile::LockedFile(LockedFile &&other) noexcept
      : file_(std::move(other.file_)),
        descriptor_(std::exchange(other.descriptor_, -1))
    {
    }

    LockedFile &LockedFile::operator=(LockedFile &&other) noexcept
    {
        std::swap(file_, other.file_);
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }

    void LockedFile::cutTo(std::size_t length)
    {
        if (ftruncate(descriptor_, static_cast<off_t>(length)) != 0 || lseek(descriptor_, 0, SEEK_END) < 0)
            fail(errno);
    }

    void LockedFile::append(const std::string &text)
    {
        const off_t before = lseek(descriptor_, 0, SEEK_END);
        std::size_t written = 0;
        int error = before < 0 ? errno : 0;
        while (error == 0 && written < text.size())
        {
            const ssize_t count = write(descriptor_, text.data() + written, text.size() - written);
            if (count >= 0)
                written += static_cast<std::size_t>(count);
            else if (errno != EINTR)
                error = errno;
        }
        if (error == 0)
            error = toDisk(descriptor_);
        if (error == 0)
        {
            if (before == 0)
                namesToDisk(file_);
            return;
        }
        // Readers leave out a line that was cut short; better not to leave one, where that can be helped.
        if (before >= 0 && ftruncate(descriptor_, before) != 0)
            lseek(descriptor_, 0, SEEK_END);
        fail(error);
    }

    void LockedFile::rename(const std::string &name)
    {
        if (std::rename(file_.c_str(), name.c_str()) != 0)
            throw Error(name + ": cannot be written: " + std::strerror(errno));
        file_ = name;
        namesToDisk(file_);
    }

    void LockedFile::fail(int error) const
    {
        throw Error(file_ + ": cannot be written: " + std::strerror(error));
    }
}  // namespace parking
