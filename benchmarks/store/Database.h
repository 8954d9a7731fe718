#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace parking
{
    /** \brief A cell of a database. */
    using SqlValue = std::variant<std::nullptr_t, std::int64_t, double, std::string>;

    /** \brief An open file of SQLite, written by one process at a time and readable by others.

        Changes between BEGIN and COMMIT are made as one, and are on the disk afterwards. Changes without COMMIT are
        undone when the database is closed or its process ends. All errors are parking::Error with the file's name and
        SQLite's message. */
    class Database
    {
    public:
        /** \brief Mode in which a file is opened. */
        enum class Access
        {
            Read,  ///< no changes, except to complete the recovery after a killed process
            Write  ///< creates a missing file; throws while another process writes it
        };

        /** \brief Opens a file. Throws parking::Error also when a file to read is missing, or another process writes a
            file to write. */
        Database(const std::string &file, Access access);
        ~Database();
        Database(const Database &) = delete;
        Database &operator=(const Database &) = delete;

        /** \brief A statement that can be executed repeatedly with different values. */
        class Statement
        {
        public:
            /** \brief Prepares \e text, with values for its `?` from left to right. \e database must outlive it. */
            Statement(const Database &database, const std::string &text, const std::vector<SqlValue> &values = {});
            ~Statement();
            Statement(const Statement &) = delete;
            Statement &operator=(const Statement &) = delete;

            /** \brief Restarts the statement with other values. */
            void bind(const std::vector<SqlValue> &values);

            /** \brief Advances to the next row; false when there is none. */
            bool step();

            /** \brief Names of the columns. */
            std::vector<std::string> names() const;

            /** \brief Declared type of a column, counted from 0; empty for an expression. */
            std::string type(int column) const;

            /** \brief A cell of the current row. */
            SqlValue value(int column) const;

            /** \brief A cell of the current row as text; empty for a cell without a value. */
            std::string text(int column) const;

            /** \brief A cell of the current row as a whole number; 0 for a cell without a value. */
            std::int64_t number(int column) const;

            /** \brief A cell of the current row as a number; 0 for a cell without a value. */
            double real(int column) const;

        private:
            const Database &database_;
            sqlite3_stmt *statement_{nullptr};
        };

        /** \brief Executes statements without values. */
        void run(const std::string &statements);

        /** \brief The first cell of the first row of a query; no value without rows. */
        SqlValue valueOf(const std::string &statement, const std::vector<SqlValue> &values = {}) const;

        /** \brief The number of the row that was inserted last. */
        std::int64_t lastRow() const;

        /** \brief Name of the file as given, for messages. */
        const std::string &file() const
        {
            return file_;
        }

    private:
        void lock(const std::string &file);
        [[noreturn]] void fail() const;
        void check(int result) const;
        void close();

        std::string file_;
        int lock_{-1};
        bool locked_{false};
        sqlite3 *handle_{nullptr};
    };

    /** \brief A name in double quotes, for SQL. */
    std::string quotedName(const std::string &name);
}  // namespace parking
