#include "parking_geometry/text/NearestName.h"

#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr std::size_t LISTED = 8;     // most names of which a message lists all
        constexpr std::size_t SUGGESTED = 3;  // names that it suggests of more

        /** Edit distance with substitutions, deletions, insertions and swaps of neighbours, with three rows of the
            table. */
        std::size_t editDistance(const std::string &a, const std::string &b)
        {
            std::vector<std::size_t> before, last, row(b.size() + 1);
            std::iota(row.begin(), row.end(), std::size_t(0));
            for (std::size_t i = 1; i <= a.size(); ++i)
            {
                before = std::move(last);
                last = row;
                row[0] = i;
                for (std::size_t j = 1; j <= b.size(); ++j)
                {
                    const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
                    row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
                    if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                        row[j] = std::min(row[j], before[j - 2] + 1);
                }
            }
            return row[b.size()];
        }

        /** Whether at most a third of the letters differ, rounded up, or at most half of them are missing. */
        bool isNear(std::size_t distance, const std::string &name, const std::string &candidate)
        {
            const bool isShortened = name.size() + distance == candidate.size() && 2 * distance <= candidate.size();
            return isShortened || 3 * distance <= std::max(name.size(), candidate.size()) + 2;
        }

        struct Similarity
        {
            std::size_t distance;  ///< smaller for more similar names
            bool isNear;           ///< whether the one may be meant by the other
        };

        Similarity similarityOf(const std::string &name, const std::string &candidate)
        {
            // Cut to a reasonable length, because the table is quadratic.
            const std::string wanted = lowerCase(name.substr(0, 64)), lower = lowerCase(candidate);
            const std::size_t edits = editDistance(wanted, lower);
            // A part of a name, such as golf, is a better match than a name with two different letters.
            const bool isPart = wanted.size() > 2 && lower.find(wanted) != std::string::npos;
            return {isPart ? std::min<std::size_t>(2 * edits, 3) : 2 * edits, isPart || isNear(edits, wanted, lower)};
        }

        /** The names that are most similar, in quotes: "'a', 'b' or 'c'". */
        std::string nearestNames(const std::string &name, std::vector<std::string> known, const std::string &last)
        {
            std::stable_sort(known.begin(), known.end(),
                             [&name](const std::string &a, const std::string &b)
                             { return similarityOf(name, a).distance < similarityOf(name, b).distance; });
            std::string text;
            for (std::size_t i = 0; i < SUGGESTED; ++i)
                text += (i == 0 ? "" : i + 1 < SUGGESTED ? ", " : " " + last + " ") + inQuotes(known[i]);
            return text;
        }
    }  // namespace

    std::string lowerCase(std::string text)
    {
        for (char &c : text)
            c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return text;
    }

    std::string nearestName(const std::string &name, const std::vector<std::string> &known)
    {
        std::string best;
        std::size_t bestDistance = 0;
        for (const std::string &candidate : known)
            if (const Similarity found = similarityOf(name, candidate);
                found.isNear && (best.empty() || found.distance < bestDistance))
            {
                best = candidate;
                bestDistance = found.distance;
            }
        return best;
    }

    bool isMisspelt(const std::string &name, const std::vector<std::string> &known)
    {
        if (std::find(known.begin(), known.end(), name) != known.end())
            return false;
        const std::string wanted = lowerCase(name.substr(0, 64));
        return std::any_of(known.begin(), known.end(),
                           [&wanted](const std::string &candidate)
                           {
                               const std::string lower = lowerCase(candidate);
                               if (lower.size() < 6)
                                   return std::is_permutation(lower.begin(), lower.end(), wanted.begin(), wanted.end());
                               return editDistance(wanted, lower) <= 2;
                           });
    }

    std::string unknownName(const std::string &what, const std::string &name, const std::vector<std::string> &known)
    {
        std::string message = "unknown " + what + ' ' + inQuotes(name);
        if (known.empty())
            return message;
        const std::string nearest = nearestName(name, known);
        if (known.size() > LISTED)
            return message + (nearest.empty() ? "; the nearest of " + std::to_string(known.size()) + " are " +
                                                    nearestNames(name, known, "and")
                                              : "; did you mean " + nearestNames(name, known, "or") + "?");
        message += nearest.empty() ? "; known: " : "; did you mean '" + nearest + "'? Known: ";
        for (std::size_t i = 0; i < known.size(); ++i)
            message += (i ? ", " : "") + known[i];
        return message;
    }
}  // namespace parking
