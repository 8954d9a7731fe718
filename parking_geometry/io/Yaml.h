#pragma once

#include "parking_geometry/Pose.h"

#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace parking
{
    /** \brief A YAML mapping read strictly: every error names the file, the line and the key.

        Unknown keys, keys given twice and values of another kind than required are errors; numbers are
        finite. */
    class YamlMap
    {
    public:
        /** \brief Parses a file's text. Throws when it is no YAML, holds more than one document or its top is not a
            mapping. */
        YamlMap(const std::string &file, const std::string &text);

        /** \brief Views \e node. \param what how messages call it, for example "slot" */
        YamlMap(const std::string &file, const YAML::Node &node, const std::string &what);

        /** \brief Throws for the first key that is not in \e known, naming the nearest one. */
        void allowOnly(const std::vector<std::string> &known) const;

        /** \brief Throws for the first key that is not in \e known but is a letter or two away from one of them: for
            files of other programs, where more keys may stand than are read here. */
        void refuseMisspelt(const std::vector<std::string> &known) const;

        /** \brief Is the key there, whatever its value? */
        bool has(const std::string &key) const;

        /** \name Values
            Each of these throws parking::Error when the key is missing, and when its value is not of the kind.
            @{ */
        YAML::Node node(const std::string &key) const;   ///< of any kind
        std::string text(const std::string &key) const;  ///< a word or text, not empty
        double number(const std::string &key) const;     ///< finite
        bool flag(const std::string &key) const;         ///< true, yes, on, 1; false, no, off, 0
        Pose pose(const std::string &key) const;         ///< a list x, y, yaw; the yaw is wrapped
        YamlMap map(const std::string &key) const;       ///< called key in messages
        /** @} */

        /** \brief text() of a key that may have other values, too: \e right says which, after "it must be". */
        std::string textOr(const std::string &key, const std::string &right) const;

        /** \brief A sequence, maybe of nothing. \param right what it must be, as for textOr() */
        YAML::Node list(const std::string &key, const std::string &right) const;

        /** \brief number(), or \e otherwise when the key is missing. */
        double numberOr(const std::string &key, double otherwise) const;

        /** \brief One of \e names, as its position among them. */
        std::size_t choice(const std::string &key, const std::vector<std::string> &names) const;

        /** \brief The numbers of a sequence of exactly \e count. \param what how messages call it */
        std::vector<double> numbers(const YAML::Node &sequence, std::size_t count, const std::string &what) const;

        /** \brief Throws parking::Error with the file, the line of \e at and \e message. A value that was left blank
            has no line; its key's is named. */
        [[noreturn]] void fail(const YAML::Node &at, const std::string &message) const;

        /** \brief The same for the line on which the value of \e key stands, or the key when it has none. */
        [[noreturn]] void failAt(const std::string &key, const std::string &message) const;

        /** \brief The file and the line of \e at, for messages: "lot.yaml:12". */
        std::string place(const YAML::Node &at) const;

        /** \brief The same of the value of \e key. */
        std::string placeOf(const std::string &key) const;

        /** \brief The file that messages name. */
        const std::string &file() const
        {
            return file_;
        }

    private:
        void check() const;

        std::string file_;
        std::string what_;
        YAML::Node node_;
    };
}  // namespace parking
