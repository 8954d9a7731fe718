#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <png.h>

namespace parking_test
{
    /** A PNG file of 8 bits a channel. \param format such as PNG_FORMAT_GRAY \param samples row by row */
    inline std::string encodePng(png_uint_32 width, png_uint_32 height, png_uint_32 format,
                                 const std::vector<std::uint8_t> &samples)
    {
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        image.width = width;
        image.height = height;
        image.format = format;
        png_alloc_size_t size = 0;
        std::string bytes;
        if (samples.size() != PNG_IMAGE_SIZE(image) ||
            png_image_write_to_memory(&image, nullptr, &size, 0, samples.data(), 0, nullptr) == 0)
            throw std::runtime_error("the test's own image is wrong");
        bytes.resize(size);
        png_image_write_to_memory(&image, bytes.data(), &size, 0, samples.data(), 0, nullptr);
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
