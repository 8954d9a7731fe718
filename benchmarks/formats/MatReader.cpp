// Reads MATLAB 5 files, by their published format (MATLAB's "MAT-File Format", level 5).
//
// libmatio, which writes them, believes the sizes that it reads: damaged files made it crash, or turn round for ever.
// Here nothing can be read that is not in the file, and sizes that do not agree are refused.

#include "benchmarks/formats/MatFile.h"

#include "parking_geometry/Error.h"

#ifdef PARKING_HAVE_MATIO
#include <zlib.h>
#endif

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <string_view>
#include <type_traits>

namespace parking
{
#ifdef PARKING_HAVE_MATIO
    namespace
    {
        constexpr std::size_t MOST_VALUES = 1000000;  // each takes more memory than it need take in a file
        constexpr std::size_t HEADER = 128;           // bytes
        constexpr int DEEPEST = 32;                   // values within values

        // What the data of an element are.
        enum Type : std::uint32_t
        {
            INT8 = 1,
            UINT8 = 2,
            INT16 = 3,
            UINT16 = 4,
            INT32 = 5,
            UINT32 = 6,
            SINGLE = 7,
            DOUBLE = 9,
            INT64 = 12,
            UINT64 = 13,
            MATRIX = 14,
            COMPRESSED = 15,
            UTF8 = 16,
            UTF16 = 17,
            UTF32 = 18
        };

        // Other programs than MATLAB are not exact about these.
        constexpr std::initializer_list<Type> WHOLE_NUMBERS{INT32, UINT32}, NAMES{INT8, UTF8};

        // What a matrix is in MATLAB; numbers are those from FIRST_NUMBERS to LAST_NUMBERS.
        enum Class : std::uint32_t
        {
            CELL = 1,
            STRUCT = 2,
            CHARACTERS = 4,
            FIRST_NUMBERS = 6,
            LAST_NUMBERS = 15,
            OPAQUE = 17  // has no size where others have it
        };

        constexpr std::uint32_t COMPLEX = 0x800, LOGICAL = 0x200;  // bits beside the class

        struct Element;

        /** Some bytes of a file, read from their beginning. */
        class Bytes
        {
        public:
            /** \param place of the first byte in \e source, which messages name */
            Bytes(std::string_view bytes, std::size_t place, bool bigEndian, const char *source)
              : bytes_(bytes),
                place_(place),
                bigEndian_(bigEndian),
                source_(source)
            {
            }

            std::size_t size() const
            {
                return bytes_.size();
            }

            std::string_view text() const
            {
                return bytes_;
            }

            [[noreturn]] void fail(const std::string &what) const
            {
                throw Error("the file is damaged at byte " + std::to_string(place_) + source_ + ": " + what);
            }

            /** Takes as many from the beginning. */
            Bytes take(std::size_t count)
            {
                if (count > bytes_.size())
                    fail(std::to_string(count) + " bytes should follow, but " + std::to_string(bytes_.size()) + " do");
                const Bytes taken(bytes_.substr(0, count), place_, bigEndian_, source_);
                bytes_.remove_prefix(count);
                place_ += count;
                return taken;
            }

            template <class Number>
            Number number()
            {
                using Unsigned = std::conditional_t<
                    sizeof(Number) == 1, std::uint8_t,
                    std::conditional_t<sizeof(Number) == 2, std::uint16_t,
                                       std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>>>;
                const Bytes taken = take(sizeof(Number));
                Unsigned bits = 0;
                for (std::size_t i = 0; i < sizeof(Number); ++i)
                {
                    const std::size_t shift = 8 * (bigEndian_ ? sizeof(Number) - 1 - i : i);
                    bits |= static_cast<Unsigned>(static_cast<Unsigned>(static_cast<std::uint8_t>(taken.bytes_[i]))
                                                  << shift);
                }
                Number value;
                std::memcpy(&value, &bits, sizeof(value));
                return value;
            }

            /** Takes the element at the beginning, and what fills it up to eight bytes. */
            Element element();

            /** The same of an element that must be of one of these types, and of so many bytes unless they are 0. */
            Bytes element(std::initializer_list<Type> types, std::size_t size);

            /** What zlib makes of it: so many bytes at most. */
            std::string inflated(std::size_t most) const;

            Bytes within(const std::string &inflated) const
            {
                return {inflated, 0, bigEndian_, " of what is compressed"};
            }

