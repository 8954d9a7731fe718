#include "parking_geometry/Error.h"
#include "parking_geometry/io/images/ImageRows.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <string_view>

namespace parking
{
    namespace
    {
        bool isBlank(char c)
        {
            return c == ' ' || (c >= '\t' && c <= '\r');
        }

        /** Reads the words of a PGM file; a '#' begins a comment that ends with its line. */
        class PgmWords
        {
        public:
            PgmWords(const std::string &file, std::string_view text, std::size_t position)
              : file_(file),
                text_(text),
                position_(position)
            {
            }

            /** The next whole number. Throws if it is missing, invalid or above \e limit. */
            std::size_t take(const char *what, std::size_t limit)
            {
                skipBlanks();
                const std::size_t begin = position_;
                while (position_ < text_.size() && !isBlank(text_[position_]) && text_[position_] != '#')
                    ++position_;
                const std::string_view word = text_.substr(begin, position_ - begin);
                if (word.empty())
                    throw Error(file_ + ": truncated: the file ends before " + what);
                std::size_t value = 0;
                if (!parseCount(word, value) || value > limit)
                    throw Error(file_ + ": " + what + " is " + inQuotes(word) + "; it must be a whole number up to " +
                                std::to_string(limit));
                return value;
            }

            void skipBlanks()
            {
                while (position_ < text_.size() && (isBlank(text_[position_]) || text_[position_] == '#'))
                {
                    if (text_[position_] == '#')
                        position_ = std::min(text_.find_first_of("\r\n", position_), text_.size());
                    else
                        ++position_;
                }
            }

            std::size_t position() const
            {
                return position_;
            }
            bool atEnd() const
            {
                return position_ >= text_.size();
            }

        private:
            const std::string &file_;
            std::string_view text_;
            std::size_t position_;
        };

        std::string sizeText(std::size_t width, std::size_t height)
        {
            return std::to_string(width) + " x " + std::to_string(height) + " pixels";
        }

        void decodePlain(const std::string &file, PgmWords &words, std::size_t width, std::size_t height,
                         std::size_t white, const ImageSink &sink)
        {
            std::vector<std::uint32_t> brightness(width);
            for (std::size_t row = 0; row < height; ++row)
            {
                for (std::uint32_t &pixel : brightness)
                    pixel = static_cast<std::uint32_t>(words.take("a pixel", white));
                sink.row(row, brightness);
            }
            words.skipBlanks();
            if (!words.atEnd())
                throw Error(file + ": holds more than the " + sizeText(width, height) + " that it announces");
        }

        void decodeRaw(const std::string &file, std::string_view raster, std::size_t width, std::size_t height,
                       std::size_t white, const ImageSink &sink)
        {
            const std::size_t bytesPerPixel = white > 255 ? 2 : 1;
            const std::size_t expected = width * height * bytesPerPixel;
            const bool surplus =
                raster.size() > expected &&
                !std::all_of(raster.begin() + static_cast<std::ptrdiff_t>(expected), raster.end(), isBlank);
            if (raster.size() < expected || surplus)
                throw Error(file + ": " + (surplus ? "too long" : "truncated") + ": " + sizeText(width, height) +
                            " take " + std::to_string(expected) + " bytes and the file holds " +
                            std::to_string(raster.size()));
            std::vector<std::uint32_t> brightness(width);
            const auto *next = reinterpret_cast<const unsigned char *>(raster.data());
            for (std::size_t row = 0; row < height; ++row)
            {
                for (std::uint32_t &pixel : brightness)
                {
                    pixel = *next++;
                    if (bytesPerPixel == 2)
                        pixel = pixel << 8 | *next++;
                    if (pixel > white)
                        throw Error(file + ": a pixel is " + std::to_string(pixel) +
                                    "; the largest value announced is " + std::to_string(white));
                }
                sink.row(row, brightness);
            }
        }
    }  // namespace

    void decodePgm(const std::string &file, const std::string &bytes, const ImageSink &sink)
    {
        const bool raw = bytes[1] == '5';
        PgmWords words(file, bytes, 2);
        const std::size_t maxSide = std::size_t(1) << 31;
        const std::size_t width = words.take("the width", maxSide);
        const std::size_t height = words.take("the height", maxSide);
        const std::size_t white = words.take("the largest value", 65535);
        checkImageSize(file, width, height);
        if (white == 0)
            throw Error(file + ": the largest value is 0; it must be 1 to 65535");

        // Check before the allocation: a pixel takes at least a byte, or a digit and a blank.
        const std::size_t left = bytes.size() - words.position();
        if ((raw ? left : (left + 1) / 2) < width * height)
            throw Error(file + ": truncated: it announces " + sizeText(width, height) + " and holds " +
                        std::to_string(left) + " bytes for them");
        sink.begin(width, height, static_cast<std::uint32_t>(white));
        if (raw)
        {
            std::string_view raster = std::string_view(bytes).substr(words.position() + 1);
            // One blank ends the header; of a header with Windows' line ends it is two bytes.
            const bool endsWithCrLf = bytes.compare(words.position(), 2, "\r\n") == 0;
            if (endsWithCrLf && raster.size() > width * height * (white > 255 ? 2 : 1))
                raster.remove_prefix(1);
            decodeRaw(file, raster, width, height, white, sink);
        }
        else
            decodePlain(file, words, width, height, white, sink);
    }
}  // namespace parking
