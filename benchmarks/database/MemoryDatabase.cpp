#include "benchmarks/database/MemoryDatabase.h"

#include "parking_geometry/Error.h"

#include <memory>
#include <new>

#include <sqlite3.h>

namespace parking
{
    MemoryDatabase::MemoryDatabase()
    {
        if (sqlite3_open(":memory:", &handle_) != SQLITE_OK)
        {
            sqlite3_close(handle_);
            throw Error("SQLite cannot open a database in memory");
        }
    }

    MemoryDatabase::~MemoryDatabase()
    {
        sqlite3_close(handle_);
    }

    void MemoryDatabase::fail() const
    {
        throw Error(std::string("SQLite: ") + sqlite3_errmsg(handle_));
    }

    void MemoryDatabase::run(const std::string &statements)
    {
        if (sqlite3_exec(handle_, statements.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
            fail();
    }

    std::int64_t MemoryDatabase::lastRow() const
    {
        return sqlite3_last_insert_rowid(handle_);
    }

    std::string MemoryDatabase::bytes() const
    {
        sqlite3_int64 size = 0;
        const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> data(sqlite3_serialize(handle_, "main", &size, 0),
                                                                           sqlite3_free);
        if (!data)
            throw std::bad_alloc();
        return {reinterpret_cast<const char *>(data.get()), static_cast<std::size_t>(size)};
    }

    MemoryDatabase::Statement::Statement(MemoryDatabase &database, const std::string &text) : database_(database)
    {
        check(sqlite3_prepare_v2(database_.handle_, text.c_str(), -1, &statement_, nullptr));
    }

    MemoryDatabase::Statement::~Statement()
    {
        sqlite3_finalize(statement_);
    }

    void MemoryDatabase::Statement::check(int result) const
    {
        if (result != SQLITE_OK)
            database_.fail();
    }

    MemoryDatabase::Statement &MemoryDatabase::Statement::operator<<(std::string_view text)
    {
        check(sqlite3_bind_text64(statement_, next_++, text.empty() ? "" : text.data(), text.size(), SQLITE_STATIC,
                                  SQLITE_UTF8));
        return *this;
    }

    MemoryDatabase::Statement &MemoryDatabase::Statement::operator<<(std::int64_t number)
    {
        check(sqlite3_bind_int64(statement_, next_++, number));
        return *this;
    }

    MemoryDatabase::Statement &MemoryDatabase::Statement::operator<<(double number)
    {
        check(sqlite3_bind_double(statement_, next_++, number));
        return *this;
    }

    MemoryDatabase::Statement &MemoryDatabase::Statement::operator<<(std::nullptr_t)
    {
        check(sqlite3_bind_null(statement_, next_++));
        return *this;
    }

    bool MemoryDatabase::Statement::run()
    {
        const int result = sqlite3_step(statement_);
        if (result == SQLITE_ROW)
            number_ = sqlite3_column_int64(statement_, 0);
        else if (result != SQLITE_DONE)
            database_.fail();
        check(sqlite3_reset(statement_));
        check(sqlite3_clear_bindings(statement_));
        next_ = 1;
        return result == SQLITE_ROW;
    }

    std::string quotedName(std::string_view name)
    {
        std::string result = "\"";
        for (const char letter : name)
            result.append(letter == '"' ? "\"\"" : std::string(1, letter));
        return result + "\"";
    }
}  // namespace parking
