// usage: write_database DATABASE LOG...    (what parking_benchmark does with its logs, for database_test.py)

#include "benchmarks/database/DatabaseWriter.h"

#include <exception>
#include <iostream>

int main(int argc, char **argv)
{
    try
    {
        parking::DatabaseWriter(argv[1]).write({argv + 2, argv + argc});
    }
    catch (const std::exception &error)
    {
        std::cerr << error.what() << std::endl;
        return 1;
    }
    return 0;
}
