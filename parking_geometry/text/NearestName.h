#pragma once

#include <string>
#include <vector>

namespace parking
{
    /** \brief \e text with small letters for the capital ones of ASCII. */
    std::string lowerCase(std::string text);

    /** \brief The name in \e known that \e name was most likely meant to be: the one with the fewest letters to change,
        whatever their case, or one that \e name is a part of. Empty when none is near: when of each more than a third
        of the letters would have to change, and more than half to be added. */
    std::string nearestName(const std::string &name, const std::vector<std::string> &known);

    /** \brief Is \e name not in \e known, but at most two letters away from a name that is? */
    bool isMisspelt(const std::string &name, const std::vector<std::string> &known);

    /** \brief The one-line message for a name that nothing has, with the nearest, if one is near, and all known ones:
        "unknown planner 'rrtstr'; did you mean 'rrtstar'? Known: prm, rrtstar", or "unknown planner 'tree'; known:
       ...".

        \param what what the name was to be, for example "planner" */
    std::string unknownName(const std::string &what, const std::string &name, const std::vector<std::string> &known);
}  // namespace parking
