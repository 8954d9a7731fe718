#include "parking_geometry/io/ScenarioReader.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"
#include "tests/parking_geometry/io/TestImages.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    const std::string THRESHOLDS = "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

    class MapReader : public testing::Test
    {
    protected:
        /** Reads an image with a YAML file of its own; \e more are further lines of it. */
        OccupancyGrid read(const std::string &image, const std::string &more = "",
                           std::vector<std::string> *warnings = nullptr)
        {
            folder_.write("map.img", image);
            std::string text = "image: map.img\nresolution: 0.1\norigin: [0, 0, 0]\n" + more;
            if (more.find("free_thresh") == std::string::npos)
                text += "free_thresh: 0.196\n";
            if (more.find("occupied_thresh") == std::string::npos)
                text += "occupied_thresh: 0.65\n";
            return readRosMap(folder_.write("map.yaml", text), nullptr, warnings);
        }

        /** The cells as letters, top row first, as one sees the image. */
        std::string cells(const std::string &image, const std::string &more = "")
        {
            const OccupancyGrid grid = read(image, more);
            std::string text;
            for (std::size_t row = grid.height(); row-- > 0;)
            {
                for (std::size_t column = 0; column < grid.width(); ++column)
                    text += ".#?"[static_cast<std::size_t>(grid.at(column, row))];
                text += row ? "/" : "";
            }
            return text;
        }

        void expectImageError(const std::string &image, std::vector<std::string> parts)
        {
            parts.emplace_back("map.img: ");
            expectError([&] { read(image); }, parts);
        }
        void expectYamlError(const std::string &text, const std::vector<std::string> &parts)
        {
            SCOPED_TRACE(text);
            folder_.write("map.img", "P2 2 1 1 0 1");
            expectError([&] { readRosMap(folder_.write("map.yaml", text)); }, parts);
        }

        TemporaryFolder folder_;
    };

    std::string raw(const std::string &header, const std::vector<int> &bytes)
    {
        std::string text = header;
        for (const int byte : bytes)
            text += static_cast<char>(byte);
        return text;
    }

    std::string greyPng(png_uint_32 width, png_uint_32 height, const std::vector<std::uint8_t> &samples)
    {
        return encodePng(width, height, PNG_FORMAT_GRAY, samples);
    }

    std::string fromHex(const std::string &text)
    {
        std::string bytes;
        for (std::size_t i = 0; i < text.size(); i += 2)
            bytes += static_cast<char>(std::stoi(text.substr(i, 2), nullptr, 16));
        return bytes;
    }

    /** 5 x 2 pixels of 2 bits, interlaced, of a palette of black, white that is transparent, 205 and 254. */
    const std::string PALETTE_PNG = fromHex(
        "89504e470d0a1a0a0000000d49484452000000050000000202030000019a03ce580000000c504c5445000000ffffffcdcdcdfefefe"
        "9f6f2d220000000274524e53ff00e5b7304a000000114944415478da6360008206860286270c00069301d5302d0f960000000049"
        "454e44ae426082");
}  // namespace

