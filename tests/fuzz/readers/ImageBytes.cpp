// PGM and PNG images.

#include "parking_geometry/io/images/ImageRows.h"
#include "tests/fuzz/Fuzz.h"

namespace parking_test::fuzz
{
    void tryInput(const std::string &input)
    {
        std::size_t width = 0, rows = 0, height = 0;
        std::uint32_t white = 0;
        parking::ImageSink sink;
        sink.begin = [&](std::size_t columns, std::size_t count, std::uint32_t brightest)
        {
            width = columns;
            height = count;
            white = brightest;
        };
        sink.row = [&](std::size_t row, const std::vector<std::uint32_t> &brightness)
        {
            if (row != rows++ || brightness.size() != width)
                fail("a row that does not fit");
            for (const std::uint32_t each : brightness)
                if (each > white && each != parking::NOT_OPAQUE)
                    fail("brighter than white");
        };
        if (accepts("fuzzed.img", [&] { parking::decodeImage("fuzzed.img", input, sink); }) && rows != height)
            fail("not all rows were decoded");
    }
}  // namespace parking_test::fuzz
