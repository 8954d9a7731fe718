#include "benchmarks/system/FileLock.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace parking
{
    namespace
    {
        constexpr off_t PLACE = off_t(1) << 62;  // of the byte that is locked: behind all that SQLite locks

        bool hasName(int descriptor, const std::string &file)
        {
            struct stat opened = {}, named = {};
            return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 &&
                   opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
        }
    }  // namespace

    FileLock::FileLock(const std::string &file)
    {
        // Opening a pipe waits until somebody reads it, and a device keeps nothing.
        if (std::error_code ignored; std::filesystem::exists(file, ignored) &&
                                     !std::filesystem::is_regular_file(file, ignored) &&
                                     !std::filesystem::is_directory(file, ignored))
            throw Error(oneLine(file) + ": is a pipe or a device; it must be a file, which can be gone on with");
        descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0)
            throw Error(oneLine(file) + ": cannot be written: " + std::strerror(errno));
        struct flock lock = {};
        lock.l_type = F_WRLCK;
        lock.l_whence = SEEK_SET;
        lock.l_start = PLACE;
        lock.l_len = 1;
        locked_ = fcntl(descriptor_, F_OFD_SETLK, &lock) == 0;
        // Another process may have set the file aside since it was opened.
        if (!hasName(descriptor_, file) || (!locked_ && (errno == EAGAIN || errno == EACCES)))
        {
            close(descriptor_);
            throw Error(oneLine(file) + ": another parking_benchmark is writing it at this moment");
        }
    }

    FileLock::~FileLock()
    {
        close(descriptor_);
    }
}  // namespace parking
