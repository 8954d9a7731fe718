# Drives that meet trouble: a table of what happened, for docs/reliability.md.
add_executable(troubled_drives ${CMAKE_CURRENT_LIST_DIR}/troubled_drives.cpp ${CMAKE_CURRENT_LIST_DIR}/TroubledDrives.cpp
  ${CMAKE_CURRENT_LIST_DIR}/BrakingOracle.cpp ${CMAKE_CURRENT_LIST_DIR}/../DriveStudy.cpp)
target_link_libraries(troubled_drives PRIVATE parking_build_flags parking_comparison automatic_parking)
