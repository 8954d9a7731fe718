#include "benchmarks/store/Database.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

namespace parking
{
    Database::Database(const std::string &file, Access access) : file_(oneLine(file))
    {
        if (access == Access::Write)
            lock(file);
        const int flags = SQLITE_OPEN_READWRITE | (access == Access::Write ? SQLITE_OPEN_CREATE : 0);
        // On file systems without locks, SQLite does not lock either.
        const char *system = access == Access::Write && !locked_ ? "unix-none" : nullptr;
        try
        {
            check(sqlite3_open_v2(file.c_str(), &handle_, flags, system));
            // Readers delay a commit while they read.
            check(sqlite3_busy_timeout(handle_, std::numeric_limits<int>::max()));
            // One file that is readable at any time; other journals need shared memory, or two files.
            run("PRAGMA journal_mode = DELETE; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON");
        }
        catch (const Error &)
        {
            close();
            throw;
        }
    }

    Database::~Database()
    {
        close();
    }

    void Database::lock(const std::string &file)
    {
        namespace fs = std::filesystem;
        // Opening a pipe blocks until it has a reader, and a device stores nothing.
        if (std::error_code ignored;
            fs::exists(file, ignored) && !fs::is_regular_file(file, ignored) && !fs::is_directory(file, ignored))
            throw Error(file_ + ": is a pipe or a device; it must be a file, so that it can be extended later");
        lock_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (lock_ < 0)
            throw Error(file_ + ": cannot be written: " + std::strerror(errno));
        // A byte beyond all that SQLite locks. The system unlocks it when the process ends in any way.
        struct flock place = {};
        place.l_type = F_WRLCK;
        place.l_whence = SEEK_SET;
        place.l_start = off_t(1) << 62;
        place.l_len = 1;
        locked_ = fcntl(lock_, F_OFD_SETLK, &place) == 0;
        if (!locked_ && (errno == EAGAIN || errno == EACCES))
        {
            close();
            throw Error(file_ + ": another parking_benchmark is writing it");
        }
    }

    void Database::close()
    {
        sqlite3_close(handle_);
        // Afterwards: closing the file releases SQLite's locks of this process.
        if (lock_ >= 0)
            ::close(lock_);
    }

    void Database::fail() const
    {
        const int code = sqlite3_errcode(handle_);
        const std::string text = sqlite3_errmsg(handle_);
        int cause = sqlite3_system_errno(handle_);
        if (cause == 0 && code == SQLITE_IOERR)  // a file has its own reason (quota, limit of its size)
            sqlite3_file_control(handle_, "main", SQLITE_FCNTL_LAST_ERRNO, &cause);
        // If SQLite cannot create a file, it opens it again, and reports that it is missing.
        throw Error(file_ + ": SQLite: " + oneLine(text) +
                    (cause != 0 && cause != ENOENT ? std::string(" (") + std::strerror(cause) + ")" : "") +
                    (code == SQLITE_NOTADB || code == SQLITE_CORRUPT ? "; move it, or choose another file" : ""));
    }

    void Database::check(int result) const
    {
        if (result != SQLITE_OK)
            fail();
    }

    void Database::run(const std::string &statements)
    {
        check(sqlite3_exec(handle_, statements.c_str(), nullptr, nullptr, nullptr));
    }

    SqlValue Database::valueOf(const std::string &statement, const std::vector<SqlValue> &values) const
    {
        Statement answer(*this, statement, values);
        return answer.step() ? answer.value(0) : SqlValue(nullptr);
    }

    std::int64_t Database::lastRow() const
    {
        return sqlite3_last_insert_rowid(handle_);
    }

    Database::Statement::Statement(const Database &database, const std::string &text,
                                   const std::vector<SqlValue> &values)
      : database_(database)
    {
        database_.check(sqlite3_prepare_v2(database_.handle_, text.c_str(), -1, &statement_, nullptr));
        bind(values);
    }

    Database::Statement::~Statement()
    {
        sqlite3_finalize(statement_);
    }

    void Database::Statement::bind(const std::vector<SqlValue> &values)
    {
        sqlite3_reset(statement_);  // an error of the last step was thrown already
        for (std::size_t i = 0; i < values.size(); ++i)
        {
            const int place = static_cast<int>(i) + 1;
            if (const auto *text = std::get_if<std::string>(&values[i]))
                database_.check(
                    sqlite3_bind_text64(statement_, place, text->data(), text->size(), SQLITE_TRANSIENT, SQLITE_UTF8));
            else if (const auto *whole = std::get_if<std::int64_t>(&values[i]))
                database_.check(sqlite3_bind_int64(statement_, place, *whole));
            else if (const auto *real = std::get_if<double>(&values[i]))
                database_.check(sqlite3_bind_double(statement_, place, *real));
            else
                database_.check(sqlite3_bind_null(statement_, place));
        }
    }

    bool Database::Statement::step()
    {
        const int result = sqlite3_step(statement_);
        if (result != SQLITE_ROW && result != SQLITE_DONE)
            database_.fail();
        return result == SQLITE_ROW;
    }

    std::vector<std::string> Database::Statement::names() const
    {
        std::vector<std::string> names;
        for (int i = 0; i < sqlite3_column_count(statement_); ++i)
            names.emplace_back(sqlite3_column_name(statement_, i));
        return names;
    }

    std::string Database::Statement::type(int column) const
    {
        const char *type = sqlite3_column_decltype(statement_, column);
        return type == nullptr ? "" : type;
    }

    SqlValue Database::Statement::value(int column) const
    {
        switch (sqlite3_column_type(statement_, column))
        {
            case SQLITE_NULL:
                return nullptr;
            case SQLITE_INTEGER:
                return number(column);
            case SQLITE_FLOAT:
                return real(column);
            default:
                return text(column);
        }
    }

    std::string Database::Statement::text(int column) const
    {
        const auto *bytes = static_cast<const char *>(sqlite3_column_blob(statement_, column));
        return bytes == nullptr ? "" : std::string(bytes, sqlite3_column_bytes(statement_, column));
    }

    std::int64_t Database::Statement::number(int column) const
    {
        return sqlite3_column_int64(statement_, column);
    }

    double Database::Statement::real(int column) const
    {
        return sqlite3_column_double(statement_, column);
    }

    std::string quotedName(const std::string &name)
    {
        std::string result = "\"";
        for (const char letter : name)
            result.append(letter == '"' ? "\"\"" : std::string(1, letter));
        return result + "\"";
    }
}  // namespace parking
