// The one table of parameters: what each row promises holds, for every row that is in it.

#include "ompl_improved_astar/search/planning/Parameters.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <type_traits>

using namespace parking;

namespace
{
    /** Calls \e test with the row and its member for each row whose values are of type \e Value. */
    template <class Value, class Test>
    void forEach(const Test &test)
    {
        for (const Parameter &row : parameterTable())
            if (const auto *member = std::get_if<Value PlannerParameters::*>(&row.member))
            {
                SCOPED_TRACE(row.name);
                test(row, *member);
            }
    }

    bool isTaken(const Parameter &row, const PlannerParameters &parameters)
    {
        try
        {
            row.check(parameters);
            checkParameters(parameters);
            return true;
        }
        catch (const Error &)
        {
            return false;
        }
    }

    /** Checked alone and among all others, the value is refused with its name, itself and what is right. */
    void expectRefused(const Parameter &row, const PlannerParameters &parameters, const std::string &value)
    {
        for (const bool alone : {true, false})
            try
            {
                alone ? row.check(parameters) : checkParameters(parameters);
                ADD_FAILURE() << row.name << " = " << value << " was taken";
            }
            catch (const Error &error)
            {
                const std::string text = error.what();
                EXPECT_NE(text.find(row.name), std::string::npos) << text;
                EXPECT_NE(text.find(value), std::string::npos) << text;
                EXPECT_NE(text.find(row.allowed()), std::string::npos) << text;
                EXPECT_EQ(text.find('\n'), std::string::npos) << text;
            }
    }
}  // namespace

TEST(Parameters, RowsAreComplete)
{
    std::set<std::string> names;
    for (const Parameter &row : parameterTable())
    {
        EXPECT_TRUE(names.insert(row.name).second) << row.name << " is there twice";
        EXPECT_FALSE(row.meaning.empty()) << row.name;
        EXPECT_EQ(row.meaning.find_first_of("|\n"), std::string::npos) << row.name << ": breaks the README's table";
        EXPECT_EQ(row.values.names != nullptr, (std::holds_alternative<std::string PlannerParameters::*>(row.member)))
            << row.name;
    }
    EXPECT_NO_THROW(checkParameters({}));
}

// Two rows for one member, or a member that == does not look at, would show here.
TEST(Parameters, EachChangesOneMemberAndEqualityNoticesIt)
{
    for (const Parameter &row : parameterTable())
    {
        PlannerParameters changed;
        std::visit(
            [&](const auto member)
            {
                using Value = std::decay_t<decltype(changed.*member)>;
                if constexpr (std::is_same_v<Value, bool>)
                    changed.*member = !(changed.*member);
                else if constexpr (std::is_same_v<Value, std::string>)
                    changed.*member = row.values.names().back();
                else
                    changed.*member = static_cast<Value>(row.values.max);
            },
            row.member);
        EXPECT_TRUE(changed != PlannerParameters()) << row.name;
        EXPECT_TRUE(isTaken(row, changed)) << row.name;
        for (const Parameter &other : parameterTable())
            if (&other != &row)
                std::visit([&](const auto at) { EXPECT_EQ(changed.*at, PlannerParameters().*at) << other.name; },
                           other.member);
    }
}

TEST(Parameters, NumbersAreTakenFromEndToEndAndNotBeyond)
{
    forEach<double>(
        [](const Parameter &row, double PlannerParameters::*member)
        {
            const ParameterValues &values = row.values;
            EXPECT_LT(values.min, values.max);
            EXPECT_GT(values.step, 0.0);
            PlannerParameters parameters;
            for (const double right : {values.min, values.max, 0.5 * (values.min + values.max)})
            {
                parameters.*member = right;
                EXPECT_TRUE(isTaken(row, parameters)) << right;
            }
            constexpr double INF = std::numeric_limits<double>::infinity();
            for (const double wrong : {std::nextafter(values.min, -INF), std::nextafter(values.max, INF), INF, -INF,
                                       std::numeric_limits<double>::quiet_NaN()})
            {
                parameters.*member = wrong;
                expectRefused(row, parameters, formatNumber(wrong));
            }
            parameters.*member = 0.0;
            EXPECT_EQ(isTaken(row, parameters), values.allowsZero || values.min == 0.0);
        });
}

TEST(Parameters, CountsAreTakenInStepsFromEndToEndAndNotBeyond)
{
    forEach<unsigned int>(
        [](const Parameter &row, unsigned int PlannerParameters::*member)
        {
            const auto min = static_cast<unsigned int>(row.values.min);
            const auto max = static_cast<unsigned int>(row.values.max);
            const auto step = static_cast<unsigned int>(row.values.step);
            PlannerParameters parameters;
            for (unsigned int value = min; value <= max; ++value)
            {
                parameters.*member = value;
                if ((value - min) % step == 0)
                    EXPECT_TRUE(isTaken(row, parameters)) << value;
                else
                    expectRefused(row, parameters, std::to_string(value));
            }
            EXPECT_EQ((max - min) % step, 0u);
            for (const unsigned int wrong : {0u, min - 1, max + 1, std::numeric_limits<unsigned int>::max()})
            {
                parameters.*member = wrong;
                expectRefused(row, parameters, formatNumber(wrong));
            }
        });
}

