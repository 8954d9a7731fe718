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

    /** \brief An open file of SQLite, which one process at a time writes and others may read.

        Changes between BEGIN and COMMIT are made together, and are on the disk afterwards; what was not committed when
        the database is closed, or its process ends, is taken back. All errors are parking::Error with the file's name
       and SQLite's own words. */
    class Database
    {
    public:
        /** \brief How a file is opened. */
        enum class Access
        {
            Read,  ///< nothing is changed but what a killed process left half done
            Write  ///< a missing file becomes a database; refused while another process writes it
        };

        /** \brief Throws parking::Error also when the file is missing, to be read, or written by another process. */
        Database(const std::string &file, Access access);
        ~Database();
        Database(const Database &) = delete;
        Database &operator=(const Database &) = delete;

        /** \brief A statement that can be run again with other values. */
        class Statement
        {
        public:
            /** \brief Prepares \e text, with values for its `?` from left to right. \e database must outlive it. */
            Statement(const Database &database, const std::string &text, const std::vector<SqlValue> &values = {});
            ~Statement();
            Statement(const Statement &) = delete;
            Statement &operator=(const Statement &) = delete;

            /** \brief Starts over with other values. */
            void bind(const std::vector<SqlValue> &values);

            /** \brief Goes on to the next row; false when there is none. */
            bool step();

            /** \brief Names of the columns. */
            std::vector<std::string> names() const;

            /** \brief Type with which a column was declared, counted from 0; empty for an expression. */
            std::string type(int column) const;

            /** \brief A cell of the current row. */
            SqlValue value(int column) const;

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

        /** \brief Runs statements without values. */
        void run(const std::string &statements);

        /** \brief The first cell of the first row that a statement finds; no value when there is none. */
        SqlValue ask(const std::string &statement, const std::vector<SqlValue> &values = {}) const;

        /** \brief The number of the row that was inserted last. */
        std::int64_t lastRow() const;

        /** \brief As it was opened, fit for a message. */
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
