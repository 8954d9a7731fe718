// The .cfg files of comparisons.

#include "benchmarks/config/BenchmarkConfig.h"
#include "tests/fuzz/Fuzz.h"

namespace parking_test::fuzz
{
    void tryInput(const std::string &input)
    {
        static const parking::PlannerRegistry registry = parking::PlannerRegistry::builtIn();
        static const std::string scenario =
            writeInput("scenario.yaml", "start: [0, 0, 0]\ngoal: [8, 0, 0]\npolygons: []\n");
        const std::string file = writeInput("fuzzed.cfg", input);
        accepts(file,
                [&file]
                {
                    const parking::BenchmarkConfig config = parking::readBenchmarkConfig(file, registry);
                    // Scenarios may come from the command line; planExperiments() wants some.
                    if (config.planners.empty() || config.runCount == 0 || !(config.timeLimit > 0.0) ||
                        !(config.memoryLimit > 0.0))
                        fail("a comparison of nothing");
                });
    }
}  // namespace parking_test::fuzz