TEST_F(MapReader, ReadsImagesAsMapServersDo)
{
    struct Image
    {
        std::string image, more, cells;
    };
    const std::string dark = "P2 4 1 255  255 0 50 49", modes = "P2 5 1 255  255 205 0 100 10";
    const Image images[] = {
        {"P2\n3 2\n255\n254 205 0\n0 254 254\n", "", ".?#/#.."},
        {raw("P5\n3 2\n255\n", {254, 205, 0, 0, 254, 254}), "", ".?#/#.."},
        // Comments. The first blank after the largest value ends the header: what follows is pixels.
        {"P2 # CREATOR: x\n# 9 9\n2 1 # size\n255#most\n254 # a pixel\n0\n# end", "", ".#"},
        {raw("P5 # comment\r\n#another\n2 1\n# third\n255\n", {254, 0}), "", ".#"},
        {raw("P5 3 1 255\n", {'#', ' ', '\n'}), "", "###"},
        // The largest value is white; two bytes a pixel have the high one first.
        {"P2 4 1 1  1 0 0 1", "", ".##."},
        {"P2 4 1 100  100 81 80 35", "", "..??"},
        {"P2 2 1 65535  65535 0", "", ".#"},
        {raw("P5 3 1 65535\n", {0xFF, 0xFF, 0xD0, 0x00, 0x00, 0xFF}), "", "..#"},
        {raw("P5 3 1 256\n", {0x01, 0x00, 0x00, 0xFF, 0x00, 0x00}), "", "..#"},
        // Occupied only above the upper, free only below the lower threshold; 205 is map_saver's grey for unknown.
        {"P2 4 1 100  34 35 80 81", "occupied_thresh: 0.65\nfree_thresh: 0.2\n", "#??."},
        {"P2 2 1 255  204 205", "free_thresh: 0.2\n", "?."},
        {"P2 4 1 255  205 206 90 89", "", "?.?#"},
        {"P2 3 1 255  0 128 255", "occupied_thresh: 0.5\nfree_thresh: 0.5\n", "#.."},
        {"P2 3 1 255  0 128 255", "occupied_thresh: 1\nfree_thresh: 0\n", "???"},
        {dark, "negate: 1\n", "#.?."},
        {dark, "negate: true\n", "#.?."},
        {dark, "negate: 0\n", ".###"},
        {dark, "negate: no\n", ".###"},
        // raw: the pixel is the percentage itself, and more than 100 says unknown.
        {modes, "mode: trinary\n", ".?#?#"},
        {modes, "mode: scale\n", ".?#?#"},
        {"P2 6 1 255  255 101 100 66 65 10", "mode: raw\n", "??##?."},
        // It is that whatever negate says, as for nav2.
        {"P2 5 1 255  255 101 100 10 0", "mode: raw\nnegate: 1\n", "??#.."},
        {"P2 3 1 255  255 205 0", "mode: Trinary\n", ".?#"},
        {"P2 2 1 255  10 205", "mode: RAW\n", ".?"},
        // Headers with Windows' line ends, and a pixel that looks like the second half of one.
        {raw("P5\r\n# a\r\n3 1\r\n255\r\n", {254, 205, 0}), "", ".?#"},
        {raw("P5\r\n3 1\r\n255\r\n", {10, 254, 0, '\n'}), "", "#.#"},
        {raw("P5\r\n2 1\r\n65535\r\n", {0xFF, 0xFF, 0x00, 0x00}), "", ".#"},
        {raw("P5 3 1 255\r", {'\n', 254, 0}), "", "#.#"},
    };
    for (const Image &each : images)
        EXPECT_EQ(cells(each.image, each.more), each.cells) << each.image << ' ' << each.more;
    const OccupancyGrid grid = read("P2 2 2 1  1 0  1 1");
    EXPECT_EQ(grid.at(1, 1), Cell::Occupied);  // the upper right pixel
    EXPECT_EQ(grid.at(1, 0), Cell::Free);
    EXPECT_DOUBLE_EQ(grid.resolution(), 0.1);
}

TEST_F(MapReader, OriginKeepsItsYaw)
{
    folder_.write("map.img", "P2 2 1 1 0 1");
    const OccupancyGrid grid =
        readRosMap(folder_.write("map.yaml", "image: map.img\nresolution: 2\norigin: [3, -4, 7]\n" + THRESHOLDS));
    EXPECT_EQ(grid.origin().x, 3.0);
    EXPECT_EQ(grid.origin().y, -4.0);
    EXPECT_NEAR(grid.origin().yaw, 7.0 - 2 * PI, 1e-12);
}

