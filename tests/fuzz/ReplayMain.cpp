// Instead of libFuzzer where that is not installed: tries the files that are named, and all that are in folders named,
// once.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

int main(int argc, char **argv)
{
    namespace fs = std::filesystem;
    std::vector<fs::path> files;
    for (const std::string &argument : std::vector<std::string>(argv + 1, argv + argc))
        if (argument.rfind("-", 0) == 0)
            continue;  // libFuzzer's
        else if (fs::is_directory(argument))
            std::copy(fs::directory_iterator(argument), fs::directory_iterator(), std::back_inserter(files));
        else
            files.emplace_back(argument);
    std::sort(files.begin(), files.end());
    for (const fs::path &file : files)
    {
        std::ifstream stream(file, std::ios::binary);
        const std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
        if (!stream)
        {
            std::fprintf(stderr, "%s: cannot be read\n", file.c_str());
            return 2;
        }
        std::fprintf(stderr, "%s\n", file.filename().c_str());
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t *>(content.data()), content.size());
    }
    return 0;
}
