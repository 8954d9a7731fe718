# Studies of the libraries: what they cost, and whether they can be relied on.
parking_require(libbenchmark-dev benchmark)
find_package(Threads REQUIRED)

# Checks of states and motions, swept arcs, distance fields.
add_executable(validity_benchmark ${CMAKE_CURRENT_LIST_DIR}/validity_benchmark.cpp)
target_link_libraries(validity_benchmark PRIVATE
  parking_build_flags ompl_improved_astar parking_io parking_worlds benchmark::benchmark)
target_compile_definitions(validity_benchmark PRIVATE
  PARKING_SCENARIOS="${PROJECT_SOURCE_DIR}/benchmarks/scenarios")

# Sensor frames: what they cost, and what updates of the world in place cost.
add_executable(perception_benchmark ${CMAKE_CURRENT_LIST_DIR}/perception_benchmark.cpp)
target_link_libraries(perception_benchmark PRIVATE
  parking_build_flags parking_planner parking_perception parking_worlds benchmark::benchmark)

# Planning without end in random worlds, on several threads: what scripts/soak runs.
add_executable(soak ${CMAKE_CURRENT_LIST_DIR}/soak.cpp)
target_link_libraries(soak PRIVATE parking_build_flags parking_comparison parking_worlds Threads::Threads)

# Drives that meet trouble: a table of what happened, for docs/results.md.
add_executable(troubled_drives ${CMAKE_CURRENT_LIST_DIR}/troubled_drives.cpp ${CMAKE_CURRENT_LIST_DIR}/TroubledDrives.cpp
  ${CMAKE_CURRENT_LIST_DIR}/Surprise.cpp)
target_link_libraries(troubled_drives PRIVATE parking_build_flags parking_comparison parking_worlds)

# Drives in perceived worlds in which obstacles appear: the reaction to them, for docs/results.md.
add_executable(perceived_drives ${CMAKE_CURRENT_LIST_DIR}/perceived_drives.cpp ${CMAKE_CURRENT_LIST_DIR}/Surprise.cpp)
target_link_libraries(perceived_drives PRIVATE parking_build_flags parking_comparison parking_worlds)

# Which car parks in which slot: docs/results/car-slot-table.md is what this program writes.
add_executable(car_slot_table ${CMAKE_CURRENT_LIST_DIR}/car_slot_table.cpp)
target_link_libraries(car_slot_table PRIVATE parking_build_flags automatic_parking)
if(PARKING_BUILD_TESTS)
  add_test(NAME car_slot_table.Check
    COMMAND car_slot_table --check ${PROJECT_SOURCE_DIR}/docs/results/car-slot-table.md)
  set_tests_properties(car_slot_table.Check PROPERTIES TIMEOUT 900)
endif()
