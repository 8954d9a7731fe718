#include "parking_geometry/text/Text.h"

#include <array>
#include <charconv>
#include <cmath>
#ifndef __cpp_lib_to_chars
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#endif

namespace parking
{
#ifndef __cpp_lib_to_chars
    // The C++ library of emscripten 3.1 does not support floating-point numbers in <charconv>. Programs for browsers
    // use only the locale "C".
    namespace
    {
        std::string shortest(double value, bool everyday)
        {
            char buffer[64];
            for (int digits = 1; digits <= 17; ++digits)
            {
                std::snprintf(buffer, sizeof(buffer), "%.*g", digits, value);
                if (std::strtod(buffer, nullptr) != value)
                    continue;
                // The same digits in the required notation.
                if (everyday)
                {
                    const int exponent = value == 0.0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
                    for (int decimals = std::max(0, digits - 2 - exponent); decimals < 40; ++decimals)
                    {
                        std::snprintf(buffer, sizeof(buffer), "%.*f", decimals, value);
                        if (std::strtod(buffer, nullptr) == value)
                            break;
                    }
                }
                break;
            }
            return buffer;
        }
    }  // namespace
#endif

    std::string oneLine(std::string_view text)
    {
        std::string result(text);
        for (char &c : result)
            if (c < ' ' || c > '~')
                c = '?';
        return result;
    }

    std::string inQuotes(std::string_view text)
    {
        constexpr std::size_t MAX_LENGTH = 60;
        return "'" + oneLine(text.substr(0, MAX_LENGTH)) + (text.size() > MAX_LENGTH ? "...'" : "'");
    }

    std::string formatNumber(double value)
    {
        if (std::isnan(value))
            return "nan";
        // The shortest form of 100000 would be 1e+05.
        const bool everyday = value == 0.0 || (std::abs(value) >= 1e-4 && std::abs(value) < 1e15);
#ifdef __cpp_lib_to_chars
        char buffer[64];
        const std::to_chars_result end =
            everyday ? std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::fixed)
                     : std::to_chars(buffer, buffer + sizeof(buffer), value);
        return std::string(buffer, end.ptr);
#else
        return shortest(value, everyday);
#endif
    }

    std::string formatNumber(double value, int decimals)
    {
        if (std::isnan(value))
            return "nan";
        std::array<char, 400> buffer;  // sufficient for the largest number
#ifdef __cpp_lib_to_chars
        const std::to_chars_result end =
            std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
        const std::string text(buffer.data(), end.ptr);
#else
        std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value);
        const std::string text(buffer.data());
#endif
        const bool isNegativeZero = text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos;
        return isNegativeZero ? text.substr(1) : text;
    }

    std::string_view trimmed(std::string_view text)
    {
        constexpr std::string_view BLANKS = " \t\r\n\v\f";
        const std::size_t first = text.find_first_not_of(BLANKS);
        if (first == std::string_view::npos)
            return {};
        return text.substr(first, text.find_last_not_of(BLANKS) - first + 1);
    }

    bool parseNumber(std::string_view text, double &value)
    {
        // from_chars rejects a leading plus sign, and "+-1" must stay invalid.
        if (text.size() > 1 && text[0] == '+' && text[1] != '-')
            text.remove_prefix(1);
        double number = 0.0;
#ifdef __cpp_lib_to_chars
        const std::from_chars_result end = std::from_chars(text.data(), text.data() + text.size(), number);
        if (end.ec != std::errc() || end.ptr != text.data() + text.size() || !std::isfinite(number))
            return false;
#else
        // strtod accepts more than decimal numbers.
        if (text.empty() || text.find_first_not_of("+-.0123456789eE") != std::string_view::npos || text[0] == '+')
            return false;
        const std::string copy(text);
        char *end = nullptr;
        number = std::strtod(copy.c_str(), &end);
        if (end != copy.c_str() + copy.size() || !std::isfinite(number))
            return false;
#endif
        value = number;
        return true;
    }

    bool parseCount(std::string_view text, std::size_t &value)
    {
        std::size_t number = 0;
        const std::from_chars_result end = std::from_chars(text.data(), text.data() + text.size(), number);
        if (end.ec != std::errc() || end.ptr != text.data() + text.size())
            return false;
        value = number;
        return true;
    }
}  // namespace parking
