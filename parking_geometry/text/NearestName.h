#pragma once

#include <string>
#include <vector>

namespace parking
{
    /** \brief \e text with ASCII capital letters in lower case. */
    std::string lowerCase(std::string text);

    /** \brief The name in \e known that is most similar to \e name, ignoring case, for suggestions in messages.

        This is the name with the smallest edit distance or one that contains \e name. The result is empty if each known
        name requires changes of more than a third of the letters and additions of more than half. */
    std::string nearestName(const std::string &name, const std::vector<std::string> &known);

    /** \brief Whether \e name is not in \e known but differs from a known name by at most two letters.

        A known name with fewer than six letters must consist of the same letters, in any case and order, because too
        many other words are similar to it. */
    bool isMisspelt(const std::string &name, const std::vector<std::string> &known);

    /** \brief The one-line message for an unknown name, with up to eight known names, or the three most similar of
       more.

        Examples are "unknown planner 'rrtstr'; did you mean 'rrtstar'? Known: prm, rrtstar", "unknown planner 'tree';
        known: prm, rrtstar" and "unknown planner 'rrtstr'; did you mean 'rrtstar', 'rrt' or 'prm'?".
        \param what kind of the named thing, for example "planner" */
    std::string unknownName(const std::string &what, const std::string &name, const std::vector<std::string> &known);
}  // namespace parking
