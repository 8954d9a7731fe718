# How the planner's cost depends on the size of the map.
add_executable(map_size_study ${CMAKE_CURRENT_LIST_DIR}/map_size_study.cpp)
target_link_libraries(map_size_study PRIVATE parking_build_flags ompl_improved_astar parking_drawing Boost::program_options)
