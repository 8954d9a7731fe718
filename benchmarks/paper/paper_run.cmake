# The paper's run, from the start to standstill in the slot.
add_library(parking_paper STATIC
  ${CMAKE_CURRENT_LIST_DIR}/DiscWorld.cpp
  ${CMAKE_CURRENT_LIST_DIR}/JointSpline.cpp
  ${CMAKE_CURRENT_LIST_DIR}/PaperDrive.cpp
  ${CMAKE_CURRENT_LIST_DIR}/PaperTask.cpp)
target_link_libraries(parking_paper PUBLIC parking_comparison PRIVATE parking_build_flags)
add_executable(paper_run ${CMAKE_CURRENT_LIST_DIR}/paper_run.cpp)
target_link_libraries(paper_run PRIVATE parking_paper Boost::program_options parking_build_flags)
