// What is written is read again; what is damaged is refused, whatever the damage.

#include "benchmarks/formats/MatFile.h"

#include "benchmarks/formats/ScenarioFormat.h"
#include "parking_geometry/MakeScenario.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

namespace
{
    using namespace parking;
    using namespace parking_test;

    constexpr std::size_t HEADER = 128;

    class MatFileTest : public testing::Test
    {
    protected:
        void SetUp() override
        {
            if (!hasMatFiles())
                GTEST_SKIP() << "built without libmatio";
        }

        /** A case that the project has written. */
        std::string goodCase()
        {
            Scenario scenario;
            scenario.goals = {{8.0, 1.0, -1.2}};
            scenario.polygons = {{{2.0, 2.0}, {4.0, 2.0}, {4.0, 4.0}, {2.0, 4.0}},
                                 {{-5.0, -5.0}, {-3.0, -5.0}, {-4.0, -4.0}}};
            made_ = makeScenario(scenario, "made");
            commonParkingFormat().write(made_, folder_.path("Case07.mat"));
            return contentOf(folder_.path("Case07.mat"));
        }

        /** The message with which a file of these bytes is refused; empty when it is the case that was written. */
        std::string refusal(const std::string &content) const
        {
            const std::string file = folder_.write("bad.mat", content);
            try
            {
                const Scenario scenario = commonParkingFormat().read(file, {});
                EXPECT_EQ(scenario.polygons, made_.polygons);
                EXPECT_EQ(scenario.worldOffset, made_.worldOffset);
                for (const auto &[read, made] :
                     {std::pair{scenario.start, made_.start}, std::pair{scenario.goals.front(), made_.goals.front()}})
                    EXPECT_TRUE(isSamePose(read, made, 0.0));
            }
            catch (const Error &error)
            {
                EXPECT_EQ(std::string(error.what()).find(file + ": "), 0U) << error.what();
                return error.what();
            }
            return "";
        }

        TemporaryFolder folder_;
        Scenario made_;
    };

    // Elements of a file by hand, little-endian unless told.

    std::string word(std::uint32_t value, bool bigEndian = false)
    {
        std::string text;
        for (int i = 0; i < 4; ++i)
            text += static_cast<char>(value >> (8 * i) & 0xffU);
        if (bigEndian)
            std::reverse(text.begin(), text.end());
        return text;
    }

    std::string element(std::uint32_t type, const std::string &data, bool bigEndian = false)
    {
        return word(type, bigEndian) + word(static_cast<std::uint32_t>(data.size()), bigEndian) + data +
               std::string((8 - data.size() % 8) % 8, '\0');
    }

    std::string matrix(std::uint32_t flags, std::uint32_t rows, std::uint32_t columns, const std::string &contents,
                       bool bigEndian = false)
    {
        return element(14,
                       element(6, word(flags, bigEndian) + word(0, bigEndian), bigEndian) +
                           element(5, word(rows, bigEndian) + word(columns, bigEndian), bigEndian) +
                           element(1, "v", bigEndian) + contents,
                       bigEndian);
    }

    /** An element as zlib stores what it does not compress (RFC 1950 and 1951): one block of at most 65,535 bytes. */
    std::string stored(const std::string &text)
    {
        std::uint32_t a = 1, b = 0;
        for (const char each : text)
        {
            a = (a + static_cast<std::uint8_t>(each)) % 65521U;
            b = (b + a) % 65521U;
        }
        const auto size = static_cast<std::uint32_t>(text.size());
        const std::string data = "\x78\x01\x01" + word(size | (~size << 16)) + text + word(b << 16 | a, true);
        return word(15) + word(static_cast<std::uint32_t>(data.size())) + data;
    }

    std::string file(const std::string &elements, bool bigEndian = false)
    {
        std::string header = "MATLAB 5.0 MAT-file";
        header.resize(124, ' ');
        return header + (bigEndian ? std::string("\1\0MI", 4) : std::string("\0\1IM", 4)) + elements;
    }

    TEST_F(MatFileTest, ReadsWhatItWrites)
    {
        const std::string name = folder_.path("a.mat");
        writeMat(name, "v",
                 MatValue::structure({{"row", MatValue::row({1.0, -2.5, 1e300})},
                                      {"yes", MatValue::logical(true)},
                                      {"text", MatValue::of("a text")},
                                      {"none", MatValue::empty()},
                                      {"list", MatValue::cell({MatValue::number(3.0), MatValue::of("")})}}));
        const MatValue read = readMat(name, "v");
        ASSERT_EQ(read.fields.size(), 5U);
        EXPECT_EQ(read.field("row")->numbers, (std::vector<double>{1.0, -2.5, 1e300}));
        EXPECT_EQ(read.field("row")->rows, 1U);
        EXPECT_EQ(read.field("yes")->kind, MatValue::Kind::Logical);
        EXPECT_EQ(read.field("yes")->numbers, std::vector<double>{1.0});
        EXPECT_EQ(read.field("text")->text, "a text");
        EXPECT_TRUE(read.field("none")->numbers.empty());
        ASSERT_EQ(read.field("list")->cells.size(), 2U);
        EXPECT_EQ(read.field("list")->cells[0].numbers, std::vector<double>{3.0});
        EXPECT_EQ(read.field("list")->cells[1].text, "");
        expectError([&] { readMat(name, "w"); }, {name, "w cannot be read", "no such variable"});
    }

