# The evaluation runs of docs/path-tracking.md: plans, smooths and drives every given problem, with a table as output.
add_executable(tracking_evaluation ${CMAKE_CURRENT_LIST_DIR}/tracking_evaluation.cpp
  ${CMAKE_CURRENT_LIST_DIR}/DriveStudy.cpp)
target_link_libraries(tracking_evaluation PRIVATE parking_build_flags parking_comparison automatic_parking)
