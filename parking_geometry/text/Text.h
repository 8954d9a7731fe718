#pragma once

#include <string>
#include <string_view>

namespace parking
{
    /** \brief \e text in single quotes, fit to stand in a one-line message: control characters and bytes outside of
        ASCII become '?', and more than 60 characters are cut. */
    std::string inQuotes(std::string_view text);

    /** \brief \e text with '?' for control characters and bytes outside of ASCII. */
    std::string oneLine(std::string_view text);

    /** \brief The shortest decimal form that reads back as \e value; "nan" and "inf" as such. No locale. */
    std::string formatNumber(double value);

    /** \brief \e value with so many digits behind the point and no sign before a zero; "nan" and "inf" as such. No
        locale. */
    std::string formatNumber(double value, int decimals);

    /** \brief Without the blanks, tabs and line ends at both ends. */
    std::string_view trimmed(std::string_view text);

    /** \brief Reads all of \e text as a decimal number, with '.' whatever the locale.

        \return whether it is a finite number; \e value is set only then */
    bool parseNumber(std::string_view text, double &value);

    /** \brief Reads all of \e text as a whole number that is not negative. */
    bool parseCount(std::string_view text, std::size_t &value);
}  // namespace parking
