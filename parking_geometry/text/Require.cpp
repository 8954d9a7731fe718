#include "parking_geometry/text/Require.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        /** "a number", "a number of metres". */
        std::string number(const char *kind, std::string_view unit)
        {
            return std::string(kind) + " number" + (unit.empty() ? "" : " of " + std::string(unit));
        }
    }  // namespace

    Require::Require(std::string thing) : thing_(std::move(thing))
    {
    }

    void Require::that(bool ok, std::string_view field, double value, std::string_view right) const
    {
        if (!ok)
            throw FieldError(thing_ + ": " + std::string(field) + " is " + formatNumber(value) + "; it must be " +
                                 std::string(right),
                             std::string(field));
    }

    void Require::positive(std::string_view field, double value, std::string_view unit) const
    {
        if (!(std::isfinite(value) && value > 0.0))
            that(false, field, value, number("a positive", unit));
    }

    void Require::notNegative(std::string_view field, double value, std::string_view unit) const
    {
        if (!(std::isfinite(value) && value >= 0.0))
            that(false, field, value, number("a", unit) + " that is not negative");
    }

    void Require::finite(std::string_view field, double value, std::string_view unit) const
    {
        if (!std::isfinite(value))
            that(false, field, value, number("a finite", unit));
    }
}  // namespace parking