        private:
            std::string_view bytes_;
            std::size_t place_;
            bool bigEndian_;
            const char *source_;
        };

        struct Element
        {
            std::uint32_t type;
            Bytes data;
        };

        Element Bytes::element()
        {
            const Bytes begin = *this;
            const auto first = number<std::uint32_t>();
            const std::uint32_t smallSize = first >> 16;
            if (smallSize != 0)  // within its tag
            {
                if (smallSize > 4)
                    begin.fail("an element within its tag has " + std::to_string(smallSize) + " bytes, not 1 to 4");
                Bytes data = take(4);
                return {first & 0xffffU, data.take(smallSize)};
            }
            const auto size = number<std::uint32_t>();
            const Bytes data = take(size);
            if (first != COMPRESSED)
                take(std::min<std::size_t>((8 - size % 8) % 8, bytes_.size()));
            return {first, data};
        }

        Bytes Bytes::element(std::initializer_list<Type> types, std::size_t size)
        {
            const Bytes begin = *this;
            const Element found = element();
            if (std::find(types.begin(), types.end(), found.type) == types.end())
                begin.fail("data of type " + std::to_string(found.type) + " where type " +
                           std::to_string(*types.begin()) + " is expected");
            if (size != 0 && found.data.size() != size)
                begin.fail(std::to_string(found.data.size()) + " bytes of data where " + std::to_string(size) +
                           " are expected");
            return found.data;
        }

        struct EndInflation
        {
            void operator()(z_stream *stream) const
            {
                inflateEnd(stream);
            }
        };

        std::string Bytes::inflated(std::size_t most) const
        {
            z_stream stream{};
            if (inflateInit(&stream) != Z_OK)
                throw Error("zlib has no memory");
            const std::unique_ptr<z_stream, EndInflation> end(&stream);
            std::string input(bytes_), text;
            stream.next_in = reinterpret_cast<Bytef *>(input.data());
            stream.avail_in = static_cast<uInt>(input.size());
            std::array<char, 1 << 16> buffer;
            int state = Z_OK;
            while (state == Z_OK)
            {
                stream.next_out = reinterpret_cast<Bytef *>(buffer.data());
                stream.avail_out = static_cast<uInt>(buffer.size());
                state = inflate(&stream, Z_NO_FLUSH);
                const std::size_t made = buffer.size() - stream.avail_out;
                if (made > most - text.size())
                    fail("more than " + std::to_string(MAT_FILE_LIMIT) + " bytes are compressed in the file");
                text.append(buffer.data(), made);
            }
            // The end is reached only when zlib's own sum over all that was compressed is right.
            if (state != Z_STREAM_END)
                fail("what is compressed here cannot be decompressed");
            if (stream.avail_in != 0)
                fail("what is compressed here ends " + std::to_string(stream.avail_in) + " bytes too early");
            return text;
        }

        template <class Number>
        std::vector<double> numbersOf(Bytes data, std::size_t count)
        {
            if (data.size() != count * sizeof(Number))
                data.fail(std::to_string(data.size()) + " bytes for " + std::to_string(count) + " numbers of " +
                          std::to_string(sizeof(Number)));
            std::vector<double> numbers;
            numbers.reserve(count);
            for (std::size_t i = 0; i < count; ++i)
                numbers.push_back(static_cast<double>(data.number<Number>()));
            return numbers;
        }

        /** Of whatever type: MATLAB stores whole numbers in the smallest that holds them. */
        std::vector<double> numbersOf(const Element &element, std::size_t count)
        {
            const Bytes &data = element.data;
            switch (element.type)
            {
                case INT8:
                    return numbersOf<std::int8_t>(data, count);
                case UINT8:
                    return numbersOf<std::uint8_t>(data, count);
                case INT16:
                    return numbersOf<std::int16_t>(data, count);
                case UINT16:
                case UTF16:
                    return numbersOf<std::uint16_t>(data, count);
                case INT32:
                    return numbersOf<std::int32_t>(data, count);
                case UINT32:
                case UTF32:
                    return numbersOf<std::uint32_t>(data, count);
                case INT64:
                    return numbersOf<std::int64_t>(data, count);
                case UINT64:
                    return numbersOf<std::uint64_t>(data, count);
                case SINGLE:
                    return numbersOf<float>(data, count);
                case DOUBLE:
                    return numbersOf<double>(data, count);
                default:
                    data.fail("data of type " + std::to_string(element.type) + ", which are no numbers");
            }
        }

