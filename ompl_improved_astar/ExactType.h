#pragma once

#include <memory>
#include <typeinfo>

namespace parking
{
    /** \brief The object if it is of exactly this class, otherwise nullptr: a derived class may behave differently. */
    template <class Class, class Base>
    const Class *exactly(const std::shared_ptr<Base> &object)
    {
        const Base *known = object.get();
        return known != nullptr && typeid(*known) == typeid(Class) ? static_cast<const Class *>(known) : nullptr;
    }
}  // namespace parking
