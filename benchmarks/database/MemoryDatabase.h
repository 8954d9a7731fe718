#pragma once

#include <cstdint>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace parking
{
    /** \brief A SQLite database in memory. All errors are parking::Error with SQLite's own words. */
    class MemoryDatabase
    {
    public:
        MemoryDatabase();
        ~MemoryDatabase();
        MemoryDatabase(const MemoryDatabase &) = delete;
        MemoryDatabase &operator=(const MemoryDatabase &) = delete;

        /** \brief Runs statements that ask and return nothing. */
        void run(const std::string &statements);

        /** \brief The number of the row that was inserted last. */
        std::int64_t lastRow() const;

        /** \brief The database as the bytes of a file. */
        std::string bytes() const;

        /** \brief A statement that is run again and again with other values, each bound to a `?` from left to right. */
        class Statement
        {
        public:
            /** \brief Prepares \e text. \e database must outlive the statement. */
            Statement(MemoryDatabase &database, const std::string &text);
            ~Statement();
            Statement(const Statement &) = delete;
            Statement &operator=(const Statement &) = delete;

            /** \brief Binds the next value. A text must outlive the run. */
            Statement &operator<<(std::string_view text);

            /** \brief Binds a whole number. */
            Statement &operator<<(std::int64_t number);

            /** \brief Binds a number; NaN becomes NULL. */
            Statement &operator<<(double number);

            /** \brief Binds NULL. */
            Statement &operator<<(std::nullptr_t);

            /** \brief Runs it, and makes room for the next values.

                \return whether a row was found; its first column is in number() */
            bool run();

            /** \brief First column of the row that run() found. */
            std::int64_t number() const
            {
                return number_;
            }

        private:
            void check(int result) const;

            MemoryDatabase &database_;
            sqlite3_stmt *statement_{nullptr};
            int next_{1};
            std::int64_t number_{0};
        };

    private:
        [[noreturn]] void fail() const;

        sqlite3 *handle_{nullptr};
    };

    /** \brief A name as it stands in a statement, whatever characters it has. */
    std::string quotedName(std::string_view name);
}  // namespace parking