        /** What is not ASCII becomes a question mark. */
        std::string textOf(const Element &element, std::size_t count)
        {
            std::string text;
            if (element.type != UTF8)
            {
                for (const double code : numbersOf(element, count))
                    text += code >= 0.0 && code < 128.0 ? static_cast<char>(code) : '?';
                return text;
            }
            for (const char each : element.data.text())
            {
                const auto code = static_cast<std::uint8_t>(each);
                if (code < 0x80 || code >= 0xc0)  // not one of the further bytes of a character
                    text += code < 0x80 ? each : '?';
            }
            // MATLAB counts characters, libmatio bytes.
            if (text.size() != count && element.data.size() != count)
                element.data.fail(std::to_string(element.data.size()) + " bytes for a text of " +
                                  std::to_string(count));
            return text;
        }

        struct Matrix
        {
            std::uint32_t flags{0};
            std::vector<std::size_t> size;
            std::string name;

            std::uint32_t classOf() const
            {
                return flags & 0xffU;
            }
        };

        /** Takes what comes before the contents. Without a size when it is of a class that has none. */
        Matrix takeHead(Bytes &data)
        {
            Matrix head;
            Bytes flags = data.element({UINT32}, 8);
            head.flags = flags.number<std::uint32_t>();
            if (head.classOf() == OPAQUE)
                return head;
            const Bytes before = data;
            Bytes size = data.element(WHOLE_NUMBERS, 0);
            if (size.size() % 4 != 0 || size.size() < 8)
                before.fail("the size of an array in " + std::to_string(size.size()) + " bytes");
            while (size.size() > 0)
            {
                const auto length = size.number<std::int32_t>();
                if (length < 0)
                    before.fail("an array of " + std::to_string(length) + " elements");
                head.size.push_back(static_cast<std::size_t>(length));
            }
            head.name = data.element(NAMES, 0).text();
            return head;
        }

        MatValue valueOf(Bytes data, int depth, std::size_t &values);

        /** \param values that were made so far in the whole file */
        MatValue innerValue(Bytes &data, int depth, std::size_t &values)
        {
            return valueOf(data.element({MATRIX}, 0), depth + 1, values);
        }

        /** \param count of structures, each of which has a value for each name */
        std::vector<std::string> takeFieldNames(Bytes &data, std::size_t count)
        {
            const Bytes before = data;
            const auto width = data.element(WHOLE_NUMBERS, 4).number<std::int32_t>();
            Bytes names = data.element(NAMES, 0);
            if (width <= 0 || names.size() % static_cast<std::size_t>(width) != 0)
                before.fail("names of fields of " + std::to_string(width) + " bytes each in " +
                            std::to_string(names.size()));
            constexpr std::size_t LEAST_VALUE = 8;  // bytes
            const std::size_t fields = names.size() / static_cast<std::size_t>(width);
            if (count > 0 && fields > data.size() / LEAST_VALUE / count)
                before.fail(std::to_string(count) + " structures of " + std::to_string(fields) + " fields in " +
                            std::to_string(data.size()) + " bytes");
            std::vector<std::string> taken;
            while (count > 0 && names.size() > 0)
            {
                const std::string_view name = names.take(static_cast<std::size_t>(width)).text();
                taken.emplace_back(name.substr(0, name.find('\0')));
            }
            return taken;
        }

