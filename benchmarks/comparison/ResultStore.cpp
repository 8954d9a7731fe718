#include "benchmarks/comparison/ResultStore.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

using nlohmann::json;

namespace parking
{
    namespace
    {
        constexpr std::size_t FILE_LIMIT = std::size_t(4) << 30;  // bytes
        constexpr int FORMAT = 2;  // of the lines; 1 kept figures as text under names with types

        bool hasContent(const std::string &file)
        {
            std::error_code ignored;
            return std::filesystem::exists(file, ignored) && std::filesystem::file_size(file, ignored) > 0;
        }
    }  // namespace

    std::pair<json, std::vector<RunRecord>> ResultStore::read(const std::string &file, std::size_t *end)
    {
        const std::string text = readFile(file, FILE_LIMIT);
        std::pair<json, std::vector<RunRecord>> result;
        std::size_t begin = 0, line = 0;
        while (begin < text.size())
        {
            const std::size_t newline = text.find('\n', begin);
            if (newline == std::string::npos)
                break;  // cut short
            const std::string_view content(text.data() + begin, newline - begin);
            ++line;
            try
            {
                const json parsed = json::parse(content);
                if (line == 1)
                {
                    if (parsed.at("parking_benchmark").get<int>() != FORMAT)
                        throw Error("written by another version");
                    result.first = parsed;
                }
                else
                    result.second.push_back(RunRecord::fromJson(parsed));
            }
            catch (const std::exception &error)
            {
                throw Error(file + ":" + std::to_string(line) + ": is not a line of benchmark results (" +
                            oneLine(error.what()) + ")");
            }
            begin = newline + 1;
        }
        if (line == 0)
            throw Error(file + ": is not a file of benchmark results");
        if (end != nullptr)
            *end = begin;
        return result;
    }

    ResultStore::ResultStore(std::string file, const json &header, bool fresh)
      : file_(std::move(file)),
        exists_(hasContent(file_)),
        descriptor_(open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666)),
        header_(header)
    {
        header_["parking_benchmark"] = FORMAT;
        std::size_t end = 0;
        if (descriptor_.value < 0)
            throw Error(file_ + ": cannot be written: " + std::strerror(errno));
        if (flock(descriptor_.value, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
            throw Error(file_ + ": another parking_benchmark is writing it at this moment");
        if (exists_ && !fresh)
        {
            auto [oldHeader, oldRecords] = read(file_, &end);
            if (oldHeader.value("fingerprint", "") != header_.value("fingerprint", ""))
                throw Error(file_ +
                            ": holds the runs of another comparison (configuration, scenarios or program differ); "
                            "choose another --output, or start over with --fresh");
            header_ = std::move(oldHeader);
            for (RunRecord &record : oldRecords)
            {
                index_[{record.experiment, record.planner, record.run}] = records_.size();
                records_.push_back(std::move(record));
            }
        }
        if (ftruncate(descriptor_.value, static_cast<off_t>(end)) != 0 || lseek(descriptor_.value, 0, SEEK_END) < 0)
            throw Error(file_ + ": cannot be written: " + std::strerror(errno));
        if (end == 0)
            writeLine(header_.dump());
    }

    ResultStore::Descriptor::~Descriptor()
    {
        if (value >= 0)
            close(value);
    }

    bool ResultStore::has(const std::string &experiment, const std::string &planner, std::size_t run) const
    {
        return index_.count({experiment, planner, run}) > 0;
    }

    void ResultStore::add(RunRecord record)
    {
        writeLine(record.toJson().dump());
        index_[{record.experiment, record.planner, record.run}] = records_.size();
        records_.push_back(std::move(record));
    }

    void ResultStore::writeLine(const std::string &line)
    {
        const std::string text = line + "\n";
        const off_t before = lseek(descriptor_.value, 0, SEEK_CUR);
        std::size_t written = 0;
        while (written < text.size())
        {
            const ssize_t count = write(descriptor_.value, text.data() + written, text.size() - written);
            if (count >= 0)
            {
                written += static_cast<std::size_t>(count);
                continue;
            }
            if (errno == EINTR)
                continue;
            const std::string cause = std::strerror(errno);
            // A line cut short would be ignored by readers; better not to leave one.
            if (ftruncate(descriptor_.value, before) == 0)
                lseek(descriptor_.value, before, SEEK_SET);
            throw Error(file_ + ": cannot be written: " + cause);
        }
    }
}  // namespace parking
