#include "benchmarks/formats/MatFile.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"
#include "parking_geometry/text/WriteFile.h"

#ifdef PARKING_HAVE_MATIO
#include <matio.h>
#endif

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>

#include <unistd.h>

namespace parking
{
    MatValue MatValue::number(double value)
    {
        return column({value});
    }

    MatValue MatValue::logical(bool value)
    {
        MatValue made = number(value ? 1.0 : 0.0);
        made.kind = Kind::Logical;
        return made;
    }

    MatValue MatValue::row(std::vector<double> values)
    {
        MatValue made;
        made.rows = 1;
        made.columns = values.size();
        made.numbers = std::move(values);
        return made;
    }

    MatValue MatValue::column(std::vector<double> values)
    {
        MatValue made = row(std::move(values));
        std::swap(made.rows, made.columns);
        return made;
    }

    MatValue MatValue::of(std::string text)
    {
        MatValue made;
        made.kind = Kind::Text;
        made.text = std::move(text);
        return made;
    }

    MatValue MatValue::structure(std::vector<std::pair<std::string, MatValue>> fields)
    {
        MatValue made;
        made.kind = Kind::Struct;
        made.fields = std::move(fields);
        return made;
    }

    MatValue MatValue::cell(std::vector<MatValue> cells)
    {
        MatValue made;
        made.kind = Kind::Cell;
        made.cells = std::move(cells);
        return made;
    }

    MatValue MatValue::empty()
    {
        return {};
    }

    const MatValue *MatValue::field(const std::string &name) const
    {
        for (const auto &[each, value] : fields)
            if (each == name)
                return &value;
        return nullptr;
    }

#ifdef PARKING_HAVE_MATIO
    namespace
    {
        constexpr std::size_t LARGEST = std::size_t(256) << 20;  // bytes
        constexpr int DEEPEST = 32;                              // values within values

        struct CloseFile
        {
            void operator()(mat_t *file) const
            {
                Mat_Close(file);
            }
        };
        struct FreeVariable
        {
            void operator()(matvar_t *variable) const
            {
                Mat_VarFree(variable);
            }
        };
        using File = std::unique_ptr<mat_t, CloseFile>;
        using Variable = std::unique_ptr<matvar_t, FreeVariable>;

        template <class Number>
        void takeNumbers(const matvar_t &variable, std::size_t count, std::vector<double> &numbers)
        {
            const auto *values = static_cast<const Number *>(variable.data);
            for (std::size_t i = 0; i < count; ++i)
                numbers.push_back(static_cast<double>(values[i]));
        }

        void takeNumbers(const matvar_t &variable, std::size_t count, std::vector<double> &numbers)
        {
            switch (variable.class_type)
            {
                case MAT_C_DOUBLE:
                    return takeNumbers<double>(variable, count, numbers);
                case MAT_C_SINGLE:
                    return takeNumbers<float>(variable, count, numbers);
                case MAT_C_INT8:
                    return takeNumbers<std::int8_t>(variable, count, numbers);
                case MAT_C_UINT8:
                    return takeNumbers<std::uint8_t>(variable, count, numbers);
                case MAT_C_INT16:
                    return takeNumbers<std::int16_t>(variable, count, numbers);
                case MAT_C_UINT16:
                    return takeNumbers<std::uint16_t>(variable, count, numbers);
                case MAT_C_INT32:
                    return takeNumbers<std::int32_t>(variable, count, numbers);
                case MAT_C_UINT32:
                    return takeNumbers<std::uint32_t>(variable, count, numbers);
                case MAT_C_INT64:
                    return takeNumbers<std::int64_t>(variable, count, numbers);
                case MAT_C_UINT64:
                    return takeNumbers<std::uint64_t>(variable, count, numbers);
                default:
                    throw Error("holds a variable of a class that is not understood");
            }
        }

        std::string textOf(const matvar_t &variable, std::size_t count)
        {
            std::string text;
            for (std::size_t i = 0; i < count && variable.data != nullptr; ++i)
            {
                const unsigned code = variable.data_size == 2 ? static_cast<const std::uint16_t *>(variable.data)[i]
                                                              : static_cast<const std::uint8_t *>(variable.data)[i];
                text += code < 128 ? static_cast<char>(code) : '?';
            }
            return text;
        }

        MatValue fromMatio(matvar_t *variable, int depth)
        {
            MatValue value;
            if (variable == nullptr)
                return value;
            if (depth > DEEPEST)
                throw Error("nests values deeper than any case does");
            if (variable->rank == 0)  // nothing, as in the fields of a struct
                return value;
            if (variable->rank != 2)
                throw Error("holds an array that is no matrix");
            if (variable->isComplex != 0)
                throw Error("holds complex numbers");
            const std::size_t rows = variable->dims[0], columns = variable->dims[1];
            if (columns != 0 && rows > LARGEST / columns)
                throw Error("holds a matrix that is too large");
            const std::size_t count = rows * columns;
            if (variable->class_type == MAT_C_STRUCT)
            {
                value.kind = MatValue::Kind::Struct;
                char *const *names = Mat_VarGetStructFieldnames(variable);
                const unsigned fields = count > 0 ? Mat_VarGetNumberOfFields(variable) : 0;
                for (unsigned i = 0; i < fields; ++i)
                    value.fields.emplace_back(names[i],
                                              fromMatio(Mat_VarGetStructFieldByIndex(variable, i, 0), depth + 1));
            }
            else if (variable->class_type == MAT_C_CELL)
            {
                value.kind = MatValue::Kind::Cell;
                for (std::size_t i = 0; i < count; ++i)
                    value.cells.push_back(fromMatio(Mat_VarGetCell(variable, static_cast<int>(i)), depth + 1));
            }
            else if (variable->class_type == MAT_C_CHAR)
            {
                value.kind = MatValue::Kind::Text;
                value.text = textOf(*variable, count);
            }
            else
            {
                value.kind = variable->isLogical != 0 ? MatValue::Kind::Logical : MatValue::Kind::Numbers;
                value.rows = rows;
                value.columns = columns;
                if (count > 0 && variable->data == nullptr)
                    throw Error("is damaged: a matrix has no numbers");
                if (count > 0)
                    takeNumbers(*variable, count, value.numbers);
            }
            return value;
        }

