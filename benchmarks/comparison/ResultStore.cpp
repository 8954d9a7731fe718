#include "benchmarks/comparison/ResultStore.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <unistd.h>

namespace fs = std::filesystem;
using nlohmann::json;

namespace parking
{
    namespace
    {
        constexpr std::size_t FILE_LIMIT = std::size_t(4) << 30;  // bytes
        constexpr int FORMAT = 2;                      // of the lines; 1 kept figures as text under names with types
        const char *const MARK = "parking_benchmark";  // the member that tells a header from a run

        /** Of another version; the whole file is, then. */
        class VersionError : public Error
        {
        public:
            using Error::Error;
        };

        bool hasContent(const std::string &file)
        {
            std::error_code ignored;
            return fs::is_regular_file(file, ignored) && fs::file_size(file, ignored) > 0;
        }

        bool hasLine(const std::string &file)
        {
            return hasContent(file) && readFile(file, FILE_LIMIT).find('\n') != std::string::npos;
        }

        /** Whatever is read from a header later is there and of its type from here on. */
        json checkedHeader(json header)
        {
            if (header.at(MARK) != FORMAT)
                throw VersionError("written by another version");
            for (const char *name : {"fingerprint", "config", "host", "cpu", "machine"})
                header[name] = header.value(name, "");
            header["started"] = header.value("started", 0.0);
            using Texts = std::map<std::string, std::string>;
            for (const char *name : {"setups", "parameters"})
                header[name] = header.value(name, Texts());
            header["fingerprints"] = header.value("fingerprints", std::map<std::string, Texts>());
            return header;
        }

        /** Machine and date are those of the beginning. */
        json continued(const json &first, json next)
        {
            for (const char *name : {"host", "cpu", "machine", "parameters", "started"})
                next[name] = first.at(name);
            for (const auto &[experiment, text] : first.at("setups").items())
                next["setups"].emplace(experiment, text);
            return next;
        }

        std::string lineOf(const json &content)
        {
            // Planners from elsewhere may name things in any encoding.
            return content.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
        }

        /** A name that is not taken yet, which a hard link finds out without a moment in which another could take it.
         */
        std::string linkAside(const std::string &file)
        {
            const fs::path path(file);
            const std::string base = (path.parent_path() / ("previous-" + path.stem().string())).string();
            for (int number = 1;; ++number)
            {
                const std::string name =
                    base + (number > 1 ? "-" + std::to_string(number) : "") + path.extension().string();
                std::error_code error;
                // Somebody was killed between giving the second name and taking the first one away.
                if (fs::equivalent(file, name, error))
                    return name;
                if (link(file.c_str(), name.c_str()) == 0)
                    return name;
                if (errno == EEXIST)
                    continue;
                // Where there are no hard links a copy does.
                if (!fs::copy_file(file, name, error) && error != std::errc::file_exists)
                    throw Error(file + ": cannot be set aside as " + name + ": " + error.message());
                if (!error)
                    return name;
            }
        }
    }  // namespace

    StoredResults ResultStore::read(const std::string &file)
    {
        const std::string text = readFile(file, FILE_LIMIT);
        StoredResults result;
        std::size_t line = 0, damaged = 0;
        for (std::size_t newline = 0; (newline = text.find('\n', result.end)) != std::string::npos;)
        {
            const std::string_view content(text.data() + result.end, newline - result.end);
            result.end = newline + 1;
            ++line;
            try
            {
                const json parsed = json::parse(content);
                if (!parsed.contains(MARK))
                    result.records.push_back(RunRecord::fromJson(parsed));
                else
                {
                    json header = checkedHeader(parsed);
                    result.header = result.hasHeader ? continued(result.header, std::move(header)) : std::move(header);
                    result.hasHeader = true;
                }
            }
            catch (const std::exception &error)
            {
                const std::string why = file + ":" + std::to_string(line) + ": is not a line of benchmark results (" +
                                        oneLine(error.what()) + ")";
                if (dynamic_cast<const VersionError *>(&error) != nullptr)
                    throw Error(why);
                if (++damaged == 1)
                    result.damage = why;
            }
        }
        if (!result.hasHeader && result.records.empty())
            throw Error(damaged > 0 ? result.damage : file + ": is not a file of benchmark results");
        if (damaged > 0)
        {
            result.damage +=
                damaged > 1 ? "; it and " + std::to_string(damaged - 1) + " more are left out" : "; it is left out";
        }
        if (!result.hasHeader)
            result.header = checkedHeader({{MARK, FORMAT}});
        return result;
    }

    ResultStore::ResultStore(const std::string &file, const json &header, bool fresh) : file_(file), header_(header)
    {
        header_[MARK] = FORMAT;
        header_ = checkedHeader(std::move(header_));
        std::error_code ignored;
        fs::remove(file + ".new", ignored);  // of somebody who was killed; it is ours as long as the file is
        std::optional<StoredResults> stored;
        try
        {
            if (hasContent(file))
                stored = read(file);
        }
        catch (const Error &)
        {
            // Something else makes room, too.
        }
        if (!fresh && stored && goOn(*stored))
            return;
        // Of somebody who was killed before the first run there is nothing to keep.
        const bool blank = stored ? stored->records.empty() && stored->damage.empty() : !hasLine(file);
        beginAnew(!blank);
    }

    bool ResultStore::isOfUse(const RunRecord &record) const
    {
        const json &wanted = header_.at("fingerprints");
        const auto experiment = wanted.find(record.experiment);
        if (experiment == wanted.end())
            return false;
        const auto planner = experiment->find(record.planner);
        return planner != experiment->end() && *planner == record.fingerprint;
    }

    bool ResultStore::goOn(StoredResults &stored)
    {
        for (RunRecord &record : stored.records)
            if (isOfUse(record) && known_.insert({record.experiment, record.planner, record.run}).second)
                records_.push_back(std::move(record));
        if (records_.empty())
            return false;
        damage_ = std::move(stored.damage);
        file_.cutTo(stored.end);
        const json header = stored.hasHeader ? continued(stored.header, header_) : header_;
        if (!stored.hasHeader || header != stored.header)
            file_.append(lineOf(header));
        header_ = header;
        return true;
    }

    void ResultStore::beginAnew(bool keep)
    {
        if (!keep)
        {
            file_.cutTo(0);
            file_.append(lineOf(header_));
            return;
        }
        const std::string name = file_.name();
        setAside_ = linkAside(name);
        // Locked before it has the name, so that there is no moment in which another could take it.
        LockedFile fresh(name + ".new");
        fresh.cutTo(0);
        fresh.append(lineOf(header_));
        fresh.rename(name);
        file_ = std::move(fresh);
    }

    bool ResultStore::has(const std::string &experiment, const std::string &planner, std::size_t run) const
    {
        return known_.count({experiment, planner, run}) > 0;
    }

    void ResultStore::add(RunRecord record)
    {
        record.fingerprint =
            header_.at("fingerprints").value(record.experiment, json::object()).value(record.planner, "");
        file_.append(lineOf(record.toJson()));
        known_.insert({record.experiment, record.planner, record.run});
        records_.push_back(std::move(record));
    }
}  // namespace parking
