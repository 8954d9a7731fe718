# Planning without end in random worlds, on several threads: what scripts/soak runs.
find_package(Threads REQUIRED)
add_executable(soak ${CMAKE_CURRENT_LIST_DIR}/soak.cpp ${CMAKE_CURRENT_LIST_DIR}/SoakWorker.cpp
  ${CMAKE_CURRENT_LIST_DIR}/SoakFigures.cpp ${CMAKE_CURRENT_LIST_DIR}/SoakWorlds.cpp)
target_link_libraries(soak PRIVATE parking_build_flags parking_comparison Threads::Threads)
