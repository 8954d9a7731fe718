#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief What the brightness of a pixel is that is not fully opaque. */
    constexpr std::uint32_t NOT_OPAQUE = UINT32_MAX;

    /** \brief Takes an image while it is decoded, so that only one copy of a large map is ever in memory. */
    struct ImageSink
    {
        /** \brief Called once, before the rows. \param white the brightness of a white pixel; black is 0 */
        std::function<void(std::size_t width, std::size_t height, std::uint32_t white)> begin;

        /** \brief Called for every row, the top one first: brightness of its pixels (of colours: the sum over the
            channels), or NOT_OPAQUE. */
        std::function<void(std::size_t row, const std::vector<std::uint32_t> &brightness)> row;
    };

    /** \brief Decodes a PGM (P2, P5) or PNG image, told apart by their first bytes.

        Throws parking::Error naming \e file for any other format, a truncated image, one with more pixels than its
        header announces, and one with more than 2^31 pixels. */
    void decodeImage(const std::string &file, const std::string &bytes, const ImageSink &sink);

    /** \brief decodeImage() for a PGM, with whose signature \e bytes must begin. */
    void decodePgm(const std::string &file, const std::string &bytes, const ImageSink &sink);

    /** \brief decodeImage() for a PNG, with whose signature \e bytes must begin. */
    void decodePng(const std::string &file, const std::string &bytes, const ImageSink &sink);

    /** \brief Throws parking::Error when an image is of no size or absurdly large. */
    void checkImageSize(const std::string &file, std::size_t width, std::size_t height);
}  // namespace parking
