// Files of finished runs (runs.jsonl), and the paths in them.

#include "benchmarks/comparison/ResultStore.h"
#include "tests/fuzz/Fuzz.h"

namespace parking_test::fuzz
{
    void tryInput(const std::string &input)
    {
        const std::string file = writeInput("runs.jsonl", input);
        accepts(file,
                [&]
                {
                    const parking::StoredResults results = parking::ResultStore::read(file);
                    if (results.end > input.size())
                        fail("more was read than there is");
                    if (!results.damage.empty())
                        checkMessage(file, results.damage);
                    // What was read is written and read again as what it is.
                    for (const parking::RunRecord &record : results.records)
                    {
                        const nlohmann::json once = record.toJson();
                        const nlohmann::json again = parking::RunRecord::fromJson(once).toJson();
                        const auto bytes = nlohmann::json::error_handler_t::replace;
                        if (once.dump(-1, ' ', false, bytes) != again.dump(-1, ' ', false, bytes))
                            fail("a run that changes when it is written: " + once.dump(-1, ' ', false, bytes));
                    }
                });
    }
}  // namespace parking_test::fuzz
