# Which car parks in which slot: docs/car-slot-table.md is what this program writes.
add_executable(car_slot_table ${CMAKE_CURRENT_LIST_DIR}/car_slot_table.cpp)
target_link_libraries(car_slot_table PRIVATE parking_build_flags automatic_parking)
if(PARKING_BUILD_TESTS)
  add_test(NAME car_slot_table.Check
    COMMAND car_slot_table --check ${PROJECT_SOURCE_DIR}/docs/car-slot-table.md)
  set_tests_properties(car_slot_table.Check PROPERTIES TIMEOUT 900)
endif()
