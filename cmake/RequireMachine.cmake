# Before project(), which takes many lines to say that there is no compiler or no disk, and names no package.

# Whoever names a compiler or a toolchain is left to CMake.
if(CMAKE_HOST_UNIX AND NOT APPLE AND NOT CMAKE_CXX_COMPILER AND NOT CMAKE_TOOLCHAIN_FILE AND "$ENV{CXX}" STREQUAL ""
    AND "$ENV{CMAKE_TOOLCHAIN_FILE}" STREQUAL "")
  find_program(parking_compiler NAMES c++ g++ clang++ CC icpx icpc aCC xlC NO_CACHE)
  if(NOT parking_compiler)
    message(FATAL_ERROR "there is no C++ compiler: install g++")
  endif()
endif()

# The smallest build, of the core, takes some 50 MB, everything with the tests up to 1 GB.
if(CMAKE_HOST_UNIX AND CMAKE_CURRENT_LIST_DIR STREQUAL "${CMAKE_SOURCE_DIR}/cmake")
  execute_process(COMMAND df -Pk ${CMAKE_BINARY_DIR} OUTPUT_VARIABLE parking_disk RESULT_VARIABLE parking_status ERROR_QUIET)
  if(parking_status STREQUAL "0" AND parking_disk MATCHES "\n[^ ]+ +[0-9]+ +[0-9]+ +([0-9]+) ")
    math(EXPR parking_free "${CMAKE_MATCH_1} / 1024")
    if(parking_free LESS 100)
      message(FATAL_ERROR "${CMAKE_BINARY_DIR}: ${parking_free} MB of disk are free, a build takes up to 1000 MB")
    endif()
  endif()
endif()