TEST_F(MapReader, ReadsPngByTheMeanOfTheColoursOfOpaquePixels)
{
    EXPECT_EQ(cells(greyPng(3, 2, {254, 205, 0, 0, 254, 254})), ".?#/#..");
    EXPECT_EQ(cells(encodePng(4, 1, PNG_FORMAT_RGB, {255, 255, 255, 255, 0, 0, 205, 205, 205, 0, 255, 255})), ".#??");
    for (const std::string mode : {"trinary", "scale"})
    {
        EXPECT_EQ(
            cells(encodePng(5, 1, PNG_FORMAT_GA, {255, 255, 0, 255, 205, 255, 255, 0, 0, 254}), "mode: " + mode + "\n"),
            ".#???");
        EXPECT_EQ(cells(encodePng(3, 1, PNG_FORMAT_RGBA, {255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 0}),
                        "mode: " + mode + "\n"),
                  ".#?");
    }
    EXPECT_EQ(cells(PALETTE_PNG), "#??.#/.??##");
    // 16 bits: 65535, 52685 (205 of 255), 100.
    EXPECT_EQ(
        cells(fromHex("89504e470d0a1a0a0000000d49484452000000030000000110000000006e1b972b0000000f4944415478da63f8fff"
                      "fec5986140010fb03fd6ff3a4380000000049454e44ae426082")),
        ".?#");
}

TEST_F(MapReader, AnImageOfAnotherSizeThanAnnouncedIsAnError)
{
    expectImageError("P2 2 2 255  1 2 3", {"truncated"});
    expectImageError("P2 2 2 255  1 2 3 4 5", {"more than the 2 x 2"});
    expectImageError(raw("P5 2 2 255\n", {1, 2, 3}), {"truncated", "2 x 2"});
    expectImageError(raw("P5 2 2 255\n", {1, 2, 3, 4, 5}), {"too long", "2 x 2"});
    EXPECT_NO_THROW(read(raw("P5 2 2 255\n", {1, 2, 3, 4, '\n'})));
    expectImageError(raw("P5 2 2 65535\n", {1, 2, 3, 4, 5, 6, 7}), {"truncated"});
    const std::string png = greyPng(40, 40, std::vector<std::uint8_t>(1600, 77));
    expectImageError(png.substr(0, png.size() / 2), {"not a valid PNG"});
    expectImageError(png.substr(0, 20), {"not a valid PNG"});
}

TEST_F(MapReader, AbsurdSizesAreRefusedBeforeAnyMemoryIsTaken)
{
    expectImageError("P5 0 5 255\n", {"0 x 5", "at least 1"});
    expectImageError("P5 65536 65536 255\n", {"65536 x 65536", "2^31"});
    expectImageError("P5 99999999999999999999 1 255\n", {"the width", "'99999999999999999999'"});
    expectImageError("P5 40000 40000 255\n1", {"truncated", "40000 x 40000"});
    expectImageError("P2 40000 40000 255\n1", {"truncated"});
    // A PNG whose header was changed to a huge size, with its checksum put right (as an attacker would).
    const auto announcing = [](const std::string &header)
    {
        std::string png = greyPng(1, 1, {1});
        png.replace(16, 13, header);
        const std::string chunk = png.substr(12, 17);
        std::uint32_t crc = 0xFFFFFFFF;
        for (const char c : chunk)
        {
            crc ^= static_cast<unsigned char>(c);
            for (int k = 0; k < 8; ++k)
                crc = crc & 1 ? crc >> 1 ^ 0xEDB88320 : crc >> 1;
        }
        crc ^= 0xFFFFFFFF;
        for (int k = 0; k < 4; ++k)
            png[static_cast<std::size_t>(29 + k)] = static_cast<char>(crc >> (24 - 8 * k) & 0xFF);
        return png;
    };
    expectImageError(announcing(std::string("\x00\x00\x9C\x40\x00\x00\x9C\x40\x08\x00\x00\x00\x00", 13)),
                     {"truncated", "40000 x 40000"});
    // 25000 x 20000 pixels of 64 bits in a file of 61 kB, which would do for a bit each; and the same interlaced.
    for (const char interlaced : {'\0', '\1'})
        expectImageError(announcing(std::string("\x00\x00\x61\xA8\x00\x00\x4E\x20\x10\x06\x00\x00", 12) + interlaced) +
                             std::string(61000, '\0'),
                         {"truncated", "25000 x 20000"});
}

