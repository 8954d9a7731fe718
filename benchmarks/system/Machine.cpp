#include "benchmarks/system/Machine.h"

#include <ceres/version.h>
#include <fcl/config.h>
#include <ompl/config.h>
#include <Eigen/Core>
#include <boost/version.hpp>

#include <thread>

#include <sys/utsname.h>

namespace parking
{
    namespace
    {
        constexpr int FCL_NUMBER = FCL_MAJOR_VERSION * 1000000 + FCL_MINOR_VERSION * 1000 + FCL_PATCH_VERSION;
        constexpr int CERES_NUMBER =
            CERES_VERSION_MAJOR * 1000000 + CERES_VERSION_MINOR * 1000 + CERES_VERSION_REVISION;
        constexpr int EIGEN_NUMBER = EIGEN_WORLD_VERSION * 1000000 + EIGEN_MAJOR_VERSION * 1000 + EIGEN_MINOR_VERSION;
        constexpr int COMPILER_NUMBER = __GNUC__ * 1000000 + __GNUC_MINOR__ * 1000;

        std::string dotted(int number)
        {
            return std::to_string(number / 1000000) + "." + std::to_string(number / 1000 % 1000) + "." +
                   std::to_string(number % 1000);
        }
    }  // namespace

    std::map<std::string, std::int64_t> machineVersions()
    {
        return {{"project_version", PARKING_VERSION_NUMBER},
                {"ompl_version", OMPL_VERSION_VALUE},
                {"fcl_version", FCL_NUMBER},
                {"ceres_version", CERES_NUMBER},
                {"eigen_version", EIGEN_NUMBER},
                {"boost_version", BOOST_VERSION},
                {"compiler_version", COMPILER_NUMBER},
                {"cores", std::thread::hardware_concurrency()}};
    }

    std::string omplVersion()
    {
        return "OMPL " + dotted(OMPL_VERSION_VALUE);
    }

    std::string machineText()
    {
        utsname system{};
        uname(&system);
        return std::string("ompl_improved_astar ") + dotted(PARKING_VERSION_NUMBER) + ", " + omplVersion() + ", FCL " +
               dotted(FCL_NUMBER) + ", Ceres " + dotted(CERES_NUMBER) + ", Eigen " + dotted(EIGEN_NUMBER) +
               ", compiler " + __VERSION__ + "\n" + system.sysname + " " + system.release + " " + system.machine +
               ", " + std::to_string(std::thread::hardware_concurrency()) + " cores";
    }
}  // namespace parking
