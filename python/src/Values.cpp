#include "python/src/Values.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/curves/Biarc.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace parking::python
{
    namespace
    {
        /** A value as text of a message. */
        std::string shown(const py::handle &value)
        {
            constexpr std::size_t LONGEST = 60;
            const std::string text = oneLine(py::cast<std::string>(py::repr(value)));
            return text.size() > LONGEST ? text.substr(0, LONGEST) + "..." : text;
        }

        std::string shapeOf(const py::array &array)
        {
            std::string text;
            for (py::ssize_t i = 0; i < array.ndim(); ++i)
                text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
            return "(" + text + (array.ndim() == 1 ? ",)" : ")");
        }

        Doubles doublesFrom(const py::handle &value, const std::string &field, const std::string &right)
        {
            // Text is not a number, although NumPy would convert it.
            const py::array any = py::array::ensure(value);
            if (any && (any.dtype().kind() == 'f' || any.dtype().kind() == 'i' || any.dtype().kind() == 'u'))
                if (Doubles array = Doubles::ensure(any))
                    return array;
            failFor(value, field, right);
        }

        bool isFlag(const py::handle &value)
        {
            return py::isinstance<py::bool_>(value) ||
                   py::isinstance(value, py::module_::import("numpy").attr("bool_"));
        }

        bool isNumber(const py::handle &value)
        {
            return !py::isinstance<py::bool_>(value) && !py::isinstance<py::str>(value) &&
                   PyNumber_Check(value.ptr()) != 0 && !py::isinstance<py::array>(value);
        }

        std::optional<Cell> cellFrom(std::int64_t value)
        {
            switch (value)
            {
                case 0:
                    return Cell::Free;
                case 1:
                    return Cell::Occupied;
                case -1:
                case 2:
                    return Cell::Unknown;
                default:
                    return std::nullopt;
            }
        }

        /** A drive from row to row of a path. */
        class RowsDriver
        {
        public:
            RowsDriver(const Pose &start, double maxCurvature)
              : path_{start, {}},
                reached_(start),
                maxCurvature_(maxCurvature)
            {
            }

            void turn(double angle)
            {
                append({{}, {PathPiece::turnOnTheSpot(angle)}});
            }

            /** Drives to \e to, by two arcs in general. One is for what two would have to bend too much for: rows that
                are rounded. What it misses the row by is made good by those that come after it, so that it does not
                add up.

                \param arc from the row before to this one, if it were not for what it misses it by
                \return whether there is such a path */
            bool drive(const PathPiece &arc, const Pose &to)
            {
                const std::optional<Path> exact = biarc(reached_, to, arc.direction());
                const bool bends = !exact || std::any_of(exact->pieces.begin(), exact->pieces.end(),
                                                         [this](const PathPiece &piece)
                                                         { return std::abs(piece.curvature) > maxCurvature_; });
                if (bends && positionDistance(advance(reached_, arc), to) <= ROUNDED)
                    append({{}, {arc}});
                else if (exact)
                    append(*exact);
                else
                    return false;
                return true;
            }

            Path finish()
            {
                return std::move(path_);
            }

        private:
            static constexpr double ROUNDED = 2e-5;  // metres

            void append(const Path &pieces)
            {
                for (const PathPiece &piece : pieces.pieces)
                {
                    path_.pieces.push_back(piece);
                    reached_ = advance(reached_, piece);
                }
            }

            Path path_;
            Pose reached_;
            double maxCurvature_;
        };
    }  // namespace

    void failFor(const py::handle &value, const std::string &field, const std::string &right)
    {
        PyErr_Clear();
        throw Error(field + " must be " + right + ", not " + shown(value));
    }

    bool flagFrom(const py::handle &value, const std::string &field)
    {
        if (!isFlag(value))
            failFor(value, field, "True or False");
        return value.cast<bool>();
    }

    std::size_t countFrom(const py::handle &value, const std::string &field)
    {
        // Every object with __index__ is accepted, such as NumPy's integers.
        const bool isWhole = PyIndex_Check(value.ptr()) != 0 && isNumber(value) && !isFlag(value);
        const auto whole = py::reinterpret_steal<py::object>(isWhole ? PyNumber_Index(value.ptr()) : nullptr);
        if (!whole)
            failFor(value, field, "a whole number");
        const std::size_t count = PyLong_AsSize_t(whole.ptr());
        if (PyErr_Occurred() != nullptr)
            failFor(value, field, "a whole number that is not negative");
        return count;
    }

    std::string textFrom(const py::handle &value, const std::string &field)
    {
        if (!py::isinstance<py::str>(value))
            failFor(value, field, "a str");
        return py::cast<std::string>(value);
    }

    double numberFrom(const py::handle &value, const std::string &field)
    {
        if (isNumber(value))
        {
            const double number = PyFloat_AsDouble(value.ptr());
            if (PyErr_Occurred() == nullptr)
                return number;
        }
        failFor(value, field, "a number");
    }

    Pose poseFrom(const py::handle &value, const std::string &field)
    {
        const std::string right = "three numbers (x, y, yaw)";
        const Doubles array = doublesFrom(value, field, right);
        if (array.ndim() != 1 || array.shape(0) != 3)
            throw Error(field + " must be " + right + "; its shape is " + shapeOf(array));
        return {array.at(0), array.at(1), array.at(2)};
    }

    Doubles posesFrom(const py::handle &value, const std::string &field)
    {
        const std::string right = "an array of n rows (x, y, yaw)";
        Doubles array = doublesFrom(value, field, right);
        if (array.ndim() != 2 || array.shape(1) != 3)
            throw Error(field + " must be " + right + "; its shape is " + shapeOf(array));
        return array;
    }

    Polygon polygonFrom(const py::handle &value, const std::string &field)
    {
        const std::string right = "an array of n rows (x, y)";
        const Doubles array = doublesFrom(value, field, right);
        if (array.ndim() != 2 || array.shape(1) != 2)
            throw Error(field + " must be " + right + "; its shape is " + shapeOf(array));
        Polygon polygon;
        polygon.reserve(static_cast<std::size_t>(array.shape(0)));
        for (py::ssize_t i = 0; i < array.shape(0); ++i)
            polygon.emplace_back(array.at(i, 0), array.at(i, 1));
        return polygon;
    }

    OccupancyGrid gridFrom(const py::handle &cells, double resolution, const Pose &origin)
    {
        const std::string right = "a 2-D array of whole numbers or bool: 0 free, 1 occupied, -1 or 2 unknown";
        const py::array array = py::array::ensure(cells);
        if (!array || (array.dtype().kind() != 'b' && array.dtype().kind() != 'i' && array.dtype().kind() != 'u'))
        {
            PyErr_Clear();
            throw Error(
                "grid must be " + right +
                (array ? "; its dtype is " + py::cast<std::string>(py::str(array.dtype())) : ", not " + shown(cells)));
        }
        if (array.ndim() != 2)
            throw Error("grid must be " + right + "; its shape is " + shapeOf(array));
        OccupancyGrid grid(static_cast<std::size_t>(array.shape(1)), static_cast<std::size_t>(array.shape(0)),
                           resolution, origin);
        const auto fill = [&grid](const auto &rows)
        {
            const auto values = rows.template unchecked<2>();
            for (py::ssize_t row = 0; row < values.shape(0); ++row)
                for (py::ssize_t column = 0; column < values.shape(1); ++column)
                {
                    const auto value = static_cast<std::int64_t>(values(row, column));
                    const std::optional<Cell> cell = cellFrom(value);
                    if (!cell)
                        throw Error("grid: cell [" + std::to_string(row) + ", " + std::to_string(column) + "] is " +
                                    std::to_string(value) + "; a cell is 0 (free), 1 (occupied), -1 or 2 (unknown)");
                    grid.set(static_cast<std::size_t>(column), static_cast<std::size_t>(row), *cell);
                }
        };
        // The usual ones are read where they lie; any other is converted first.
        if (array.dtype().kind() == 'b')
            fill(py::array_t<bool>(array));
        else if (array.itemsize() == 1 && array.dtype().kind() == 'u')
            fill(py::array_t<std::uint8_t>(array));
        else if (array.itemsize() == 1)
            fill(py::array_t<std::int8_t>(array));
        else
            fill(py::array_t<std::int64_t, py::array::forcecast>(array));
        return grid;
    }

    Path pathFrom(const py::handle &value, const Scenario &scenario)
    {
        constexpr double JOINT = 1e-3;  // metres by which the end of one arc may miss the next state
        constexpr double SAME = 1e-9;   // metres: the same place
        const std::string right = "a result, or an array of n rows (x, y, yaw, ...)";
        const Doubles array = doublesFrom(value, "path", right);
        if (array.ndim() != 2 || array.shape(1) < 3)
            throw Error("path must be " + right + "; its shape is " + shapeOf(array));
        if (array.shape(0) == 0)
            throw Error("path must have at least one row");
        const auto state = [&](py::ssize_t i)
        {
            return Pose{array.at(i, 0) - scenario.worldOffset.x(), array.at(i, 1) - scenario.worldOffset.y(),
                        array.at(i, 2)};
        };
        RowsDriver driver(state(0), 1.0 / scenario.vehicle.minTurningRadius());
        for (py::ssize_t i = 1; i < array.shape(0); ++i)
        {
            const Pose from = state(i - 1), to = state(i);
            if (!isFinite(from) || !isFinite(to))
                throw Error("path: row " + std::to_string(isFinite(from) ? i : i - 1) + " is not finite");
            const double turn = wrapAngle(to.yaw - from.yaw), half = 0.5 * turn, middle = from.yaw + half;
            const double dx = to.x - from.x, dy = to.y - from.y, chord = std::hypot(dx, dy);
            if (chord < SAME)
            {
                if (std::abs(turn) > SAME)
                    driver.turn(turn);
                continue;
            }
            const double aside = dy * std::cos(middle) - dx * std::sin(middle);
            const double ahead = dx * std::cos(middle) + dy * std::sin(middle);
            const double length = std::copysign(chord * (std::abs(half) < 1e-6 ? 1.0 : half / std::sin(half)), ahead);
            if (std::abs(aside) > JOINT || !driver.drive({turn / length, length}, to))
                throw Error("path: no arc joins rows " + std::to_string(i - 1) + " and " + std::to_string(i) +
                            ": an arc tangent to the first row misses the second by " +
                            formatNumber(std::round(1e4 * std::abs(aside)) / 1e4) + " m");
        }
        return driver.finish();
    }

    py::tuple toPython(const Pose &pose)
    {
        return py::make_tuple(pose.x, pose.y, pose.yaw);
    }

    PlannerParameters parametersFrom(const py::dict &values)
    {
        PlannerParameters parameters;
        if (values.contains("parameter_set"))
            parameters = parameterSet(textFrom(values["parameter_set"], "parameter_set"), parameters);
        for (const auto &[key, value] : values)
        {
            const auto name = py::cast<std::string>(key);
            const Parameter &row = parameterNamed(name);
            if (const auto *flag = std::get_if<bool PlannerParameters::*>(&row.member))
                parameters.*(*flag) = flagFrom(value, name);
            else if (const auto *text = std::get_if<std::string PlannerParameters::*>(&row.member))
                parameters.*(*text) = name == "parameter_set" ? parameters.parameterSet : textFrom(value, name);
            else
                row.setNumber(parameters, numberFrom(value, name));
        }
        checkParameters(parameters);
        return parameters;
    }

    py::dict toPython(const PlannerParameters &parameters)
    {
        py::dict result;
        for (const Parameter &row : parameterTable())
            std::visit([&](auto member) { result[py::str(row.name)] = parameters.*member; }, row.member);
        return result;
    }

    std::string parameterLines()
    {
        const py::dict defaults = toPython(PlannerParameters());
        std::string text;
        for (const Parameter &row : parameterTable())
        {
            std::string meaning = row.meaning;
            meaning.erase(std::remove(meaning.begin(), meaning.end(), '`'), meaning.end());
            text += row.name + " : " + row.allowed() + "\n    " + meaning + " (default " +
                    py::cast<std::string>(py::repr(defaults[py::str(row.name)])) + ")\n";
        }
        return text;
    }
}  // namespace parking::python