TEST(Parameters, NamesAreTakenFromTheListAndTheNearestIsProposed)
{
    forEach<std::string>(
        [](const Parameter &row, std::string PlannerParameters::*member)
        {
            PlannerParameters parameters;
            for (const std::string &name : row.values.names())
            {
                parameters.*member = name;
                EXPECT_TRUE(isTaken(row, parameters)) << name;
                parameters.*member = name + "x";
                expectRefused(row, parameters, "did you mean '" + name + "'");
            }
            for (const char *wrong : {"", "hovercraft", "CAR"})
            {
                parameters.*member = wrong;
                expectRefused(row, parameters, wrong);
            }
        });
}

TEST(Parameters, AreReadFromTextAndRefusedTextChangesNothing)
{
    for (const Parameter &row : parameterTable())
    {
        const std::string right = std::holds_alternative<bool PlannerParameters::*>(row.member) ? "true"
                                  : row.values.names != nullptr ? row.values.names().back()
                                                                : formatNumber(row.values.max);
        PlannerParameters parameters;
        row.setText(parameters, right);
        std::visit(
            [&](const auto member)
            {
                using Value = std::decay_t<decltype(parameters.*member)>;
                if constexpr (std::is_same_v<Value, std::string>)
                    EXPECT_EQ(parameters.*member, right) << row.name;
                else if constexpr (std::is_same_v<Value, bool>)
                    EXPECT_TRUE(parameters.*member) << row.name;
                else
                    EXPECT_EQ(static_cast<double>(parameters.*member), row.values.max) << row.name;
            },
            row.member);
        const PlannerParameters before = parameters;
        for (const char *wrong : {"", "much", "1e300", "-1", "7.5x", "True"})
            try
            {
                row.setText(parameters, wrong);
                ADD_FAILURE() << row.name << " = '" << wrong << "' was taken";
            }
            catch (const Error &error)
            {
                const std::string text = error.what();
                EXPECT_NE(text.find(row.name), std::string::npos) << text;
                EXPECT_NE(text.find(row.allowed()), std::string::npos) << text;
                EXPECT_TRUE(parameters == before) << text;
            }
        EXPECT_EQ(&parameterNamed(row.name), &row);
    }
}

TEST(Parameters, CountsAreWholeAndUnknownNamesAreAnsweredWithTheNearest)
{
    PlannerParameters parameters;
    const Parameter &row = parameterNamed("heading_bins");
    row.setNumber(parameters, 36.0);
    EXPECT_EQ(parameters.headingBins, 36u);
    for (const double wrong : {7.5, -1.0, 1e12, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(row.setNumber(parameters, wrong), Error) << wrong;
    EXPECT_EQ(parameters.headingBins, 36u);
    try
    {
        parameterNamed("heading_bin");
        ADD_FAILURE() << "was taken";
    }
    catch (const Error &error)
    {
        EXPECT_NE(std::string(error.what()).find("did you mean 'heading_bins'"), std::string::npos) << error.what();
    }
}

TEST(Parameters, RemovedNamesAreAnsweredWithWhatToUseInstead)
{
    for (const auto &[name, instead] :
         {std::pair("look_ahead", "always on with detours"), std::pair("spread_out", "always on with detours"),
          std::pair("clearance_weight", "use preferred_clearance and clearance_cost")})
        try
        {
            parameterNamed(name);
            ADD_FAILURE() << name << " was taken";
        }
        catch (const Error &error)
        {
            const std::string text = error.what();
            EXPECT_EQ(text.find(name + std::string(" was removed: ")), 0u) << text;
            EXPECT_NE(text.find(instead), std::string::npos) << text;
        }
    for (const Parameter &row : parameterTable())
        EXPECT_NO_THROW(checkNotRemoved(row.name));
    EXPECT_NO_THROW(checkNotRemoved("heading_bin"));
}

TEST(Parameters, TheWeightsAreThoseOfTheHeuristic)
{
    PlannerParameters parameters;
    parameters.heuristicWeightFar = 3.0;
    parameters.heuristicWeightNear = 2.0;
    parameters.nearGoalDistance = 7.0;
    parameters.tieBreak = 0.25;
    EXPECT_EQ(parameters.weights().at(7.5), 3.25);
    EXPECT_EQ(parameters.weights().at(6.5), 2.25);
}

// What unknown names are answered with, and that a set keeps what belongs to the problem; PlannerParametersTest has the
// values of each.
TEST(Parameters, SetsKeepWhatBelongsToTheProblem)
{
    PlannerParameters current;
    current.turningRadius = 5.0;
    current.xyResolution = 0.2;
    current.headingBins = 36;
    current.anytime = true;
    for (const std::string &name : parameterSetNames())
    {
        const PlannerParameters set = parameterSet(name, current);
        EXPECT_EQ(set.parameterSet, name);
        EXPECT_EQ(set.turningRadius, 5.0);
        EXPECT_EQ(set.xyResolution, 0.2);
        EXPECT_EQ(set.headingBins, 36u);
        EXPECT_FALSE(set.anytime);
        EXPECT_NO_THROW(checkParameters(set));
    }
    EXPECT_THROW(parameterSet("experiment_7", current), Error);
}
