#include "benchmarks/formats/MatFile.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/ReadFile.h"
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

    MatValue readMat(const std::string &file, const std::string &variable)
    {
        return parseMat(file, readFile(file, MAT_FILE_LIMIT), variable);
    }

#ifdef PARKING_HAVE_MATIO
    namespace
    {
        constexpr std::size_t LARGEST = std::size_t(256) << 20;  // bytes

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
    bool hasMatFiles()
    {
        return false;
    }

    void writeMat(const std::string &file, const std::string & /*variable*/, const MatValue & /*value*/)
    {
        throw Error(file + ": this build has no MATLAB files; build it with libmatio-dev");
    }
#endif
}  // namespace parking
