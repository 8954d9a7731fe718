#include "parking_geometry/text/WriteFile.h"

#include "parking_geometry/text/ReadFile.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;
namespace fs = std::filesystem;

namespace
{
    /** Files of this process may not grow above \e bytes while this lives: a full disk, as far as a writer sees. */
    class FullDisk
    {
    public:
        explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN))
        {
            getrlimit(RLIMIT_FSIZE, &before_);
            const rlimit limit{bytes, before_.rlim_max};
            setrlimit(RLIMIT_FSIZE, &limit);
        }
        ~FullDisk()
        {
            setrlimit(RLIMIT_FSIZE, &before_);
            std::signal(SIGXFSZ, handler_);
        }
        FullDisk(const FullDisk &) = delete;
        FullDisk &operator=(const FullDisk &) = delete;

    private:
        void (*handler_)(int);
        rlimit before_{};
    };
}  // namespace

TEST(WriteFile, WritesAndReplaces)
{
    const TemporaryFolder folder;
    const std::string file = folder.path("a.txt");
    const std::string binary("\0\n\r\xFF", 4);
    for (const std::string &content : {std::string("first"), std::string(), binary, std::string(3000000, 'x')})
    {
        writeFileAtomically(file, content);
        EXPECT_EQ(contentOf(file), content);
        EXPECT_EQ(folder.listing(), "a.txt\n");
    }
}

TEST(WriteFile, GivesTheUsualPermissionsAndKeepsThoseOfTheOldFile)
{
    const TemporaryFolder folder;
    const mode_t mask = ::umask(022);
    writeFileAtomically(folder.path("new"), "x");
    const std::string old = folder.write("old", "x");
    ::chmod(old.c_str(), 0600);
    writeFileAtomically(old, "y");
    ::umask(mask);
    EXPECT_EQ(fs::status(folder.path("new")).permissions(), fs::perms(0644));
    EXPECT_EQ(fs::status(old).permissions(), fs::perms(0600));
}

TEST(WriteFile, FollowsLinks)
{
    const TemporaryFolder folder;
    const std::string target = folder.write("target", "old");
    fs::create_symlink("target", folder.path("link"));
    writeFileAtomically(folder.path("link"), "new");
    EXPECT_TRUE(fs::is_symlink(folder.path("link")));
    EXPECT_EQ(contentOf(target), "new");
    fs::create_symlink("later", folder.path("dangling"));
    writeFileAtomically(folder.path("dangling"), "made");
    EXPECT_EQ(contentOf(folder.path("later")), "made");
    fs::create_symlink("ring", folder.path("ring"));
    expectError([&] { writeFileAtomically(folder.path("ring"), "x"); }, {"ring", "cannot be written"});
    EXPECT_TRUE(fs::is_symlink(folder.path("ring")));
}

TEST(WriteFile, WritesToWhatIsNoOrdinaryFile)
{
    EXPECT_NO_THROW(writeFileAtomically("/dev/null", "gone"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    if (fs::exists("/dev/full"))
        expectError([] { writeFileAtomically("/dev/full", "x"); }, {"/dev/full", "No space left"});
}

TEST(WriteFile, DisksAreNotWrittenOver)
{
    const TemporaryFolder folder;
    // Of a driver that does not exist: to open it is an error anyway.
    if (::mknod(folder.path("disk").c_str(), S_IFBLK | 0600, makedev(4095, 255)) != 0)
        GTEST_SKIP() << "only root may make a device";
    expectError([&] { writeFileAtomically(folder.path("disk"), "x"); },
                {"disk", "is a disk, whose content would be lost"});
    EXPECT_TRUE(fs::is_block_file(folder.path("disk")));
}

TEST(WriteFile, NamesTheCause)
{
    const TemporaryFolder folder;
    expectError([&] { writeFileAtomically(folder.path("no/such/file"), "x"); },
                {"no/such/file", "no folder", "no/such"});
    expectError([&] { writeFileAtomically(folder.path(""), "x"); }, {"is a folder"});
    expectError([] { writeFileAtomically("", "x"); }, {"no name"});
    expectError([&] { writeFileAtomically(folder.path(std::string(300, 'n')), "x"); }, {"cannot be written"});
    folder.write("file", "x");
    expectError([&] { writeFileAtomically(folder.path("file/below"), "x"); }, {"no folder"});
    EXPECT_EQ(folder.listing(), "file\n");
}

TEST(WriteFile, NeedsPermission)
{
    if (::geteuid() == 0)
        GTEST_SKIP() << "root may write everywhere";
    const TemporaryFolder folder;
    fs::create_directory(folder.path("locked"));
    fs::permissions(folder.path("locked"), fs::perms::owner_read | fs::perms::owner_exec);
    expectError([&] { writeFileAtomically(folder.path("locked/file"), "x"); }, {"locked/file", "Permission denied"});
    fs::permissions(folder.path("locked"), fs::perms::owner_all);
}

TEST(WriteFile, AFullDiskLeavesTheOldFileAndNoRemains)
{
    const TemporaryFolder folder;
    const std::string file = folder.write("result", "old");
    {
        const FullDisk full(100000);
        EXPECT_NO_THROW(writeFileAtomically(folder.path("small"), std::string(100000, 'x')));
        expectError([&] { writeFileAtomically(file, std::string(100001, 'x')); }, {"result", "cannot be written"});
    }
    EXPECT_EQ(contentOf(file), "old");
    EXPECT_EQ(fs::file_size(folder.path("small")), 100000u);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path("")), fs::directory_iterator()), 2);
}

TEST(ReadFile, ReadsUpToItsLimit)
{
    const TemporaryFolder folder;
    const std::string text(1 << 20, 'z');
    const std::string file = folder.write("big", text);
    EXPECT_EQ(readFile(file, text.size()), text);
    expectError([&] { readFile(file, text.size() - 1); }, {"big", "larger"});
}

TEST(ReadFile, ReadsAPipeToItsEnd)
{
    const TemporaryFolder folder;
    const std::string pipe = folder.path("pipe");
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const std::string text(1 << 20, 'z');  // more than a pipe holds
    const auto before = std::signal(SIGPIPE, SIG_IGN);
    for (const std::size_t limit : {text.size(), text.size() - 1})
    {
        std::thread writer(
            [&]
            {
                std::ofstream(pipe) << text;  // without those that are not read
            });
        if (limit == text.size())
            EXPECT_EQ(readFile(pipe, limit), text);
        else
            expectError([&] { readFile(pipe, limit); }, {"pipe", "larger"});
        writer.join();
    }
    std::signal(SIGPIPE, before);
}