        /** matio copies what it is given, though it does not promise to. */
        matvar_t *toMatio(const char *name, const MatValue &value)
        {
            std::array<std::size_t, 2> size{1, 1};
            switch (value.kind)
            {
                case MatValue::Kind::Struct:
                {
                    std::vector<const char *> names;
                    for (const auto &field : value.fields)
                        names.push_back(field.first.c_str());
                    matvar_t *made =
                        Mat_VarCreateStruct(name, 2, size.data(), names.data(), static_cast<unsigned>(names.size()));
                    for (const auto &[field, inner] : value.fields)
                        Mat_VarSetStructFieldByName(made, field.c_str(), 0, toMatio(nullptr, inner));
                    return made;
                }
                case MatValue::Kind::Cell:
                {
                    size[1] = value.cells.size();
                    matvar_t *made = Mat_VarCreate(name, MAT_C_CELL, MAT_T_CELL, 2, size.data(), nullptr, 0);
                    for (std::size_t i = 0; i < value.cells.size(); ++i)
                        Mat_VarSetCell(made, static_cast<int>(i), toMatio(nullptr, value.cells[i]));
                    return made;
                }
                case MatValue::Kind::Text:
                    size = {value.text.empty() ? std::size_t(0) : std::size_t(1), value.text.size()};
                    return Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF8, 2, size.data(),
                                         const_cast<char *>(value.text.data()), 0);
                case MatValue::Kind::Logical:
                {
                    std::uint8_t bit = value.numbers.front() != 0.0;
                    return Mat_VarCreate(name, MAT_C_UINT8, MAT_T_UINT8, 2, size.data(), &bit, MAT_F_LOGICAL);
                }
                case MatValue::Kind::Numbers:
                    break;
            }
            size = {value.rows, value.columns};
            return Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(),
                                 const_cast<double *>(value.numbers.data()), 0);
        }
    }  // namespace

    bool hasMatFiles()
    {
        return true;
    }

    MatValue readMat(const std::string &file, const std::string &variable)
    {
        const std::string begin = readFile(file, LARGEST).substr(0, 128);
        // The text is for people. The version is two bytes at 124, in either order; matio believes them.
        const std::string version = begin.size() < 126 ? std::string() : begin.substr(124, 2);
        const bool five = version == std::string("\0\1", 2) || version == std::string("\1\0", 2);
        const bool seven = version == std::string("\0\2", 2) || version == std::string("\2\0", 2);
        if (begin.compare(0, 10, "MATLAB 7.3") == 0 || (begin.compare(0, 6, "MATLAB") == 0 && seven))
            throw Error(file + ": a file of MATLAB 7.3 (HDF5); save it with save(..., '-v7')");
        if (begin.compare(0, 10, "MATLAB 5.0") != 0 || !five)
            throw Error(file + ": no MATLAB 5 file (what save(..., '-v7') or '-v6' writes)");
        const File opened(Mat_Open(file.c_str(), MAT_ACC_RDONLY));
        if (!opened || Mat_GetVersion(opened.get()) != MAT_FT_MAT5)
            throw Error(file + ": a damaged MATLAB 5 file");
        const Variable found(Mat_VarRead(opened.get(), variable.c_str()));
        if (!found)
            throw Error(file + ": holds no variable " + variable + " that can be read");
        try
        {
            return fromMatio(found.get(), 0);
        }
        catch (const Error &error)
        {
            throw Error(file + ": " + variable + " " + error.what());
        }
    }

    void writeMat(const std::string &file, const std::string &variable, const MatValue &value)
    {
        const std::string part =
            (std::filesystem::temp_directory_path() / ("parking-" + std::to_string(getpid()) + ".mat")).string();
        {
            const File opened(Mat_CreateVer(part.c_str(), nullptr, MAT_FT_MAT5));
            const Variable made(toMatio(variable.c_str(), value));
            if (!opened || !made || Mat_VarWrite(opened.get(), made.get(), MAT_COMPRESSION_ZLIB) != 0)
                throw Error(file + ": cannot be written by way of " + part);
        }
        std::string bytes;
        try
        {
            bytes = readFile(part, LARGEST);
        }
        catch (...)
        {
            std::filesystem::remove(part);
            throw;
        }
        std::filesystem::remove(part);
        writeFileAtomically(file, bytes);
    }
#else
    namespace
    {
        [[noreturn]] void refuse(const std::string &file)
        {
            throw Error(file + ": this build has no MATLAB files; build it with libmatio-dev");
        }
    }  // namespace

    bool hasMatFiles()
    {
        return false;
    }

    MatValue readMat(const std::string &file, const std::string & /*variable*/)
    {
        refuse(file);
    }

    void writeMat(const std::string &file, const std::string & /*variable*/, const MatValue & /*value*/)
    {
        refuse(file);
    }
#endif
}  // namespace parking
