#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/** \brief What the fuzz targets have in common. A target is one file that defines tryInput(); CONTRIBUTING.md says how
   they are run. */
namespace parking_test::fuzz
{
    /** \brief Tries one input. What it finds wrong it hands to fail(); an exception that leaves it is a finding, too.
     */
    void tryInput(const std::string &input);

    /** \brief Ends the process: the input that was being tried is a finding. */
    [[noreturn]] void fail(const std::string &finding);

    /** \brief Tells the fuzzer that something new was reached, so that it keeps the input that led there and goes on
       from it.

        With a compiler that instruments the code this is a small help; without one it is all that the fuzzer goes by.
     */
    void reached(const std::string &what);

    /** \brief Runs \e read, whose only way to refuse is a parking::Error of one line that names \e file.

        \return whether it did not refuse */
    template <class Read>
    bool accepts(const std::string &file, const Read &read);

    /** \brief Writes a file for a reader that takes no text. It is in a folder of this process, the same one every
       time. \return its path */
    std::string writeInput(const std::string &name, const std::string &content);

    /** \brief An input as the numbers that a target needs; when it comes to an end all that follow are 0. */
    class Numbers
    {
    public:
        explicit Numbers(const std::string &input) : input_(input)
        {
        }

        bool atEnd() const
        {
            return next_ >= input_.size();
        }

        std::uint8_t byte();

        bool flag()
        {
            return (byte() & 1U) != 0;
        }

        /** \brief 0 to count - 1, of one byte. */
        std::size_t below(std::size_t count)
        {
            return byte() % count;
        }

        /** \brief Of two bytes, so that equal numbers and whole ones come up. */
        double between(double low, double high);

        /** \brief Any double at all, of nine bytes or less: often a plain number, sometimes none. */
        double anything();

    private:
        const std::string &input_;
        std::size_t next_{0};
    };
}  // namespace parking_test::fuzz

#include "parking_geometry/Error.h"

namespace parking_test::fuzz
{
    /** \brief Throws what is wrong with the message of an error, by way of fail(). */
    void checkMessage(const std::string &file, const std::string &message);

    template <class Read>
    bool accepts(const std::string &file, const Read &read)
    {
        try
        {
            read();
            reached("accepted");
            return true;
        }
        catch (const parking::Error &error)
        {
            checkMessage(file, error.what());
            return false;
        }
    }
}  // namespace parking_test::fuzz
