#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Brightness that marks a pixel that is not fully opaque. */
    constexpr std::uint32_t NOT_OPAQUE = UINT32_MAX;

    /** \brief Receives an image during decoding, so that memory holds only one copy of a large map. */
    struct ImageSink
    {
        /** \brief Called once, before the rows. \param white brightness of a white pixel; black is 0 */
        std::function<void(std::size_t width, std::size_t height, std::uint32_t white)> begin;

        /** \brief Called for every row from top to bottom. \param brightness per pixel, summed over colour channels, or
            NOT_OPAQUE */
        std::function<void(std::size_t row, const std::vector<std::uint32_t> &brightness)> row;
    };

    /** \brief Decodes a PGM (P2, P5) or PNG image and detects the format from the first bytes.

        Throws parking::Error naming \e file for any other format, a truncated image, surplus pixels, and more than 2^31
        pixels. */
    void decodeImage(const std::string &file, const std::string &bytes, const ImageSink &sink);

    /** \brief Decodes a PGM image like decodeImage(). \e bytes must begin with its signature. */
    void decodePgm(const std::string &file, const std::string &bytes, const ImageSink &sink);

    /** \brief Decodes a PNG image like decodeImage(). \e bytes must begin with its signature. */
    void decodePng(const std::string &file, const std::string &bytes, const ImageSink &sink);

    /** \brief Throws parking::Error if a side of the image is 0 or it has more than 2^31 pixels. */
    void checkImageSize(const std::string &file, std::size_t width, std::size_t height);
}  // namespace parking
