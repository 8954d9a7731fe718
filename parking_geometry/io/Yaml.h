#pragma once

#include "parking_geometry/Pose.h"

#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace parking
{
    /** \brief A YAML mapping with strict validation. Every error names the file, the line and the key.

        Duplicate keys, values of the wrong type and numbers that are not finite are errors, and so are unknown keys
        after allowOnly(). */
    class YamlMap
    {
    public:
        /** \brief Parses the text of a file. Throws parking::Error unless it is YAML with a single document that is a
            mapping. */
        YamlMap(const std::string &file, const std::string &text);

        /** \brief Views \e node of a document. \param what name in messages, for example "slot" */
        YamlMap(const std::string &file, const YAML::Node &node, const std::string &what);

        /** \brief Throws parking::Error for the first key that is not in \e known, naming the nearest known key. */
        void allowOnly(const std::vector<std::string> &known) const;

        /** \brief Throws parking::Error for the first key that differs from a known one by one or two letters.

            This check is for files of other programs, which may contain further keys. */
        void refuseMisspelt(const std::vector<std::string> &known) const;

        /** \brief All keys in the order of the file. */
        std::vector<std::string> keys() const;

        /** \brief Whether the key is present, with any value. */
        bool has(const std::string &key) const;

        /** \name Values
            Each of these throws parking::Error if the key is missing or its value has the wrong type.
            @{ */
        YAML::Node node(const std::string &key) const;   ///< value of any type
        std::string text(const std::string &key) const;  ///< text that is not empty
        double number(const std::string &key) const;     ///< finite number
        bool flag(const std::string &key) const;         ///< one of true, yes, on, 1, false, no, off, 0
        Pose pose(const std::string &key) const;         ///< pose from a list x, y, yaw; its yaw is wrapped
        YamlMap map(const std::string &key) const;       ///< mapping, named like the key in messages
        /** @} */

        /** \brief text() of a key that also allows other values. \param right all valid values, for "it must be ..." in
            messages */
        std::string textOr(const std::string &key, const std::string &right) const;

        /** \brief A sequence, which may be empty. \param right valid values, for "it must be ..." in messages */
        YAML::Node list(const std::string &key, const std::string &right) const;

        /** \brief number(), or \e otherwise if the key is missing. */
        double numberOr(const std::string &key, double otherwise) const;

        /** \brief Index in \e names of the value, which must be one of them. */
        std::size_t choice(const std::string &key, const std::vector<std::string> &names) const;

        /** \brief choice() that ignores case; \e names are in lower case. */
        std::size_t choiceInAnyCase(const std::string &key, const std::vector<std::string> &names) const;

        /** \brief The numbers of a sequence of exactly \e count elements. \param what name of the sequence in
            messages */
        std::vector<double> numbers(const YAML::Node &sequence, std::size_t count, const std::string &what) const;

        /** \brief Throws parking::Error with the file, the line of \e at and \e message. For a blank value the message
            names the line of its key. */
        [[noreturn]] void fail(const YAML::Node &at, const std::string &message) const;

        /** \brief Throws parking::Error with the file, the line of the value of \e key and \e message. For a blank
            value the message names the line of the key. */
        [[noreturn]] void failAt(const std::string &key, const std::string &message) const;

        /** \brief Throws parking::Error with the file, the line of the key itself and \e message. */
        [[noreturn]] void failAtKey(const std::string &key, const std::string &message) const;

        /** \brief The file and the line of \e at for messages, for example "lot.yaml:12". */
        std::string place(const YAML::Node &at) const;

        /** \brief The file and the line of the value of \e key for messages, for example "lot.yaml:12". */
        std::string placeOf(const std::string &key) const;

        /** \brief Name of the file in messages. */
        const std::string &file() const
        {
            return file_;
        }

    private:
        void check() const;
        std::size_t choiceOf(const std::string &key, const std::string &value,
                             const std::vector<std::string> &names) const;

        std::string file_;
        std::string what_;
        YAML::Node node_;
    };
}  // namespace parking
