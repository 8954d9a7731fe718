#include "parking_geometry/io/Yaml.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>

#include <yaml-cpp/eventhandler.h>

namespace parking
{
    namespace
    {
        /** The beginning of a document and whether it is empty. */
        class DocumentBegin : public YAML::EventHandler
        {
        public:
            std::optional<YAML::Mark> mark;
            bool isEmpty{true};

            void OnDocumentStart(const YAML::Mark &) override
            {
            }
            void OnDocumentEnd() override
            {
            }
            void OnNull(const YAML::Mark &at, YAML::anchor_t) override
            {
                note(at, true);
            }
            void OnAlias(const YAML::Mark &at, YAML::anchor_t) override
            {
                note(at, false);
            }
            void OnScalar(const YAML::Mark &at, const std::string &, YAML::anchor_t, const std::string &) override
            {
                note(at, false);
            }
            void OnSequenceStart(const YAML::Mark &at, const std::string &, YAML::anchor_t,
                                 YAML::EmitterStyle::value) override
            {
                note(at, false);
            }
            void OnSequenceEnd() override
            {
            }
            void OnMapStart(const YAML::Mark &at, const std::string &, YAML::anchor_t,
                            YAML::EmitterStyle::value) override
            {
                note(at, false);
            }
            void OnMapEnd() override
            {
            }

        private:
            void note(const YAML::Mark &at, bool isNothing)
            {
                if (mark)
                    return;
                mark = at;
                isEmpty = isNothing;
            }
        };

        /** Throws at the beginning of a second document, which YAML::Load() would ignore silently. An end mark with
            nothing behind it is accepted. */
        void refuseSecondDocument(const std::string &file, const std::string &text)
        {
            std::istringstream stream(text);
            YAML::Parser parser(stream);
            int before = -1;
            for (bool isFirst = true;; isFirst = false)
            {
                DocumentBegin document;
                if (!parser.HandleNextDocument(document) || !document.mark)
                    return;
                // After a comma behind the end, yaml-cpp finds an endless series of empty documents.
                const bool isStuck = document.isEmpty && document.mark->pos == before;
                if (!isFirst && (!document.isEmpty || isStuck))
                    throw Error(file + ':' + std::to_string(document.mark->line + 1) +
                                ": a second YAML document begins here; a file must hold one");
                before = document.mark->pos;
            }
        }

        YAML::Node parse(const std::string &file, const std::string &text)
        {
            try
            {
                const YAML::Node top = YAML::Load(text);
                refuseSecondDocument(file, text);
                return top;
            }
            catch (const YAML::Exception &error)
            {
                const std::string line = error.mark.is_null() ? "" : ':' + std::to_string(error.mark.line + 1);
                throw Error(file + line + ": is not valid YAML: " + oneLine(error.msg));
            }
        }

        bool known(const std::string &key, const std::vector<std::string> &names)
        {
            return std::find(names.begin(), names.end(), key) != names.end();
        }

        bool isNumber(const YAML::Node &node, double &value)
        {
            return node.IsScalar() && parseNumber(node.Scalar(), value);
        }

        std::string kindOf(const YAML::Node &node)
        {
            if (node.IsScalar())
                return inQuotes(node.Scalar());
            return node.IsMap() ? "a mapping" : node.IsSequence() ? "a list" : "nothing";
        }

        std::string noMapping(const std::string &what, const YAML::Node &node)
        {
            return what + " holds " + kindOf(node) + "; it must be a mapping with lines such as 'key: value'";
        }
    }  // namespace

    YamlMap::YamlMap(const std::string &file, const std::string &text) : file_(file), node_(parse(file, text))
    {
        check();
    }

    YamlMap::YamlMap(const std::string &file, const YAML::Node &node, const std::string &what)
      : file_(file),
        what_(what),
        node_(node)
    {
        check();
    }

    void YamlMap::check() const
    {
        if (!node_.IsMap())
            fail(node_, noMapping(what_.empty() ? "the file" : what_, node_));
        std::set<std::string> seen;
        for (const auto &entry : node_)
        {
            if (!entry.first.IsScalar())
                fail(entry.first, "a key is " + kindOf(entry.first) + "; keys must be plain words");
            if (!seen.insert(entry.first.Scalar()).second)
                fail(entry.first, "key " + inQuotes(entry.first.Scalar()) + " is given twice");
        }
    }

    void YamlMap::allowOnly(const std::vector<std::string> &names) const
    {
        for (const auto &entry : node_)
            if (!known(entry.first.Scalar(), names))
                fail(entry.first, unknownName(what_.empty() ? "key" : "key of " + what_, entry.first.Scalar(), names));
    }

    void YamlMap::refuseMisspelt(const std::vector<std::string> &names) const
    {
        for (const auto &entry : node_)
        {
            const std::string &key = entry.first.Scalar();
            if (!known(key, names) && isMisspelt(key, names))
                fail(entry.first, unknownName("key", key, names));
        }
    }