    TEST_F(MatFileTest, ReadsLargeWorldsThatItWrites)
    {
        Scenario scenario;
        scenario.goals = {{2.0, 0.0, 0.0}};
        for (int i = 0; i < 100000; ++i)
        {
            const double x = i % 400, y = 10.0 + static_cast<double>(i / 400);
            scenario.polygons.push_back({{x, y}, {x + 0.5, y}, {x + 0.5, y + 0.5}, {x, y + 0.5}});
        }
        const Scenario made = makeScenario(scenario, "made");
        commonParkingFormat().write(made, folder_.path("Case08.mat"));
        EXPECT_EQ(commonParkingFormat().read(folder_.path("Case08.mat"), {}).polygons.size(), 100000U);
    }

    TEST_F(MatFileTest, ReadsWhatTheFormatAllows)
    {
        const auto read = [&](const std::string &content)
        {
            return readMat(folder_.write("b.mat", content), "v");
        };
        // Whole numbers in the smallest type, and within their tag when they are few.
        EXPECT_EQ(read(file(matrix(6, 1, 3, word(3U << 16 | 2U) + std::string("\x01\xff\x02\0", 4)))).numbers,
                  (std::vector<double>{1.0, 255.0, 2.0}));
        EXPECT_EQ(read(file(matrix(6, 2, 1, element(1, "\x01\xff")))).numbers, (std::vector<double>{1.0, -1.0}));
        // Another machine's order of bytes.
        EXPECT_EQ(read(file(matrix(6, 1, 1, element(5, word(70000, true), true), true), true)).numbers,
                  std::vector<double>{70000.0});
        // Texts of two bytes for each character, and of up to four.
        EXPECT_EQ(read(file(matrix(4, 1, 2, element(17, std::string("a\0\xe4\0", 4))))).text, "a?");
        EXPECT_EQ(read(file(matrix(4, 1, 2, element(16, "a\xc3\xa4")))).text, "a?");
        // The size of an array, and its name, of types that other programs give them.
        const std::string head = element(6, word(6) + word(0)) + element(6, word(1) + word(1)) + element(16, "v");
        EXPECT_EQ(read(file(element(14, head + element(2, "\x07")))).numbers, std::vector<double>{7.0});
        // Other variables, of classes that are not read.
        const std::string opaque = element(14, element(6, word(17) + word(0)) + element(1, "o"));
        EXPECT_EQ(read(file(opaque + matrix(6, 1, 1, element(2, "\x05")))).numbers, std::vector<double>{5.0});
    }

    TEST_F(MatFileTest, RefusesWhatDoesNotAgree)
    {
        const auto refused = [&](const std::string &content, const std::vector<std::string> &parts)
        {
            const std::string name = folder_.write("c.mat", content);
            expectError([&] { readMat(name, "v"); }, {name + ": "});
            expectError([&] { readMat(name, "v"); }, parts);
        };
        const std::string nine = element(9, std::string(8, '\0'));
        refused(file(matrix(6, 2, 1, nine)), {"damaged at byte", "8 bytes for 2 numbers"});
        refused(file(matrix(6, 1, 1, element(8, "x"))), {"type 8"});
        refused(file(matrix(6, 1, 1, nine + nine)), {"left over"});
        refused(file(matrix(6, 1, 0xffffffffU, nine)), {"an array of -1"});
        refused(file(matrix(6, 0x7fffffffU, 0x7fffffffU, nine)), {"too large"});
        refused(file(matrix(1, 0x400, 0x1000, "")), {"damaged", "4 bytes should follow, but 0 do"});
        refused(file(matrix(6U | 0x800U, 1, 1, nine + nine)), {"complex"});
        refused(file(matrix(5, 1, 1, nine)), {"class"});
        refused(file(matrix(2, 1, 1, element(5, word(0)) + element(1, "x"))), {"names of fields"});
        refused(file(matrix(4, 1, 3, element(16, "ab"))), {"2 bytes for a text of 3"});
        refused(file(word(5U << 16 | 14U) + "abcd"), {"damaged at byte 128", "5 bytes, not 1 to 4"});
        refused(file(word(14) + word(0xffffffffU)), {"damaged at byte 136", "4294967295 bytes should follow"});
        refused(file(word(15) + word(4) + "abcd"), {"damaged at byte 136", "decompressed"});
        const std::string good = stored(matrix(6, 1, 1, nine));
        EXPECT_EQ(readMat(folder_.write("d.mat", file(good)), "v").numbers, std::vector<double>{0.0});
        refused(file(stored(matrix(6, 1, 1, nine) + "12345678")), {"of what is compressed", "8 bytes are left over"});
        std::string tooLong = good + "1234";
        tooLong[4] = static_cast<char>(tooLong[4] + 4);
        refused(file(tooLong), {"damaged at byte 136", "ends 4 bytes too early"});
        std::string badSum = good;
        badSum.back() = static_cast<char>(badSum.back() + 1);
        refused(file(badSum), {"damaged at byte 136", "decompressed"});
        refused(file(element(3, "x")), {"type 3 where a variable is expected"});
        std::string deep = matrix(1, 0, 0, "");
        for (int i = 0; i < 40; ++i)
            deep = matrix(1, 1, 1, deep);
        refused(file(deep), {"deeper"});
        std::string order = file(matrix(6, 1, 1, nine));
        for (const std::string other : {"XM", "MI"})
            refused(order.replace(126, 2, other), {"damaged at byte 126"});
    }

