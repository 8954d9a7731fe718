#include "parking_geometry/Error.h"
#include "parking_geometry/io/images/ImageRows.h"

#include <csetjmp>
#include <cstring>

#include <png.h>

namespace parking
{
    namespace
    {
        /** What libpng works on. It reports errors by a long jump, which must not skip destructors: everything that
            owns memory lives here, outside of the functions that are left that way. */
        struct PngReader
        {
            explicit PngReader(const std::string &data) : bytes(data)
            {
            }
            ~PngReader()
            {
                png_destroy_read_struct(&png, &info, nullptr);
            }
            PngReader(const PngReader &) = delete;
            PngReader &operator=(const PngReader &) = delete;

            const std::string &bytes;
            std::size_t position{0};
            png_structp png{nullptr};
            png_infop info{nullptr};
            std::string message;
            bool interlaced{false};
            std::size_t encodedRow{0};  ///< bytes of a row as the file has it, before anything is expanded
            std::vector<unsigned char> raster;
            std::vector<png_bytep> rows;
        };

        [[noreturn]] void onError(png_structp png, png_const_charp message)
        {
            static_cast<PngReader *>(png_get_error_ptr(png))->message = message;
            png_longjmp(png, 1);
        }

        void onWarning(png_structp, png_const_charp)
        {
            // Warnings concern colour profiles and the like, which a map does not need.
        }

        void onRead(png_structp png, png_bytep target, std::size_t count)
        {
            auto *reader = static_cast<PngReader *>(png_get_io_ptr(png));
            if (count > reader->bytes.size() - reader->position)
                png_error(png, "truncated: the file ends within the image");
            std::memcpy(target, reader->bytes.data() + reader->position, count);
            reader->position += count;
        }

        /** Reads the header and asks for grey or RGB of 8 or 16 bits, with alpha where there is transparency. */
        bool readHeader(PngReader &reader)
        {
            if (setjmp(png_jmpbuf(reader.png)))
                return false;
            png_read_info(reader.png, reader.info);
            reader.encodedRow = png_get_rowbytes(reader.png, reader.info);
            png_set_expand(reader.png);
            reader.interlaced = png_set_interlace_handling(reader.png) > 1;
            png_read_update_info(reader.png, reader.info);
            return true;
        }

        /** All rows at once: what an interlaced image takes. */
        bool readRaster(PngReader &reader)
        {
            if (setjmp(png_jmpbuf(reader.png)))
                return false;
            png_read_image(reader.png, reader.rows.data());
            return true;
        }

        /** The next row. */
        bool readRow(PngReader &reader)
        {
            if (setjmp(png_jmpbuf(reader.png)))
                return false;
            png_read_row(reader.png, reader.raster.data(), nullptr);
            return true;
        }

        bool readEnd(PngReader &reader)
        {
            if (setjmp(png_jmpbuf(reader.png)))
                return false;
            png_read_end(reader.png, nullptr);
            return true;
        }

        std::uint32_t sample(const unsigned char *at, bool wide)
        {
            return wide ? static_cast<std::uint32_t>(at[0] << 8 | at[1]) : at[0];
        }
    }  // namespace

    void decodePng(const std::string &file, const std::string &bytes, const ImageSink &sink)
    {
        PngReader reader(bytes);
        reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, onError, onWarning);
        reader.info = reader.png ? png_create_info_struct(reader.png) : nullptr;
        if (!reader.info)
            throw Error(file + ": there is not enough memory to read it");
        png_set_read_fn(reader.png, &reader, onRead);
        if (!readHeader(reader))
            throw Error(file + ": not a valid PNG: " + reader.message);

        const std::size_t width = png_get_image_width(reader.png, reader.info);
        const std::size_t height = png_get_image_height(reader.png, reader.info);
        const std::size_t rowBytes = png_get_rowbytes(reader.png, reader.info);
        const std::size_t channels = png_get_channels(reader.png, reader.info);
        const bool wide = png_get_bit_depth(reader.png, reader.info) == 16;
        const bool alpha = channels == 2 || channels == 4;
        checkImageSize(file, width, height);
        // Deflate packs at most 1032 times: a larger announcement is no image, and must not make us take the memory for
        // it.
        if (reader.encodedRow > 1032 * bytes.size() / height)
            throw Error(file + ": truncated: it announces " + std::to_string(width) + " x " + std::to_string(height) +
                        " pixels and is " + std::to_string(bytes.size()) + " bytes long");
        const auto require = [&](bool done)
        {
            if (!done)
                throw Error(file + ": not a valid PNG: " + reader.message);
        };
        reader.raster.resize(reader.interlaced ? rowBytes * height : rowBytes);
        if (reader.interlaced)
        {
            for (std::size_t row = 0; row < height; ++row)
                reader.rows.push_back(reader.raster.data() + row * rowBytes);
            require(readRaster(reader));
        }

        const std::size_t colours = alpha ? channels - 1 : channels;
        const std::uint32_t full = wide ? 65535 : 255;
        const std::size_t size = wide ? 2 : 1;
        sink.begin(width, height, full * static_cast<std::uint32_t>(colours));
        std::vector<std::uint32_t> brightness(width);
        for (std::size_t row = 0; row < height; ++row)
        {
            if (!reader.interlaced)
                require(readRow(reader));
            const unsigned char *pixel = reader.interlaced ? reader.rows[row] : reader.raster.data();
            for (std::size_t column = 0; column < width; ++column, pixel += channels * size)
            {
                std::uint32_t sum = 0;
                for (std::size_t channel = 0; channel < colours; ++channel)
                    sum += sample(pixel + channel * size, wide);
                const bool opaque = !alpha || sample(pixel + colours * size, wide) == full;
                brightness[column] = opaque ? sum : NOT_OPAQUE;
            }
            sink.row(row, brightness);
        }
        require(readEnd(reader));
    }
}  // namespace parking