        /** Fills in what follows the head. */
        void takeContents(const Matrix &head, Bytes &data, int depth, std::size_t &values, MatValue &value)
        {
            if (head.size.size() != 2)
                throw Error("it holds an array that is no matrix");
            if ((head.flags & COMPLEX) != 0)
                throw Error("it holds complex numbers");
            const std::size_t rows = head.size[0], columns = head.size[1];
            if (columns != 0 && rows > MAT_FILE_LIMIT / columns)
                throw Error("it holds a matrix that is too large");
            const std::size_t count = rows * columns;
            if (head.classOf() == STRUCT)
            {
                value.kind = MatValue::Kind::Struct;
                const std::vector<std::string> names = takeFieldNames(data, count);
                for (std::size_t i = 0; !names.empty() && i < count; ++i)
                    for (const std::string &name : names)
                    {
                        MatValue inner = innerValue(data, depth, values);
                        if (i == 0)
                            value.fields.emplace_back(name, std::move(inner));
                    }
            }
            else if (head.classOf() == CELL)
            {
                value.kind = MatValue::Kind::Cell;
                for (std::size_t i = 0; i < count; ++i)
                    value.cells.push_back(innerValue(data, depth, values));
            }
            else if (head.classOf() == CHARACTERS)
            {
                value.kind = MatValue::Kind::Text;
                value.text = textOf(data.element(), count);
            }
            else if (head.classOf() >= FIRST_NUMBERS && head.classOf() <= LAST_NUMBERS)
            {
                value.kind = (head.flags & LOGICAL) != 0 ? MatValue::Kind::Logical : MatValue::Kind::Numbers;
                value.rows = rows;
                value.columns = columns;
                value.numbers = numbersOf(data.element(), count);
            }
            else
                throw Error("it holds a variable of a class that is not understood");
        }

        MatValue valueOf(Bytes data, int depth, std::size_t &values)
        {
            MatValue value;
            if (++values > MOST_VALUES)
                throw Error("it holds more than " + std::to_string(MOST_VALUES) + " values");
            if (depth > DEEPEST)
                throw Error("it nests values deeper than any case does");
            if (data.size() == 0)  // nothing, as in the fields of a struct
                return value;
            const Matrix head = takeHead(data);
            takeContents(head, data, depth, values, value);
            if (data.size() > 0)
                data.fail(std::to_string(data.size()) + " bytes are left over at the end of a variable");
            return value;
        }

        /** The variable, when it is the one of this name. */
        bool isFound(const Element &element, const std::string &name, MatValue &value)
        {
            Bytes data = element.data;
            if (element.type != MATRIX)
                data.fail("data of type " + std::to_string(element.type) + " where a variable is expected");
            if (data.size() == 0 || takeHead(data).name != name)
                return false;
            std::size_t values = 0;
            value = valueOf(element.data, 0, values);
            return true;
        }

        MatValue find(Bytes file, const std::string &name)
        {
            MatValue value;
            bool found = false;
            std::size_t left = MAT_FILE_LIMIT;
            while (file.size() > 0)  // to the end, though it may have been found: the file must be whole
            {
                const Element element = file.element();
                if (found)
                    continue;
                if (element.type != COMPRESSED)
                {
                    found = isFound(element, name, value);
                    continue;
                }
                const std::string inflated = element.data.inflated(left);
                left -= inflated.size();
                Bytes inner = element.data.within(inflated);
                found = isFound(inner.element(), name, value);
                if (inner.size() > 0)
                    inner.fail(std::to_string(inner.size()) + " bytes are left over");
            }
            if (!found)
                throw Error("there is no such variable");
            return value;
        }
    }  // namespace

    MatValue parseMat(const std::string &file, const std::string &content, const std::string &variable)
    {
        // The text is for people. The version is two bytes at 124, in the order of bytes that is said at 126.
        const std::string version = content.size() < HEADER ? std::string() : content.substr(124, 2);
        const bool five = version == std::string("\0\1", 2) || version == std::string("\1\0", 2);
        const bool seven = version == std::string("\0\2", 2) || version == std::string("\2\0", 2);
        if (content.compare(0, 10, "MATLAB 7.3") == 0 || (content.compare(0, 6, "MATLAB") == 0 && seven))
            throw Error(file + ": a file of MATLAB 7.3 (HDF5); save it with save(..., '-v7')");
        if (content.compare(0, 10, "MATLAB 5.0") != 0 || !five)
            throw Error(file + ": no MATLAB 5 file (what save(..., '-v7') or '-v6' writes)");
        const std::string order = content.substr(126, 2);
        if (order != (version.back() == '\1' ? "IM" : "MI"))
            throw Error(file + ": damaged at byte 126: the order of the bytes must be IM or MI, as at byte 124");
        try
        {
            return find({std::string_view(content).substr(HEADER), HEADER, order == "MI", ""}, variable);
        }
        catch (const Error &error)
        {
            throw Error(file + ": " + variable + " cannot be read: " + error.what());
        }
    }
#else
    MatValue parseMat(const std::string &file, const std::string & /*content*/, const std::string & /*variable*/)
    {
        throw Error(file + ": this build has no MATLAB files; build it with libmatio-dev");
    }
#endif
}  // namespace parking
