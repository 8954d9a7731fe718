#pragma once

#include "parking_geometry/Error.h"

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

    /** \brief A file is no database, or a damaged one. */
    class DatabaseDamage : public Error
    {
    public:
        using Error::Error;
    };

    /** \brief An open file of SQLite. All errors are parking::Error with the file's name and SQLite's own words.

        Other processes may read the file between two transactions. */
    class Database
    {
    public:
        /** \brief How a file is opened. */
        enum class Access
        {
            Read,          ///< nothing is changed but what a killed process left half done
            Write,         ///< an empty file becomes a database
            WriteUnlocked  ///< the same on a file system that has no locks
        };

        Database(std::string file, Access access);
        ~Database();
        Database(const Database &) = delete;
        Database &operator=(const Database &) = delete;

        /** \brief A statement that can be run again with other values. */
        class Statement
        {
        public:
            /** \brief Prepares \e text. \e database must outlive the statement. */
            Statement(const Database &database, const std::string &text);
            ~Statement();
            Statement(const Statement &) = delete;
            Statement &operator=(const Statement &) = delete;

            /** \brief Starts over with these values for the `?` of the text, from left to right. */
            void bind(const std::vector<SqlValue> &values);

            /** \brief Goes on to the next row; false when there is none. */
            bool step();

            /** \brief Number of columns of a row. */
            int columns() const;

            /** \brief Name of a column, counted from 0. */
            std::string name(int column) const;

            /** \brief Type with which the column was declared; empty for an expression. */
            std::string type(int column) const;

            /** \brief A cell of the current row. */
            SqlValue cell(int column) const;

            /** \brief The same as a text; empty for a cell without a value. */
            std::string text(int column) const;

            /** \brief The same as a whole number; 0 for a cell without a value. */
            std::int64_t number(int column) const;

            /** \brief The same as any number. */
            double real(int column) const;

        private:
            const Database &database_;
            sqlite3_stmt *statement_{nullptr};
        };

        /** \brief All changes during its life are made together by commit(), or not at all. */
        class Transaction
        {
        public:
            explicit Transaction(Database &database);
            ~Transaction();
            Transaction(const Transaction &) = delete;
            Transaction &operator=(const Transaction &) = delete;

            /** \brief On return the changes are on the disk. */
            void commit();

        private:
            Database &database_;
            bool open_{true};
        };

        /** \brief Runs one statement with these values. */
        void run(const std::string &statement, const std::vector<SqlValue> &values = {});

        /** \brief Runs several statements without values. */
        void runAll(const std::string &statements);

        /** \brief The first cell of the first row that a query finds; no value when there is none. */
        SqlValue ask(const std::string &query, const std::vector<SqlValue> &values = {}) const;

        /** \brief The number of the row that was inserted last. */
        std::int64_t lastRow() const;

        /** \brief As it was opened. */
        const std::string &file() const
        {
            return file_;
        }

    private:
        [[noreturn]] void fail() const;
        void check(int result) const;

        std::string file_;
        sqlite3 *handle_{nullptr};
    };

    /** \brief A name in double quotes, for SQL. */
    std::string quotedName(const std::string &name);
}  // namespace parking
