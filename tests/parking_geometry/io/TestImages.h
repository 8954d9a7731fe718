#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <png.h>

namespace parking_test
{
    /** What a PNG is made of; samples row by row, channel by channel. */
    struct TestPng
    {
        std::size_t width{0};
        std::size_t height{0};
        int colourType{PNG_COLOR_TYPE_GRAY};
        int bitDepth{8};
        std::vector<std::uint16_t> samples;
        std::vector<std::uint8_t> palette;       ///< red, green, blue of each entry
        std::vector<std::uint8_t> paletteAlpha;  ///< of the first entries
        bool interlaced{false};
    };

    inline std::size_t channelsOf(int colourType)
    {
        switch (colourType)
        {
            case PNG_COLOR_TYPE_GRAY_ALPHA:
                return 2;
            case PNG_COLOR_TYPE_RGB:
                return 3;
            case PNG_COLOR_TYPE_RGB_ALPHA:
                return 4;
            default:
                return 1;
        }
    }

    /** The bytes of the file. Samples of less than eight bits are packed. */
    inline std::string encodePng(const TestPng &image)
    {
        png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
        png_infop info = png_create_info_struct(png);
        std::string bytes;
        png_set_write_fn(
            png, &bytes,
            [](png_structp writer, png_bytep data, png_size_t count)
            { static_cast<std::string *>(png_get_io_ptr(writer))->append(reinterpret_cast<char *>(data), count); },
            nullptr);
        if (setjmp(png_jmpbuf(png)))
            throw std::runtime_error("the test's own image is wrong");
        png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height),
                     image.bitDepth, image.colourType, image.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        if (!image.palette.empty())
        {
            std::vector<png_color> colours;
            for (std::size_t i = 0; i + 2 < image.palette.size(); i += 3)
                colours.push_back({image.palette[i], image.palette[i + 1], image.palette[i + 2]});
            png_set_PLTE(png, info, colours.data(), static_cast<int>(colours.size()));
            if (!image.paletteAlpha.empty())
                png_set_tRNS(png, info, image.paletteAlpha.data(), static_cast<int>(image.paletteAlpha.size()),
                             nullptr);
        }
        png_write_info(png, info);
        if (image.bitDepth < 8)
            png_set_packing(png);
        const std::size_t perRow = image.width * channelsOf(image.colourType);
        std::vector<std::vector<png_byte>> rows;
        for (std::size_t row = 0; row < image.height; ++row)
        {
            rows.emplace_back();
            for (std::size_t i = 0; i < perRow; ++i)
            {
                const std::uint16_t sample = image.samples.at(row * perRow + i);
                if (image.bitDepth == 16)
                    rows.back().push_back(static_cast<png_byte>(sample >> 8));
                rows.back().push_back(static_cast<png_byte>(sample & 0xFF));
            }
        }
        std::vector<png_bytep> pointers;
        for (std::vector<png_byte> &row : rows)
            pointers.push_back(row.data());
        png_write_image(png, pointers.data());
        png_write_end(png, info);
        png_destroy_write_struct(&png, &info);
        return bytes;
    }

    /** A .npy file, header and data, with the given type, order and shape. */
    inline std::string encodeNpy(const std::vector<std::int64_t> &values, const std::string &type = "<i8",
                                 const std::string &order = "False", std::string shape = {})
    {
        if (shape.empty())
            shape = "(" + std::to_string(values.size() / 4) + ", 4)";
        std::string header = "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }";
        header.resize((header.size() + 10 + 64) / 64 * 64 - 10 - 1, ' ');
        header += '\n';
        std::string bytes("\x93NUMPY\x01\x00", 8);
        bytes += static_cast<char>(header.size() & 0xFF);
        bytes += static_cast<char>(header.size() >> 8);
        bytes += header;
        for (const std::int64_t value : values)
            for (int shift = 0; shift < 64; shift += 8)
                bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> shift & 0xFF);
        return bytes;
    }
}  // namespace parking_test
