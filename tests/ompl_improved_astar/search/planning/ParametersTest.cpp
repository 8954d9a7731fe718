// The one table of parameters: what each row promises holds, for every row that is in it.

#include "ompl_improved_astar/search/planning/Parameters.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <set>
#include <string>
#include <vector>

using namespace parking;
using P = PlannerParameters;

namespace
{
    constexpr double INF = std::numeric_limits<double>::infinity();

    /** Does it throw one line that has all of these in it? */
    template <class Action>
    bool isRefused(const Action &action, std::initializer_list<std::string> parts)
    {
        try
        {
            action();
            return false;
        }
        catch (const Error &error)
        {
            const std::string text = error.what();
            bool hasAll = text.find('\n') == std::string::npos;
            // Of many names it says the nearest.
            for (const std::string &part : parts)
                hasAll = hasAll &&
                         (text.find(part) != std::string::npos || text.find("; the nearest of ") != std::string::npos);
            EXPECT_TRUE(hasAll) << text;
            return hasAll;
        }
    }

    /** Alone and among all others: refused with its name, its value and what is right? */
    bool isRefused(const Parameter &row, const P &parameters, const std::string &value)
    {
        return isRefused([&] { row.check(parameters); }, {row.name, value, row.allowed()}) &&
               isRefused([&] { checkParameters(parameters); }, {row.name, value, row.allowed()});
    }

    void expectTaken(const Parameter &row, const P &parameters)
    {
        EXPECT_NO_THROW(row.check(parameters)) << row.name;
        EXPECT_NO_THROW(checkParameters(parameters)) << row.name;
    }

    template <class Kind>
    bool is(const Parameter &row)
    {
        return std::holds_alternative<Kind P::*>(row.member);
    }
}  // namespace

TEST(Parameters, RowsAreCompleteAndSetOneMemberEachWhichEqualityNotices)
{
    std::set<std::string> names;
    EXPECT_NO_THROW(checkParameters({}));
    for (const Parameter &row : parameterTable())
    {
        SCOPED_TRACE(row.name);
        EXPECT_TRUE(names.insert(row.name).second) << "twice";
        EXPECT_FALSE(row.meaning.empty());
        EXPECT_EQ(row.meaning.find_first_of("|\n"), std::string::npos) << "breaks the table of the documentation";
        EXPECT_EQ(row.values.names != nullptr, is<std::string>(row));
        EXPECT_EQ(&parameterNamed(row.name), &row);
        EXPECT_NO_THROW(checkNotRemoved(row.name));
        P changed;
        std::string other = formatNumber(row.values.max);
        if (const auto *at = std::get_if<bool P::*>(&row.member))
            other = changed.*(*at) ? "false" : "true";
        else if (is<std::string>(row))
            other = row.values.names().back();
        row.setText(changed, other);
        expectTaken(row, changed);
        EXPECT_TRUE(changed != P());
        for (const Parameter &each : parameterTable())
            std::visit([&](const auto at) { EXPECT_EQ(changed.*at == P().*at, &each != &row) << each.name; },
                       each.member);
    }
}

TEST(Parameters, NumbersAreTakenFromEndToEndInStepsAndNotBeyond)
{
    for (const Parameter &row : parameterTable())
    {
        SCOPED_TRACE(row.name);
        const auto &[min, max, step, allowsZero, listNames] = row.values;
        P parameters;
        if (is<double>(row))
        {
            EXPECT_LT(min, max);
            EXPECT_GT(step, 0.0);
            double &value = parameters.*std::get<double P::*>(row.member);
            for (const double right : {min, max, 0.5 * (min + max), allowsZero ? 0.0 : min})
            {
                row.setNumber(parameters, right);
                expectTaken(row, parameters);
            }
            for (const double wrong : {std::nextafter(min, -INF), std::nextafter(max, INF), INF, -INF, std::nan("")})
            {
                value = wrong;
                EXPECT_TRUE(isRefused(row, parameters, formatNumber(wrong)));
            }
            value = 0.0;
            EXPECT_TRUE(allowsZero || min <= 0.0 || isRefused(row, parameters, "0"));
        }
        if (is<unsigned int>(row))
        {
            EXPECT_EQ(std::fmod(max - min, step), 0.0);
            // Below, all of it, above, and what wraps round.
            for (double value = min - 1.0; value <= max + 1.0; value += 1.0)
            {
                row.setNumber(parameters, value);
                if (value < min || value > max || std::fmod(value - min, step) != 0.0)
                    EXPECT_TRUE(isRefused(row, parameters, formatNumber(value)));
                else
                    expectTaken(row, parameters);
            }
            const P before = parameters;
            for (const double wrong : {7.5, -1.0, 1e12, std::nan("")})
                EXPECT_TRUE(isRefused([&] { row.setNumber(parameters, wrong); }, {row.name, row.allowed()}));
            EXPECT_TRUE(parameters == before);
        }
    }
}