    TEST_F(MatFileTest, RefusesWhatTakesLittleInAFileAndMuchInMemory)
    {
        const auto zeros = [&](std::size_t megabytes)
        {
            const std::string name = folder_.path("zeros.mat");
            writeMat(name, "v", MatValue::row(std::vector<double>((megabytes << 20) / 8)));
            return contentOf(name);
        };
        const std::string bomb = zeros(65);
        EXPECT_LT(bomb.size(), 1U << 20);
        const auto refused = [&](const std::string &content, const std::string &variable, const std::string &part)
        {
            const std::string name = folder_.write("e.mat", content);
            expectError([&] { readMat(name, variable); }, {name + ": ", part});
        };
        refused(bomb, "v", "more than 67108864 bytes are compressed");
        const std::string half = zeros(33);
        EXPECT_EQ(readMat(folder_.write("f.mat", half), "v").columns, 33U << 17);
        refused(half, "w", "no such variable");
        refused(half + half.substr(HEADER), "w", "more than 67108864 bytes are compressed");
        const auto nothings = [](std::uint32_t count)
        {
            std::string contents;
            for (std::uint32_t i = 0; i < count; ++i)
                contents += element(14, "");
            return file(matrix(1, 1, count, contents));
        };
        refused(nothings(1000000), "v", "more than 1000000 values");  // with the array itself
        EXPECT_EQ(readMat(folder_.write("f.mat", nothings(999999)), "v").cells.size(), 999999U);
        // Names and structures without anything in them.
        refused(file(matrix(2, 1, 1000, element(5, word(1)) + element(1, std::string(1000, 'x')))), "v",
                "1000 structures of 1000 fields in 0 bytes");
        EXPECT_TRUE(readMat(folder_.write("g.mat", file(matrix(2, 0, 0, element(5, word(1)) + element(1, "abc")))), "v")
                        .fields.empty());
    }

    TEST_F(MatFileTest, EveryTruncationIsAnError)
    {
        const std::string good = goodCase();
        ASSERT_EQ(refusal(good), "");
        for (std::size_t length = 0; length < good.size(); ++length)
            EXPECT_NE(refusal(good.substr(0, length)), "") << "the first " << length << " bytes of " << good.size();
    }

    TEST_F(MatFileTest, AChangedByteIsAnErrorOrMakesNoDifference)
    {
        const std::string good = goodCase();
        std::size_t refused = 0;
        for (std::size_t place = 0; place < good.size(); ++place)
            for (const char value : {'\0', '\x80', '\xff'})
            {
                std::string changed = good;
                changed[place] = value;
                refused += refusal(changed).empty() ? 0 : 1;
            }
        // The header is mostly text for people; what is compressed carries a sum.
        EXPECT_GT(refused, 3 * (good.size() - HEADER) - 20);
    }

    TEST_F(MatFileTest, AChangedByteOfWhatIsNotCompressedIsAnErrorOrAnotherValue)
    {
        const std::string tail =
            matrix(4, 1, 4, element(16, "kind")) + matrix(6, 1, 2, element(9, std::string(16, 'x')));
        const std::string names = std::string("a\0\0\0b\0\0\0", 8);
        const std::string good = file(
            matrix(2, 1, 1,
                   element(5, word(4)) + element(1, names) + matrix(1, 1, 2, tail) + matrix(6, 0, 0, element(9, ""))));
        const auto read = [&](const std::string &content)
        {
            try
            {
                readMat(folder_.write("d.mat", content), "v");
            }
            catch (const Error &error)
            {
                EXPECT_EQ(std::string(error.what()).find(folder_.path("d.mat") + ": "), 0U) << error.what();
                return false;
            }
            return true;
        };
        ASSERT_TRUE(read(good));
        for (std::size_t place = HEADER; place < good.size(); ++place)
        {
            EXPECT_FALSE(read(good.substr(0, place))) << place;
            for (const char value : {'\0', '\1', '\x7f', '\x80', '\xff'})
            {
                std::string changed = good;
                changed[place] = value;
                read(changed);
            }
        }
    }
}  // namespace
