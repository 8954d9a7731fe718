#pragma once

#include "parking_geometry/text/Text.h"
#include "tests/parking_geometry/ExpectError.h"

#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace parking_test
{
    /** \brief A number among \e Parameters: its name in messages, and values that it must not have. */
    template <class Parameters>
    struct RefusedField
    {
        std::string name;
        std::function<void(Parameters &, double)> set;
        std::vector<double> wrong;
    };

    /** \brief Sets the number that members lead to, one within the other: field(&Drive::car, &Car::width). */
    template <class... Members>
    auto field(Members... members)
    {
        return [members...](auto &parameters, double value)
        {
            auto &target = (parameters.*....*members);
            target = static_cast<std::decay_t<decltype(target)>>(value);
        };
    }

    /** \brief Expects that \e use takes parameters as they are by default, and names each wrong value of a field. */
    template <class Parameters>
    void expectRefused(const std::vector<RefusedField<Parameters>> &fields,
                       const std::function<void(const Parameters &)> &use)
    {
        EXPECT_NO_THROW(use(Parameters()));
        for (const RefusedField<Parameters> &each : fields)
            for (const double value : each.wrong)
            {
                Parameters parameters;
                each.set(parameters, value);
                SCOPED_TRACE(each.name);
                expectError([&] { use(parameters); }, {each.name + " is " + parking::formatNumber(value)});
            }
    }
}  // namespace parking_test