TEST_F(MapReader, DevicesAreNoImages)
{
    expectYamlError("image: /dev/zero\nresolution: 1\norigin: [0, 0, 0]\n" + THRESHOLDS, {"/dev/zero", "device"});
}

TEST_F(MapReader, OtherImageTroubleIsNamed)
{
    expectImageError("P6 1 1 255\n123", {"neither a PGM (P2, P5) nor a PNG"});
    expectImageError("P5 2 1 255\n", {"truncated"});
    expectImageError("P5", {"truncated", "the width"});
    expectImageError("P5 2", {"truncated", "the height"});
    expectImageError("P5 2 1", {"truncated", "the largest value"});
    expectImageError("P5 2 1 70000\n12", {"the largest value", "65535"});
    expectImageError("P5 2 1 0\n12", {"the largest value is 0"});
    expectImageError("P5 -2 1 255\n12", {"the width is '-2'"});
    expectImageError("P2 2 1 255 12 x", {"a pixel is 'x'"});
    expectImageError("P2 2 1 200 12 201", {"a pixel is '201'", "200"});
    expectImageError(raw("P5 2 1 200\n", {12, 201}), {"a pixel is 201", "200"});
}

TEST_F(MapReader, YamlTroubleIsNamedWithItsLine)
{
    const std::string good = "image: map.img\nresolution: 1\norigin: [0, 0, 0]\n" + THRESHOLDS;
    folder_.write("map.img", "P2 2 1 1 0 1");
    EXPECT_NO_THROW(readRosMap(folder_.write("map.yaml", good + "frame: world\n")));
    expectYamlError("resolution: 1\norigin: [0, 0, 0]\n", {"map.yaml:1", "'image' is missing"});
    expectYamlError("image: map.img\norigin: [0, 0, 0]\n", {"'resolution' is missing"});
    expectYamlError("image: map.img\nresolution: 1\n---\norigin: [0, 0, 0]\n", {"map.yaml:4: a second YAML document"});
    expectYamlError("image: map.img\nresolution: 1\n", {"'origin' is missing"});
    expectYamlError("image: map.img\nresolution: 0\norigin: [0, 0, 0]\n",
                    {"map.yaml:2", "resolution is 0", "positive"});
    expectYamlError("image: map.img\nresolution: -1\norigin: [0, 0, 0]\n", {"map.yaml:2", "resolution is -1"});
    expectYamlError("image: map.img\nresolution: .inf\norigin: [0, 0, 0]\n", {"map.yaml:2", "resolution"});
    expectYamlError("image: map.img\nresolution: 1\norigin: [0, 0]\n", {"map.yaml:3", "origin has 2 entries"});
    expectYamlError(good + "negate: 2\n", {"map.yaml:6", "negate is '2'"});
    expectYamlError(good + "mode: ternary\n", {"map.yaml:6", "'ternary'", "'trinary'"});
    expectYamlError(good + "negat: 1\n", {"map.yaml:6", "'negat'", "'negate'"});
    const std::string poses = "image: map.img\nresolution: 1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\n";
    expectYamlError(poses + "free_thresh: 1.5\n", {"map.yaml:5", "free_thresh is 1.5", "0 to 1"});
    expectYamlError(poses + "free_thresh: 0.7\n", {"map.yaml:5", "free_thresh is 0.7", "0.65"});
    expectYamlError("image: none.pgm\nresolution: 1\norigin: [0, 0, 0]\n" + THRESHOLDS, {"none.pgm", "No such file"});
    expectError([&] { readRosMap(folder_.path("none.yaml")); }, {"none.yaml", "No such file"});
}

