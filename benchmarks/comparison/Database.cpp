#include "benchmarks/comparison/Database.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <cstring>
#include <limits>
#include <utility>

#include <sqlite3.h>

namespace parking
{
    Database::Database(std::string file, Access access) : file_(std::move(file))
    {
        const int flags = SQLITE_OPEN_READWRITE | (access == Access::Read ? 0 : SQLITE_OPEN_CREATE);
        const int result =
            sqlite3_open_v2(file_.c_str(), &handle_, flags, access == Access::WriteUnlocked ? "unix-none" : nullptr);
        try
        {
            check(result);
            // Readers hold up a commit for as long as they read.
            check(sqlite3_busy_timeout(handle_, std::numeric_limits<int>::max()));
            runAll("PRAGMA journal_mode = DELETE; PRAGMA synchronous = FULL");
        }
        catch (const Error &)
        {
            sqlite3_close(handle_);
            throw;
        }
    }

    Database::~Database()
    {
        sqlite3_close(handle_);
    }

    void Database::fail() const
    {
        const int cause = sqlite3_system_errno(handle_);
        const std::string text = oneLine(file_) + ": SQLite: " + oneLine(sqlite3_errmsg(handle_)) +
                                 (cause != 0 ? std::string(" (") + std::strerror(cause) + ")" : "");
        const int code = sqlite3_errcode(handle_);
        if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT)
            throw DatabaseDamage(text);
        throw Error(text);
    }

    void Database::check(int result) const
    {
        if (result != SQLITE_OK)
            fail();
    }

    void Database::run(const std::string &statement, const std::vector<SqlValue> &values)
    {
        ask(statement, values);
    }

    void Database::runAll(const std::string &statements)
    {
        check(sqlite3_exec(handle_, statements.c_str(), nullptr, nullptr, nullptr));
    }

    SqlValue Database::ask(const std::string &query, const std::vector<SqlValue> &values) const
    {
        Statement statement(*this, query);
        statement.bind(values);
        return statement.step() ? statement.cell(0) : SqlValue(nullptr);
    }

    std::int64_t Database::lastRow() const
    {
        return sqlite3_last_insert_rowid(handle_);
    }

    Database::Statement::Statement(const Database &database, const std::string &text) : database_(database)
    {
        database_.check(sqlite3_prepare_v2(database_.handle_, text.c_str(), -1, &statement_, nullptr));
    }

    Database::Statement::~Statement()
    {
        sqlite3_finalize(statement_);
    }

    void Database::Statement::bind(const std::vector<SqlValue> &values)
    {
        sqlite3_reset(statement_);  // an error of the last run was told then
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

    int Database::Statement::columns() const
    {
        return sqlite3_column_count(statement_);
    }

    std::string Database::Statement::name(int column) const
    {
        return sqlite3_column_name(statement_, column);
    }

    std::string Database::Statement::type(int column) const
    {
        const char *type = sqlite3_column_decltype(statement_, column);
        return type == nullptr ? "" : type;
    }

    SqlValue Database::Statement::cell(int column) const
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

    Database::Transaction::Transaction(Database &database) : database_(database)
    {
        database_.run("BEGIN IMMEDIATE");
    }

    Database::Transaction::~Transaction()
    {
        // What cannot be taken back now is taken back by whoever opens the file next.
        if (open_)
            sqlite3_exec(database_.handle_, "ROLLBACK", nullptr, nullptr, nullptr);
    }

    void Database::Transaction::commit()
    {
        database_.run("COMMIT");
        open_ = false;
    }

    std::string quotedName(const std::string &name)
    {
        std::string result = "\"";
        for (const char letter : name)
            result.append(letter == '"' ? "\"\"" : std::string(1, letter));
        return result + "\"";
    }
}  // namespace parking
