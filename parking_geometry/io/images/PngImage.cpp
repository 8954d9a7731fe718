#include "parking_geometry/Error.h"
#include "parking_geometry/io/images/ImageRows.h"

#include <png.h>

namespace parking
{
    namespace
    {
        /** An image of libpng that releases its memory. */
        struct Image : png_image
        {
            Image() : png_image()
            {
                version = PNG_IMAGE_VERSION;
            }
            ~Image()
            {
                png_image_free(this);
            }
            Image(const Image &) = delete;
            Image &operator=(const Image &) = delete;
        };

        /** Bits of a pixel in the file. Bytes 24 and 25 of the valid header contain its depth and type. */
        std::size_t bitsPerPixel(const std::string &bytes)
        {
            const auto depth = static_cast<unsigned char>(bytes[24]), type = static_cast<unsigned char>(bytes[25]);
            const unsigned int colours = (type & PNG_COLOR_MASK_COLOR) != 0 && type != PNG_COLOR_TYPE_PALETTE ? 3 : 1;
            const unsigned int channels = colours + ((type & PNG_COLOR_MASK_ALPHA) != 0 ? 1 : 0);
            return std::size_t{channels} * depth;
        }
    }  // namespace

    void decodePng(const std::string &file, const std::string &bytes, const ImageSink &sink)
    {
        Image image;
        const auto require = [&](int done)
        {
            if (done == 0)
                throw Error(file + ": not a valid PNG: " + image.message);
        };
        require(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
        checkImageSize(file, image.width, image.height);
        // The compression ratio of deflate is at most 1032. A larger declared image is invalid and must not cause its
        // allocation.
        if (image.width * bitsPerPixel(bytes) / 8 > 1032 * bytes.size() / image.height)
            throw Error(file + ": truncated: it announces " + std::to_string(image.width) + " x " +
                        std::to_string(image.height) + " pixels and is " + std::to_string(bytes.size()) +
                        " bytes long");
        image.format = (image.format & PNG_FORMAT_FLAG_COLOR) != 0 ? PNG_FORMAT_RGBA : PNG_FORMAT_GA;
        image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // 16 bits are finer steps of the same brightness
        const std::size_t channels = PNG_IMAGE_PIXEL_CHANNELS(image.format), rowBytes = image.width * channels;
        std::vector<png_byte> raster(rowBytes * image.height);
        require(png_image_finish_read(&image, nullptr, raster.data(), 0, nullptr));

        sink.begin(image.width, image.height, 255 * static_cast<std::uint32_t>(channels - 1));
        std::vector<std::uint32_t> brightness(image.width);
        const png_byte *pixel = raster.data();
        for (std::size_t row = 0; row < image.height; ++row)
        {
            for (std::uint32_t &each : brightness)
            {
                each = 0;
                for (std::size_t colour = 0; colour + 1 < channels; ++colour)
                    each += pixel[colour];
                if (pixel[channels - 1] != 255)
                    each = NOT_OPAQUE;
                pixel += channels;
            }
            sink.row(row, brightness);
        }
    }
}  // namespace parking
