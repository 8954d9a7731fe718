# The trajectory optimiser's interior point method beside IPOPT on the same programs, where that is installed
# (coinor-libipopt-dev).
find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(IPOPT QUIET IMPORTED_TARGET ipopt)
endif()
if(TARGET PkgConfig::IPOPT)
  add_executable(trajectory_solvers ${CMAKE_CURRENT_LIST_DIR}/trajectory_solvers.cpp)
  target_include_directories(trajectory_solvers PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(trajectory_solvers PRIVATE parking_build_flags parking_planner parking_io PkgConfig::IPOPT)
endif()
