#include "parking_geometry/text/ReadFile.h"

#include "parking_geometry/Error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace parking
{
    std::string readFile(const std::string &file, std::size_t limit)
    {
        std::error_code ignored;
        if (std::filesystem::is_directory(file, ignored))
            throw Error(file + ": is a folder; a file is needed");
        // Some devices never end.
        if (std::filesystem::is_character_file(file, ignored) || std::filesystem::is_block_file(file, ignored))
            throw Error(file + ": is a device; a file is needed");
        const std::unique_ptr<std::FILE, int (*)(std::FILE *)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
        if (!stream)
            throw Error(file + ": cannot be opened: " + std::strerror(errno));

        std::string content;
        std::string piece(std::size_t(1) << 16, '\0');
        while (const std::size_t count = std::fread(piece.data(), 1, piece.size(), stream.get()))
        {
            if (count > limit - content.size())
                throw Error(file + ": is larger than the " + std::to_string(limit >> 20) + " MiB that are read");
            content.append(piece, 0, count);
        }
        if (std::ferror(stream.get()))
            throw Error(file + ": cannot be read: " + std::strerror(errno));
        if (content.empty())
            throw Error(file + ": is empty");
        return content;
    }
}  // namespace parking
