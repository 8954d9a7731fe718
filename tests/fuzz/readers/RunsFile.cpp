// Runs as a process hands them to another, one a line: what is read is written and read again as what it is.

#include "benchmarks/store/RunRecord.h"
#include "tests/fuzz/Fuzz.h"

#include <sstream>

namespace parking_test::fuzz
{
    void tryInput(const std::string &input)
    {
        const auto bytes = nlohmann::json::error_handler_t::replace;
        std::istringstream lines(input);
        for (std::string line; std::getline(lines, line);)
            try
            {
                const parking::RunRecord record = parking::RunRecord::fromJson(nlohmann::json::parse(line));
                const nlohmann::json once = record.toJson(), again = parking::RunRecord::fromJson(once).toJson();
                if (once.dump(-1, ' ', false, bytes) != again.dump(-1, ' ', false, bytes))
                    fail("a run that changes when it is written: " + once.dump(-1, ' ', false, bytes));
                reached("a run");
            }
            catch (const std::exception &)
            {
                // No run.
            }
    }
}  // namespace parking_test::fuzz
