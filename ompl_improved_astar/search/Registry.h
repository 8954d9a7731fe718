#pragma once

#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"

#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace parking::search
{
    /** \brief Registry of interchangeable parts of one kind, by the names that parameters use.

        The parts of the project are listed in the file of the registry. Programs may add their own with add() before
        they plan; adding while planning is not safe. */
    template <class Part>
    class Registry
    {
    public:
        using Factory = std::function<std::unique_ptr<Part>()>;  ///< creates a part
        using Entry = std::pair<std::string, Factory>;           ///< a name and its factory

        /** \brief \param what the kind of part in an error message, for example "motion_model" */
        Registry(std::string what, std::initializer_list<Entry> entries) : what_(std::move(what)), entries_(entries)
        {
        }

        /** \brief Adds a part, or replaces the one of that name. */
        void add(const std::string &name, Factory factory)
        {
            for (Entry &entry : entries_)
                if (entry.first == name)
                {
                    entry.second = std::move(factory);
                    return;
                }
            entries_.emplace_back(name, std::move(factory));
        }

        /** \brief The names in the order of the registry. */
        std::vector<std::string> names() const
        {
            std::vector<std::string> result;
            for (const Entry &entry : entries_)
                result.push_back(entry.first);
            return result;
        }

        /** \brief Creates a part. Throws parking::Error with the known names for an unknown one. */
        std::unique_ptr<Part> make(const std::string &name) const
        {
            for (const Entry &entry : entries_)
                if (entry.first == name)
                    return entry.second();
            throw Error(unknownName(what_, name, names()));
        }

    private:
        std::string what_;
        std::vector<Entry> entries_;
    };

    /** \brief Creates a default-constructed \e Part, the factory of most entries. */
    template <class Part>
    std::unique_ptr<Part> newPart()
    {
        return std::make_unique<Part>();
    }
}  // namespace parking::search
