#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace parking_test
{
    /** A folder of its own that is gone at the end of the test. */
    class TemporaryFolder
    {
    public:
        TemporaryFolder()
        {
            std::string name = (std::filesystem::temp_directory_path() / "parking_test_XXXXXX").string();
            if (!::mkdtemp(name.data()))
                throw std::runtime_error("cannot make a temporary folder");
            path_ = name;
        }
        ~TemporaryFolder()
        {
            std::error_code ignored;
            std::filesystem::remove_all(path_, ignored);
        }
        TemporaryFolder(const TemporaryFolder &) = delete;
        TemporaryFolder &operator=(const TemporaryFolder &) = delete;

        std::string path(const std::string &name) const
        {
            return (path_ / name).string();
        }

        /** Writes a file and returns its path. */
        std::string write(const std::string &name, const std::string &content) const
        {
            std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
            std::ofstream stream(path(name), std::ios::binary | std::ios::trunc);
            stream.write(content.data(), static_cast<std::streamsize>(content.size()));
            if (!stream.flush())
                throw std::runtime_error("cannot write " + path(name));
            return path(name);
        }

        /** Names of all that is in the folder, sorted, one per line. */
        std::string listing() const
        {
            std::string names;
            for (const auto &entry : std::filesystem::directory_iterator(path_))
                names += entry.path().filename().string() + '\n';
            return names;
        }

    private:
        std::filesystem::path path_;
    };

    inline std::string contentOf(const std::string &file)
    {
        std::ifstream stream(file, std::ios::binary);
        std::ostringstream text;
        text << stream.rdbuf();
        return text.str();
    }
}  // namespace parking_test
