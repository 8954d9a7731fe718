// A disk that fills up, for tests: preloaded (LD_PRELOAD), it lets the first FULL_DISK_AFTER calls that take room on a
// disk pass, of all processes together, and fails all later ones with ENOSPC. FULL_DISK_COUNTER names a file of 8 bytes
// that holds the number of calls.

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdlib>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

namespace
{
    std::atomic<long> *theCounter()
    {
        static std::atomic<long> *const COUNTER = []() -> std::atomic<long> *
        {
            const char *file = std::getenv("FULL_DISK_COUNTER");
            using Open = int (*)(const char *, int, ...);
            const auto realOpen = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "open"));
            const int descriptor = file == nullptr ? -1 : realOpen(file, O_RDWR | O_CLOEXEC);
            if (descriptor < 0)
                return nullptr;
            void *memory = mmap(nullptr, sizeof(std::atomic<long>), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
            close(descriptor);
            return memory == MAP_FAILED ? nullptr : static_cast<std::atomic<long> *>(memory);
        }();
        return COUNTER;
    }

    bool isFull()
    {
        const char *after = std::getenv("FULL_DISK_AFTER");
        if (theCounter() == nullptr || after == nullptr || ++*theCounter() <= std::atol(after))
            return false;
        errno = ENOSPC;
        return true;
    }

    bool isFile(int descriptor)
    {
        struct stat status = {};
        return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
    }

    template <class Function>
    Function *real(const char *name, Function * /*type*/)
    {
        return reinterpret_cast<Function *>(dlsym(RTLD_NEXT, name));
    }

    int modeOf(int flags, va_list arguments)
    {
        return (flags & O_CREAT) != 0 ? va_arg(arguments, int) : 0;
    }

    bool makesFile(const char *name, int flags)
    {
        return (flags & O_CREAT) != 0 && access(name, F_OK) != 0;
    }
}  // namespace

extern "C"
{
    ssize_t write(int descriptor, const void *data, size_t size)
    {
        static auto *const CALL = real("write", write);
        return isFile(descriptor) && isFull() ? -1 : CALL(descriptor, data, size);
    }

    ssize_t pwrite(int descriptor, const void *data, size_t size, off_t at)
    {
        static auto *const CALL = real("pwrite", pwrite);
        return isFile(descriptor) && isFull() ? -1 : CALL(descriptor, data, size, at);
    }

    ssize_t pwrite64(int descriptor, const void *data, size_t size, off64_t at)
    {
        static auto *const CALL = real("pwrite64", pwrite64);
        return isFile(descriptor) && isFull() ? -1 : CALL(descriptor, data, size, at);
    }

    ssize_t writev(int descriptor, const iovec *parts, int count)
    {
        static auto *const CALL = real("writev", writev);
        return isFile(descriptor) && isFull() ? -1 : CALL(descriptor, parts, count);
    }

    int fsync(int descriptor)
    {
        static auto *const CALL = real("fsync", fsync);
        return isFile(descriptor) && isFull() ? -1 : CALL(descriptor);
    }

    int fdatasync(int descriptor)
    {
        static auto *const CALL = real("fdatasync", fdatasync);
        return isFile(descriptor) && isFull() ? -1 : CALL(descriptor);
    }

    int link(const char *from, const char *to) noexcept
    {
        static auto *const CALL = real("link", link);
        return isFull() ? -1 : CALL(from, to);
    }

    int mkdir(const char *name, mode_t mode) noexcept
    {
        static auto *const CALL = real("mkdir", mkdir);
        return isFull() ? -1 : CALL(name, mode);
    }

    int mkostemp(char *pattern, int flags)
    {
        static auto *const CALL = real("mkostemp", mkostemp);
        return isFull() ? -1 : CALL(pattern, flags);
    }

    int open(const char *name, int flags, ...)
    {
        static auto *const CALL = real("open", open);
        va_list arguments;
        va_start(arguments, flags);
        const int mode = modeOf(flags, arguments);
        va_end(arguments);
        return makesFile(name, flags) && isFull() ? -1 : CALL(name, flags, mode);
    }

    int open64(const char *name, int flags, ...)
    {
        static auto *const CALL = real("open64", open64);
        va_list arguments;
        va_start(arguments, flags);
        const int mode = modeOf(flags, arguments);
        va_end(arguments);
        return makesFile(name, flags) && isFull() ? -1 : CALL(name, flags, mode);
    }
}
