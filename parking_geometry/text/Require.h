#pragma once

#include <string>
#include <string_view>

namespace parking
{
    /** \brief Checks the values of one thing.

        A value that is not right is a parking::FieldError that names the thing, the field, its value and what would be
        right, for example "mpc: step is 0; it must be above 0 and up to 1 second". */
    class Require
    {
    public:
        /** \param thing what the values belong to, for example "mpc" */
        explicit Require(std::string thing);

        /** \brief Throws unless \e ok; \e right goes on after "it must be". */
        void that(bool ok, std::string_view field, double value, std::string_view right) const;

        /** \brief Finite and above zero; \e unit as in "a positive number of metres", empty for none. */
        void positive(std::string_view field, double value, std::string_view unit = {}) const;

        /** \brief Finite and not below zero. */
        void notNegative(std::string_view field, double value, std::string_view unit = {}) const;

        /** \brief Not infinite and not NaN. */
        void finite(std::string_view field, double value, std::string_view unit = {}) const;

    private:
        std::string thing_;
    };
}  // namespace parking
