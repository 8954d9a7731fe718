# Before project(), which would take many lines to say that there is no compiler, and would not name a package. Whoever
# names a compiler or a toolchain is left to CMake.
if(CMAKE_HOST_UNIX AND NOT APPLE AND NOT CMAKE_CXX_COMPILER AND NOT CMAKE_TOOLCHAIN_FILE AND "$ENV{CXX}" STREQUAL ""
    AND "$ENV{CMAKE_TOOLCHAIN_FILE}" STREQUAL "")
  find_program(parking_compiler NAMES c++ g++ clang++ CC icpx icpc aCC xlC NO_CACHE)
  if(NOT parking_compiler)
    message(FATAL_ERROR "there is no C++ compiler: install g++")
  endif()
endif()
