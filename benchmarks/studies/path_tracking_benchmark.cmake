# Micro-benchmarks of path_tracking: speed profile, one step of the controller, a whole simulated drive.
parking_require(libbenchmark-dev benchmark)
add_executable(path_tracking_benchmark ${CMAKE_CURRENT_LIST_DIR}/path_tracking_benchmark.cpp)
target_include_directories(path_tracking_benchmark PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(path_tracking_benchmark PRIVATE parking_build_flags path_tracking benchmark::benchmark)
