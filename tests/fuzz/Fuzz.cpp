#include "tests/fuzz/Fuzz.h"

#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <limits>

namespace parking_test::fuzz
{
    namespace
    {
        // libFuzzer looks at these like at counters of the compiler.
        __attribute__((used, section("__libfuzzer_extra_counters"))) std::array<std::uint8_t, 4096> counters;

        /** Gone when the process ends, but for one that crashes. */
        class Folder
        {
        public:
            Folder()
            {
                std::error_code error;
                const char *parent = std::filesystem::is_directory("/dev/shm", error) ? "/dev/shm" : "/tmp";
                name_ = std::string(parent) + "/parking_fuzz_XXXXXX";
                if (mkdtemp(name_.data()) == nullptr)
                    fail("there can be no temporary folder");
            }
            ~Folder()
            {
                std::error_code ignored;
                std::filesystem::remove_all(name_, ignored);
            }
            const std::string &name() const
            {
                return name_;
            }

        private:
            std::string name_;
        };
    }  // namespace

    void fail(const std::string &finding)
    {
        std::fprintf(stderr, "FOUND: %s\n", finding.c_str());
        std::abort();
    }

    void reached(const std::string &what)
    {
        // FNV-1a
        std::uint64_t hash = 14695981039346656037ULL;
        for (const char letter : what)
            hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
        counters[hash % counters.size()] = 1;
    }

    void checkMessage(const std::string &file, const std::string &message)
    {
        if (message.empty() || message.find('\n') != std::string::npos)
            fail("the error is not one line: '" + message + "'");
        if (!file.empty() && message.find(file) == std::string::npos)
            fail("the error does not name the file: '" + message + "'");
        // Errors that differ in numbers, quoted words and the folder, which is another one each time, count as one.
        const std::string folder = std::filesystem::path(file).parent_path().string();
        std::string told = message, kind;
        for (std::size_t at = 0; !folder.empty() && (at = told.find(folder, at)) != std::string::npos;)
            told.erase(at, folder.size());
        bool quoted = false;
        for (const char letter : told)
            if (letter == '\'')
                quoted = !quoted;
            else if (!quoted && std::isalpha(static_cast<unsigned char>(letter)) != 0)
                kind += letter;
        reached(kind);
    }

    std::string writeInput(const std::string &name, const std::string &content)
    {
        static const Folder folder;
        const std::string path = folder.name() + "/" + name;
        std::FILE *file = std::fopen(path.c_str(), "wb");
        if (file == nullptr || std::fwrite(content.data(), 1, content.size(), file) != content.size() ||
            std::fclose(file) != 0)
            fail("cannot write " + path);
        return path;
    }

    std::uint8_t Numbers::byte()
    {
        return atEnd() ? 0 : static_cast<std::uint8_t>(input_[next_++]);
    }

    double Numbers::between(double low, double high)
    {
        const unsigned int first = byte();  // which of two calls in one expression comes first, the compiler chooses
        const unsigned int number = 256U * first + byte();
        return low + (high - low) * number / 65535.0;
    }

    double Numbers::anything()
    {
        switch (below(8))
        {
            case 0:
                return std::numeric_limits<double>::quiet_NaN();
            case 1:
                return std::numeric_limits<double>::infinity();
            case 2:
            {
                std::array<std::uint8_t, sizeof(double)> bytes{};
                for (std::uint8_t &each : bytes)
                    each = byte();
                double value = 0.0;
                std::memcpy(&value, bytes.data(), sizeof value);
                return value;
            }
            case 3:
                return between(-1e5, 1e5);
            default:
                return between(-30.0, 30.0);
        }
    }
}  // namespace parking_test::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    // Of the processor: on a busy machine the clock on the wall says nothing. libFuzzer's own limit is there for what
    // hangs.
    constexpr double MOST_SECONDS = 2.0;
    const std::clock_t begin = std::clock();
    parking_test::fuzz::tryInput(std::string(reinterpret_cast<const char *>(data), size));
    const double took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    if (took > MOST_SECONDS)
        parking_test::fuzz::fail("an input that takes " + std::to_string(took) + " s");
    return 0;
}