    std::vector<std::string> YamlMap::keys() const
    {
        std::vector<std::string> names;
        for (const auto &entry : node_)
            names.push_back(entry.first.Scalar());
        return names;
    }

    bool YamlMap::has(const std::string &key) const
    {
        return node_[key].IsDefined();
    }

    YAML::Node YamlMap::node(const std::string &key) const
    {
        const YAML::Node value = node_[key];
        if (!value.IsDefined())
            fail(node_, "key '" + key + "' is missing" + (what_.empty() ? "" : " in " + what_));
        return value;
    }

    YAML::Node YamlMap::list(const std::string &key, const std::string &right) const
    {
        const YAML::Node value = node(key);
        if (!value.IsSequence())
            fail(value, key + " is " + kindOf(value) + "; it must be " + right);
        return value;
    }

    std::string YamlMap::text(const std::string &key) const
    {
        return textOr(key, "a word");
    }

    std::string YamlMap::textOr(const std::string &key, const std::string &right) const
    {
        const YAML::Node value = node(key);
        if (!value.IsScalar() || value.Scalar().empty())
            fail(value, key + " is " + kindOf(value) + "; it must be " + right);
        return value.Scalar();
    }

    double YamlMap::number(const std::string &key) const
    {
        const YAML::Node value = node(key);
        double result = 0.0;
        if (!isNumber(value, result))
            fail(value, key + " is " + kindOf(value) + "; it must be a finite number");
        return result;
    }

    double YamlMap::numberOr(const std::string &key, double otherwise) const
    {
        return has(key) ? number(key) : otherwise;
    }

    bool YamlMap::flag(const std::string &key) const
    {
        const std::vector<std::string> yes = {"true", "True", "TRUE", "yes", "on", "1"};
        const std::vector<std::string> no = {"false", "False", "FALSE", "no", "off", "0"};
        const YAML::Node value = node(key);
        if (value.IsScalar() && known(value.Scalar(), yes))
            return true;
        if (value.IsScalar() && known(value.Scalar(), no))
            return false;
        fail(value, key + " is " + kindOf(value) + "; it must be true or false");
    }

    Pose YamlMap::pose(const std::string &key) const
    {
        const std::vector<double> values = numbers(node(key), 3, key);
        return {values[0], values[1], wrapAngle(values[2])};
    }

    YamlMap YamlMap::map(const std::string &key) const
    {
        const YAML::Node value = node(key);
        if (!value.IsMap())
            failAt(key, noMapping(key, value));
        return YamlMap(file_, value, key);
    }

    std::size_t YamlMap::choice(const std::string &key, const std::vector<std::string> &names) const
    {
        return choiceOf(key, text(key), names);
    }

    std::size_t YamlMap::choiceInAnyCase(const std::string &key, const std::vector<std::string> &names) const
    {
        return choiceOf(key, lowerCase(text(key)), names);
    }

    std::size_t YamlMap::choiceOf(const std::string &key, const std::string &value,
                                  const std::vector<std::string> &names) const
    {
        const auto found = std::find(names.begin(), names.end(), value);
        if (found == names.end())
            failAt(key, unknownName(key, value, names));
        return static_cast<std::size_t>(found - names.begin());
    }

    std::vector<double> YamlMap::numbers(const YAML::Node &sequence, std::size_t count, const std::string &what) const
    {
        const std::string right = "; it must be a list of " + std::to_string(count) + " numbers";
        if (!sequence.IsSequence())
            fail(sequence, what + " is " + kindOf(sequence) + right);
        if (sequence.size() != count)
            fail(sequence, what + " has " + std::to_string(sequence.size()) + " entries" + right);
        std::vector<double> values;
        for (const YAML::Node &entry : sequence)
        {
            values.push_back(0.0);
            if (!isNumber(entry, values.back()))
                fail(entry, what + " holds " + kindOf(entry) + right + ", all finite");
        }
        return values;
    }

    void YamlMap::fail(const YAML::Node &at, const std::string &message) const
    {
        throw Error(place(at) + ": " + message);
    }

    void YamlMap::failAt(const std::string &key, const std::string &message) const
    {
        fail(node_[key], message);
    }

    void YamlMap::failAtKey(const std::string &key, const std::string &message) const
    {
        for (const auto &entry : node_)
            if (entry.first.Scalar() == key)
                fail(entry.first, message);
        fail(node_, message);
    }

    std::string YamlMap::placeOf(const std::string &key) const
    {
        return place(node_[key]);
    }

    std::string YamlMap::place(const YAML::Node &at) const
    {
        if (!at.IsDefined())
            return file_;
        YAML::Mark mark = at.Mark();
        // yaml-cpp reports the position of the next node for a blank value.
        if (at.IsNull() && node_.IsMap())
            for (const auto &entry : node_)
                if (entry.second.is(at))
                    mark = entry.first.Mark();
        return mark.is_null() ? file_ : file_ + ':' + std::to_string(mark.line + 1);
    }
}  // namespace parking
