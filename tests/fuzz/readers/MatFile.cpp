// Cases of CommonParking: MATLAB files.

#include "benchmarks/formats/ScenarioFormat.h"
#include "tests/fuzz/Fuzz.h"

namespace parking_test::fuzz
{
    void tryInput(const std::string &input)
    {
        const std::string file = writeInput("case.mat", input);
        accepts(file,
                [&file]
                {
                    const parking::Scenario scenario = parking::commonParkingFormat().read(file, {});
                    if (scenario.goals.size() != 1)
                        fail("a case without a goal");
                });
    }
}  // namespace parking_test::fuzz
