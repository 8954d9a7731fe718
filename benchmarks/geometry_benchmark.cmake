# Micro-benchmarks of parking_geometry's manoeuvres and smoothing.
find_package(benchmark REQUIRED)
add_executable(geometry_benchmark ${CMAKE_CURRENT_LIST_DIR}/geometry_benchmark.cpp)
target_include_directories(geometry_benchmark PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(geometry_benchmark PRIVATE parking_build_flags parking_geometry benchmark::benchmark)