TEST(Parameters, TextIsReadAndRefusedTextChangesNothing)
{
    for (const Parameter &row : parameterTable())
    {
        SCOPED_TRACE(row.name);
        std::vector<std::string> right{"true", "false"}, wrong{"", "much", "1e300", "-1", "7.5x", "True", "hovercraft"};
        if (is<std::string>(row))
            right = row.values.names();
        else if (!is<bool>(row))
            right = {formatNumber(row.values.min), formatNumber(row.values.max)};
        for (const std::string &text : right)
        {
            P parameters;
            row.setText(parameters, text);
            expectTaken(row, parameters);
            std::visit(
                [&](const auto at)
                {
                    if constexpr (std::is_same_v<decltype(at), std::string P::*const>)
                        EXPECT_EQ(parameters.*at, text);
                    else if constexpr (std::is_same_v<decltype(at), bool P::*const>)
                        EXPECT_EQ(parameters.*at, text == "true");
                    else
                        EXPECT_EQ(formatNumber(parameters.*at), text);
                },
                row.member);
            const P before = parameters;
            for (const std::string &bad : wrong)
                EXPECT_TRUE(isRefused([&] { row.setText(parameters, bad); }, {row.name, row.allowed()})) << bad;
            EXPECT_TRUE(parameters == before);
            if (is<std::string>(row))
            {
                EXPECT_TRUE(isRefused([&] { row.setText(parameters, text + "x"); }, {"did you mean '" + text + "'"}));
            }
        }
    }
}

TEST(Parameters, UnknownAndRemovedNamesAreAnsweredWithWhatToUseInstead)
{
    EXPECT_TRUE(isRefused([] { parameterNamed("heading_bin"); }, {"did you mean 'heading_bins'"}));
    EXPECT_NO_THROW(checkNotRemoved("heading_bin"));
    for (const auto &[name, instead] : {std::pair("look_ahead", "always on with detours"),
                                        {"spread_out", "always on with detours"},
                                        {"clearance_weight", "use preferred_clearance and clearance_cost"}})
        EXPECT_TRUE(isRefused([&] { parameterNamed(name); }, {std::string(name) + " was removed: ", instead}));
    EXPECT_TRUE(isRefused([] { parameterSet("experiment_7", {}); }, {"did you mean 'experiment_1'"}));
}

TEST(Parameters, ThePaperSSetIsAcceptedByItsFormerName)
{
    const std::string name = "paper_improved_astar";
    EXPECT_EQ(parameterSetName("improved_astar"), name);
    EXPECT_EQ(parameterSetName("improved"), "improved");
    EXPECT_TRUE(parameterSet("improved_astar", {}) == parameterSet(name, {}));
    PlannerParameters parameters;
    parameterNamed("parameter_set").setText(parameters, "improved_astar");
    EXPECT_EQ(parameters.parameterSet, name);
    parameters.parameterSet = "improved_astar";
    EXPECT_NO_THROW(checkParameters(parameters));
    EXPECT_TRUE(isRefused(
        []
        {
            parameterNamed("motion_model")
                .check(
                    []
                    {
                        PlannerParameters each;
                        each.motionModel = "improved_astar";
                        return each;
                    }());
        },
        {"motion_model"}));
}
