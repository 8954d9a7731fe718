#pragma once

#include <string>
#include <string_view>

namespace parking
{
    /** \brief Checks the fields of one object.

        For an invalid value the class throws a parking::FieldError that names the object, the field, its value and the
        valid values. An example is "mpc: step is 0; it must be above 0 and up to 1 second". */
    class Require
    {
    public:
        /** \param thing name of the object in messages, for example "mpc" */
        explicit Require(std::string thing);

        /** \brief Throws unless \e ok. \param right valid values, which follow "it must be" in the message */
        void that(bool ok, std::string_view field, double value, std::string_view right) const;

        /** \brief Requires a finite value above zero. \param unit as in "a positive number of metres", or empty */
        void positive(std::string_view field, double value, std::string_view unit = {}) const;

        /** \brief Requires a finite value that is not negative. \param unit as in "a number of metres", or empty */
        void notNegative(std::string_view field, double value, std::string_view unit = {}) const;

        /** \brief Requires a finite value. \param unit as in "a finite number of metres", or empty */
        void finite(std::string_view field, double value, std::string_view unit = {}) const;

    private:
        std::string thing_;
    };
}  // namespace parking
