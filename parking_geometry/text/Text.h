#pragma once

#include <string>
#include <string_view>

namespace parking
{
    /** \brief \e text in single quotes for a one-line message. Control characters and bytes outside of ASCII become
        '?'. Text beyond 60 characters is cut. */
    std::string inQuotes(std::string_view text);

    /** \brief \e text with '?' in place of control characters and bytes outside of ASCII. */
    std::string oneLine(std::string_view text);

    /** \brief The shortest decimal form that parses to \e value, or "nan" or "inf", independent of the locale. */
    std::string formatNumber(double value);

    /** \brief \e value with this number of decimals, or "nan" or "inf", independent of the locale. Zero has no sign. */
    std::string formatNumber(double value, int decimals);

    /** \brief \e text without blanks, tabs and line ends at both ends. */
    std::string_view trimmed(std::string_view text);

    /** \brief Parses all of \e text as a decimal number with '.', independent of the locale.

        \return whether it is a finite number; \e value changes only in this case */
    bool parseNumber(std::string_view text, double &value);

    /** \brief Parses all of \e text as a whole number that is not negative.

        \return whether it is one; \e value changes only in this case */
    bool parseCount(std::string_view text, std::size_t &value);
}  // namespace parking