TEST_F(MapReader, NamesTheKeyThatIsMeant)
{
    const std::string good = "image: map.img\nresolution: 1\norigin: [0, 0, 0]\n" + THRESHOLDS;
    const auto renamed = [&good](const std::string &from, const std::string &to)
    {
        return std::string(good).replace(good.find(from), from.size(), to);
    };
    const std::pair<const char *, const char *> others[] = {{"free_thresh", "free_threshold"},
                                                            {"free_thresh", "thresh_free"},
                                                            {"occupied_thresh", "occ_thresh"},
                                                            {"occupied_thresh", "occupied_threshold"},
                                                            {"resolution", "map_resolution"},
                                                            {"origin", "map_origin"},
                                                            {"image", "images"},
                                                            {"image", "image_file"}};
    for (const auto &[right, other] : others)
    {
        const std::size_t line = 1 + static_cast<std::size_t>(std::count(
                                         good.begin(), good.begin() + static_cast<long>(good.find(right)), '\n'));
        expectYamlError(renamed(right, other),
                        {"map.yaml:" + std::to_string(line), "unknown key '" + std::string(other),
                         "did you mean '" + std::string(right) + "'"});
    }
    expectYamlError("<?xml version=\"1.0\"?><osm/>", {"map.yaml: is XML", "PGM or PNG"});
    expectYamlError(good + "negated: 1\n", {"map.yaml:6", "'negated'", "'negate'"});
    expectYamlError(good + "mdoe: raw\n", {"map.yaml:6", "'mdoe'", "'mode'"});
    expectYamlError(renamed("free_thresh: 0.196\n", ""), {"'free_thresh' is missing"});
    expectYamlError(renamed("occupied_thresh: 0.65\n", ""), {"'occupied_thresh' is missing"});
    // Keys of other programs are no business of this reader, however near to one of its own.
    for (const char *key : {"zone", "node", "nodes", "pose", "code", "home", "more", "model", "page", "frame",
                            "origin_gps", "free_space_version", "negative_obstacles", "image_size"})
        EXPECT_NO_THROW(readRosMap(folder_.write("map.yaml", good + key + ": yard\n"))) << key;
}

TEST_F(MapReader, WarnsWhereUnknownGroundBecomesFree)
{
    const std::string image = "P2 5 2 255  205 254 254 254 0  205 206 204 205 0";
    std::vector<std::string> warnings;
    read(image, "", &warnings);
    read(image, "negate: 1\nfree_thresh: 0.25\n", &warnings);
    read(image, "mode: raw\nfree_thresh: 0.25\n", &warnings);
    EXPECT_TRUE(warnings.empty());
    read(image, "free_thresh: 0.25\n", &warnings);
    ASSERT_EQ(warnings.size(), 1u);
    for (const char *part : {"map.yaml:4: free_thresh 0.25", "30 % of the cells", "0.196"})
        EXPECT_NE(warnings.front().find(part), std::string::npos) << warnings.front();
}

TEST_F(MapReader, ReadsTheRealMaps)
{
    const std::filesystem::path data = std::filesystem::path(PARKING_SHARED_DATA) / "maps";
    if (!std::filesystem::is_directory(data))
        GTEST_SKIP() << "the maps are not at " << data;
    int count = 0;
    for (const auto &entry : std::filesystem::directory_iterator(data))
        if (entry.path().extension() == ".yaml")
        {
            const OccupancyGrid grid = readRosMap(entry.path().string());
            const std::vector<Cell> &all = grid.cells();
            EXPECT_GT(std::count(all.begin(), all.end(), Cell::Free), 1000) << entry.path();
            EXPECT_GT(std::count(all.begin(), all.end(), Cell::Occupied), 500) << entry.path();
            ++count;
        }
    EXPECT_GT(count, 0);
}
