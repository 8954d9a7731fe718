#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace parking
{
    /** \brief A value as MATLAB has it. */
    struct MatValue
    {
        /** \brief What it is. */
        enum class Kind
        {
            Numbers,  ///< of any class, as doubles
            Logical,  ///< yes or no, as numbers
            Text,     ///< an array of characters
            Struct,   ///< one; of an array of them the first
            Cell      ///< a list of values
        };

        Kind kind{Kind::Numbers};                              ///< which of the members below counts
        std::size_t rows{0};                                   ///< of numbers
        std::size_t columns{0};                                ///< of numbers
        std::vector<double> numbers;                           ///< column by column
        std::string text;                                      ///< of a text
        std::vector<std::pair<std::string, MatValue>> fields;  ///< of a struct
        std::vector<MatValue> cells;                           ///< of a cell array

        /** \brief One number. */
        static MatValue number(double value);
        /** \brief Yes or no. */
        static MatValue logical(bool value);
        /** \brief Numbers side by side. */
        static MatValue row(std::vector<double> values);
        /** \brief Numbers below each other. */
        static MatValue column(std::vector<double> values);
        /** \brief A text. */
        static MatValue of(std::string text);
        /** \brief A struct of one. */
        static MatValue structure(std::vector<std::pair<std::string, MatValue>> fields);
        /** \brief A cell array in a row. */
        static MatValue cell(std::vector<MatValue> cells);
        /** \brief A matrix of nothing. */
        static MatValue empty();

        /** \brief The field of this name; null when there is none. */
        const MatValue *field(const std::string &name) const;
    };

    /** \brief Can this build read and write such files? It takes libmatio, which writes them, and its zlib. */
    bool hasMatFiles();

    /** \brief Most bytes of a MATLAB file that are read, and of what is compressed in it: a world of a million corners
        takes less. */
    constexpr std::size_t MAT_FILE_LIMIT = std::size_t(64) << 20;

    /** \brief A variable of a MATLAB 5 file (what MATLAB's `save` has written since version 5, but for `-v7.3`).

        Throws parking::Error with one line for a file that is damaged (at which byte), of another version, or has no
        such variable. */
    MatValue readMat(const std::string &file, const std::string &variable);

    /** \brief readMat() of what \e file holds, which is then not read. */
    MatValue parseMat(const std::string &file, const std::string &content, const std::string &variable);

    /** \brief Writes one variable as a MATLAB 5 file, whole or not at all. Throws parking::Error. */
    void writeMat(const std::string &file, const std::string &variable, const MatValue &value);
}  // namespace parking
