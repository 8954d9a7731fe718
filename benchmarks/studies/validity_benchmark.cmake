# Micro-benchmarks of state_validity: checks of states and motions, swept arcs, distance fields.
parking_require(libbenchmark-dev benchmark)
add_executable(validity_benchmark
  ${CMAKE_CURRENT_LIST_DIR}/ValidityWorlds.cpp
  ${CMAKE_CURRENT_LIST_DIR}/validity_benchmark.cpp)
target_include_directories(validity_benchmark PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(validity_benchmark PRIVATE
  parking_build_flags ompl_improved_astar state_validity parking_io benchmark::benchmark)
target_compile_definitions(validity_benchmark PRIVATE
  PARKING_SCENARIOS="${PROJECT_SOURCE_DIR}/benchmarks/scenarios")
