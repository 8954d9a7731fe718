#pragma once

#include "parking_geometry/Error.h"

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace parking_test
{
    /** The message of the parking::Error that \e action throws; it must be one line. Empty (and a failed test) when it
        throws none. */
    inline std::string errorOf(const std::function<void()> &action)
    {
        try
        {
            action();
        }
        catch (const parking::Error &error)
        {
            const std::string message = error.what();
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            EXPECT_FALSE(message.empty());
            return message;
        }
        ADD_FAILURE() << "no parking::Error was thrown";
        return {};
    }

    /** Expects a parking::Error whose message has all of \e parts in it. */
    inline void expectError(const std::function<void()> &action, const std::vector<std::string> &parts)
    {
        const std::string message = errorOf(action);
        for (const std::string &part : parts)
            EXPECT_NE(message.find(part), std::string::npos) << "no \"" << part << "\" in: " << message;
    }
}  // namespace parking_test
